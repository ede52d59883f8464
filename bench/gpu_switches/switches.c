/* SPDX-License-Identifier: MIT */
#include "switches.h"

#define MEGA      .pipeline = HD_PIPELINE_MEGA
#define WAVEFRONT .pipeline = HD_PIPELINE_WAVEFRONT

#define GIB ((size_t)1 << 30)

/* The first one is what the others are compared with. */
const Switch switches[] = {
    {"mega", MEGA},
    {"registers-64", MEGA, .registers = 64, .is_cuda = true},
    {"registers-80", MEGA, .registers = 80, .is_cuda = true},
    {"registers-96", MEGA, .registers = 96, .is_cuda = true},
    {"registers-128", MEGA, .registers = 128, .is_cuda = true},
    {"block-32", MEGA, .block = 32},
    {"block-64", MEGA, .block = 64},
    {"block-256", MEGA, .block = 256},
    {"registers-64+block-32", MEGA, .registers = 64, .block = 32, .is_cuda = true},
    {"wavefront", WAVEFRONT},
    {"wavefront-4GiB", WAVEFRONT, .queue_bytes = 4 * GIB, .is_surveyed = true},
    {"wavefront-16GiB", WAVEFRONT, .queue_bytes = 16 * GIB, .is_surveyed = true},
};
const int switch_count = sizeof switches / sizeof *switches;
