/* SPDX-License-Identifier: MIT */
/* Embree, to compare with; where it is not installed there is none. */
#ifndef HD_BENCH_RIVAL_H
#define HD_BENCH_RIVAL_H

#include "rays.h"

typedef struct HdRival HdRival;

/* Its ways to search, each a row to compare; a NULL name ends the list. */
typedef struct HdRivalWay {
    const char *name;
    void (*search)(const HdRival *rival, const HdRays *rays, HdHits *hits);
} HdRivalWay;
extern const HdRivalWay hd_rival_ways[];

/* With as many threads; they build the hierarchy only. Robust: in the mode that its makers call
   watertight. NULL: there is none. */
HdRival *hd_rival_create(const HdObject *object, int threads, bool is_robust);
void hd_rival_free(HdRival *rival);

/* The processor time that building its hierarchy took. */
double hd_rival_build_seconds(const HdRival *rival);

#endif
