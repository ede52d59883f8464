/* SPDX-License-Identifier: MIT */
/* The wavefront with its queue in several orders: the kernels' own functions, level by level, on
   one thread; compiled once for each instruction set and lane count, as the CPU kernels are. */
#ifndef HD_BENCH_ORDER_H
#define HD_BENCH_ORDER_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "tables/tables.h"

/* What stands behind what in the queue of a level. */
typedef enum HdQueueOrder {
    HD_ORDER_PRODUCT,     /* trace_batch of the kernels, item by item, whatever the batch */
    HD_ORDER_UNCOMPACTED, /* as appended, but bundles keep their dead rays */
    HD_ORDER_APPENDED,    /* each bundle's mirrored rays, then those that pass, as they come */
    HD_ORDER_SEGMENTS,    /* all rays that pass, then all mirrored ones */
    HD_ORDER_TOUCHED,     /* sorted by the object touched last and the side the ray runs on */
    HD_ORDER_FACE,        /* likewise, and by the face */
    HD_ORDER_MET,         /* sorted by the face that the ray is going to meet */
    HD_ORDER_COUNT
} HdQueueOrder;

/* Which of a frame's samples are traced: batches of so many, in whole items, spread over the frame,
   that have about `most` samples together. */
typedef struct HdBatches {
    int samples, most;
} HdBatches;

/* Seconds are the thread's own processor time. `product` has all of its time in trace_seconds, and
   neither rays nor bundles. */
typedef struct HdOrderResult {
    double first_seconds;      /* level 0, which no order changes */
    double trace_seconds;      /* the levels below: closest hit, shading, adding up, appending */
    double key_seconds;        /* what each ray is sorted by */
    double sort_seconds;       /* counting, and moving the rays */
    uint64_t first_rays, rays; /* live ones of level 0, and below */
    uint64_t bundles;          /* below level 0 */
    uint64_t touched,
        met;         /* different objects with side that a bundle's live rays touched last,
                        and different faces they meet (a miss is one): sums over the bundles */
    uint64_t digest; /* of all samples' sums: the same for every order */
} HdOrderResult;

typedef struct HdOrderBuild {
    const char *instruction_set;
    int lanes;
    /* Traces the batches; `counts`: fills in touched and met too, in time that does not count.
       False where there is no memory. */
    bool (*run)(const HdTable *scene, const HdTable *frame, HdQueueOrder order, HdBatches batches,
                bool counts, HdOrderResult *result);
    /* Writes what every ray of the frame adds to its sample, in the order `appended` with one
       batch. 32-bit numbers of this machine: samples, samples of a pixel; then for each level the
       count of rays that follow, and for each ray its sample's number and three floats; at last a
       count of 0. False where there is no memory or the file cannot be written. */
    bool (*record)(const HdTable *scene, const HdTable *frame, FILE *file);
} HdOrderBuild;

#endif
