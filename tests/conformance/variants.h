/* SPDX-License-Identifier: MIT */
/* Variants of rendering that must not change a byte: the other pipeline, little memory for its
   queue, and the sizes of launches. */
#ifndef HD_CONFORMANCE_VARIANTS_H
#define HD_CONFORMANCE_VARIANTS_H

#include "device/renderer.h"

/* Selects frames: a few are those of is_variant_frame. ONLY_CUT differs from another variant, or
   from a lane count, only in how the work is cut. FIRST_HITS also compares first hits. Their kernel
   is the same in each variant, so one with each pipeline does, and one with each way to cut their
   work. */
enum { FEW_FRAMES = 0, EVERY_FRAME = 1, ONLY_CUT = 2, FIRST_HITS = 4 };

typedef struct Variant {
    enum { FOR_CPUS, FOR_PLAIN_C, FOR_GPUS, FOR_CUDA, FOR_CPUS_AS_GPUS } kind;
    int frames;
    HdRenderOptions options;
} Variant;

extern const Variant variants[];
extern const int variant_count;

bool variant_suits(const Variant *variant, const HdDevice *device);

/* Returns true for a few frames: overlapping solids, a single pixel, clamps, two with meshes, and
   one with all other features of a scene. */
bool is_variant_frame(const char *name);

#endif
