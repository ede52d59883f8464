/* SPDX-License-Identifier: MIT */
/* The kernels' searches of meshes as functions that run on one thread; compiled once for each
   instruction set and lane count. */
#ifndef HD_BENCH_WALKS_H
#define HD_BENCH_WALKS_H

#include "rays.h"

typedef struct HdWalks {
    const char *instruction_set;
    int lanes;
    /* What the rays meet first, or what passes to the light. */
    void (*search)(const HdObject *object, const HdRays *rays, HdHits *hits);
} HdWalks;

#endif
