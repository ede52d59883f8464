/* SPDX-License-Identifier: MIT */
/* Renders small random scenes with all features of the kernels, also those that no golden frame
   has, by a device and by plain C; their bytes must be equal. */
#ifndef HD_VERIFY_RANDOM_SCENES_H
#define HD_VERIFY_RANDOM_SCENES_H

#include "device/renderer.h"

typedef struct HdRandomTest {
    const HdDevice *device;
    HdRenderOptions options; /* options of the device's renderers */
    uint64_t seed;           /* seed of the first scene; the others follow */
    int scenes;
    int kind;     /* number of the only kind of scene; -1: all */
    bool general; /* one build of the kernels for everything but error bounds */
    int threads;  /* each with a renderer of the device and one of plain C; 0: one for each core, at
                     most 16 */
} HdRandomTest;

typedef struct HdRandomResult {
    int scenes, different;
    uint64_t first_seed; /* lowest seed of a scene that differs */
    char text[1024];     /* difference (hd_first_difference); "": all are equal */
} HdRandomResult;

/* Renders the scenes. Fails if kernels fail their self-test or the device cannot render;
   HD_INTERRUPTED after a signal. */
HdStatus hd_random_test(const HdRandomTest *test, HdRandomResult *result, HdError *error);

#endif
