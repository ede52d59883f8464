/* SPDX-License-Identifier: MIT */
/* Ways to render that must not change a byte: the other pipeline, little memory for its queue, and
   the sizes of launches. */
#ifndef HD_CONFORMANCE_VARIANTS_H
#define HD_CONFORMANCE_VARIANTS_H

#include "device/renderer.h"

typedef struct Variant {
    enum { FOR_CPUS, FOR_PLAIN_C, FOR_GPUS, FOR_CUDA, FOR_CPUS_AS_GPUS } kind;
    bool all_frames; /* otherwise those of is_variant_frame */
    HdRenderOptions options;
} Variant;

extern const Variant variants[];
extern const int variant_count;

bool variant_suits(const Variant *variant, const HdDevice *device);

/* True for a few frames: overlapping solids, a single pixel, clamps, two with meshes, and one
   with everything else that a scene can have. */
bool is_variant_frame(const char *name);

#endif
