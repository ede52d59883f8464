/* SPDX-License-Identifier: MIT */
/* Small scenes made by lot, of everything that kernels do and no golden frame holds, rendered by a
   device and by plain C, whose bytes must be equal. */
#ifndef HD_VERIFY_RANDOM_SCENES_H
#define HD_VERIFY_RANDOM_SCENES_H

#include "device/renderer.h"

typedef struct HdRandomTest {
    const HdDevice *device;
    HdRenderOptions options; /* of the device's renderers */
    uint64_t seed;           /* of the first scene; the others' follow */
    int scenes;
    int kind;     /* the only kind of scene, by number; -1: all */
    bool general; /* one build of the kernels does everything, but for surveys */
    int threads;  /* each with a renderer of the device and one of plain C; 0: one for each core,
                    16 at most */
} HdRandomTest;

typedef struct HdRandomResult {
    int scenes, different;
    uint64_t first_seed; /* of those that differ, the lowest */
    char text[1024];     /* what differs there (hd_first_difference); "" where all are equal */
} HdRandomResult;

/* Renders the scenes. Kernels that fail their self-test make it fail, as does whatever keeps the
   device from rendering; HD_INTERRUPTED after a signal. */
HdStatus hd_random_test(const HdRandomTest *test, HdRandomResult *result, HdError *error);

#endif
