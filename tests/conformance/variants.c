/* SPDX-License-Identifier: MIT */
#include "variants.h"
#include "render/backends.h"

#include <string.h>

/* The least memory that works: one packet or group of threads at a time. */
enum { LEAST = 1, LITTLE = 100000, SOME = 1000000 };

#define WAVEFRONT   .pipeline = HD_PIPELINE_WAVEFRONT
#define UNCOMPACTED .pipeline = HD_PIPELINE_WAVEFRONT_UNCOMPACTED
#define MEGA        .pipeline = HD_PIPELINE_MEGA

const Variant variants[] = {
    /* Both have the same kernels. */
    {FOR_CPUS, EVERY_FRAME | FIRST_HITS, {WAVEFRONT, .threads = 2}},
    {FOR_CPUS, FIRST_HITS, {UNCOMPACTED, .threads = 2, .test.queue_bytes = LEAST}},

    {FOR_PLAIN_C, FEW_FRAMES, {WAVEFRONT, .lanes = 1, .threads = 1}},
    {FOR_PLAIN_C, FEW_FRAMES, {WAVEFRONT, .lanes = 4, .threads = 2, .test.queue_bytes = LITTLE}},
    {FOR_PLAIN_C, FEW_FRAMES, {WAVEFRONT, .threads = 1, .test.queue_bytes = LEAST}},

    {FOR_GPUS, EVERY_FRAME | FIRST_HITS, {WAVEFRONT}},
    {FOR_GPUS,
     EVERY_FRAME | ONLY_CUT,
     {WAVEFRONT, .block = 96, .test = {.queue_bytes = LITTLE, .launch_work = 500}}},
    {FOR_GPUS, FEW_FRAMES, {UNCOMPACTED, .block = 256, .test.queue_bytes = SOME}},
    {FOR_GPUS, ONLY_CUT | FIRST_HITS, {MEGA, .block = 96, .grid = 1, .test.launch_work = 999}},
    {FOR_CUDA, ONLY_CUT, {MEGA, .block = 256, .grid = 2}},
    {FOR_GPUS, ONLY_CUT, {MEGA, .block = 32, .grid = 2}}, /* threads that sum several samples */
    {FOR_GPUS,
     EVERY_FRAME | ONLY_CUT,
     {WAVEFRONT, .block = 32, .grid = 24, .test.queue_bytes = LEAST}},

    /* The last two have the same kernels. */
    {FOR_CPUS_AS_GPUS, FIRST_HITS, {MEGA, .grid = 3, .test = {.groups = true, .launch_work = 999}}},
    {FOR_CPUS_AS_GPUS,
     FEW_FRAMES,
     {WAVEFRONT, .block = 96, .grid = 3, .test = {.groups = true, .queue_bytes = LITTLE}}},
    {FOR_CPUS_AS_GPUS,
     FEW_FRAMES,
     {UNCOMPACTED, .block = 96,
      .test = {.groups = true, .queue_bytes = LITTLE, .launch_work = 200}}},
};
const int variant_count = sizeof variants / sizeof *variants;

bool variant_suits(const Variant *variant, const HdDevice *device) {
    bool is_plain_c = device->backend == &hd_backend_c;
    switch (variant->kind) {
    case FOR_CPUS:
        return device->is_cpu;
    case FOR_PLAIN_C:
        return is_plain_c;
    case FOR_CUDA: /* only it compiles for a requested number of threads */
        return device->backend == &hd_backend_cuda;
    case FOR_CPUS_AS_GPUS:
        return device->is_cpu && !is_plain_c;
    case FOR_GPUS:
        return !device->is_cpu;
    }
    return false;
}

bool is_variant_frame(const char *name) {
    static const char *const names[] = {
        "three-overlapping", "one-pixel",           "clamped",
        "everything",        "triangulated-solids", "mesh-edges-and-corners",
        "bounded-grid",      "crop-of-multijitter"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strcmp(names[i], name) == 0)
            return true;
    return false;
}
