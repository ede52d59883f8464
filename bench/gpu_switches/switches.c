/* SPDX-License-Identifier: MIT */
#include "switches.h"

#define MEGA      .pipeline = HD_PIPELINE_MEGA
#define WAVEFRONT .pipeline = HD_PIPELINE_WAVEFRONT
#define TREE      " -DHD_SUM_BY_TREE=1"
#define SHAPES    " -DHD_CONSTANT_TABLES=1"
#define LIGHTS    " -DHD_CONSTANT_TABLES=2"

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
    {"tree", MEGA, .defines = TREE},
    {"constant-shapes", MEGA, .defines = SHAPES, .is_cuda = true},
    {"constant-lights", MEGA, .defines = LIGHTS, .is_cuda = true},
    {"exact", MEGA, .is_exact = true, .is_cuda = true},
    {"exact+lights", MEGA, .defines = LIGHTS, .is_exact = true, .is_cuda = true},
    {"lights+tree", MEGA, .defines = LIGHTS TREE, .is_cuda = true},
    {"lights+registers-64", MEGA, .registers = 64, .defines = LIGHTS, .is_cuda = true},
    {"lights+registers-80", MEGA, .registers = 80, .defines = LIGHTS, .is_cuda = true},
    {"lights+registers-96", MEGA, .registers = 96, .defines = LIGHTS, .is_cuda = true},
    {"lights+tree+block-64", MEGA, .block = 64, .defines = LIGHTS TREE, .is_cuda = true},
    {"lights+tree+96+block-64", MEGA, .registers = 96, .block = 64, .defines = LIGHTS TREE,
     .is_cuda = true},
    {"registers-64+block-32", MEGA, .registers = 64, .block = 32, .is_cuda = true},
    {"lights+64+block-32", MEGA, .registers = 64, .block = 32, .defines = LIGHTS, .is_cuda = true},
    {"wavefront", WAVEFRONT},
    {"wavefront+lights", WAVEFRONT, .defines = LIGHTS, .is_cuda = true},
    {"wavefront-4GiB", WAVEFRONT, .queue_bytes = 4 * GIB, .is_surveyed = true},
    {"wavefront-16GiB", WAVEFRONT, .queue_bytes = 16 * GIB, .is_surveyed = true},
};
const int switch_count = sizeof switches / sizeof *switches;
