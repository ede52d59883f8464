/* SPDX-License-Identifier: MIT */
/* Where the rays of each level lie in a wavefront's queue, and how many of them are traced next.
   The host and the kernels of CPUs plan with the same functions.

   Rays of the deepest level go first, so the levels form a stack in the queue. Only as many are
   taken as have room for all their rays that go on, on every level below: none is ever without a
   place. */
#ifndef HD_WAVE_STACK_H
#define HD_WAVE_STACK_H

#include "dialect.h"

typedef struct {
    int first, waiting; /* of level 0: samples of the batch; below: places in the queue */
} WaveLevel;

typedef struct {
    int first, count; /* the rays to be traced */
    int to;           /* the first place for those that go on */
} WaveTake;

/* A queue of this many rays or more can be worked off. Rays come in bundles of `grain`, of which
   not all need be alive. */
FN int wave_least_capacity(int depth, int grain) {
    return 2 * grain * (depth > 0 ? depth : 1);
}

/* Takes rays of `level`, the deepest one that has some, from its end. */
FN WaveTake wave_take(WaveLevel *levels, int level, int depth, int capacity, int grain) {
    WaveLevel *own = levels + level;
    WaveTake take;
    take.to = level == 0 ? 0 : own->first + own->waiting;
    take.count = own->waiting;
    if (level < depth) {
        int most = (capacity - take.to) / (2 * grain * (depth - level)) * grain;
        take.count = most < take.count ? most : take.count;
    }
    own->waiting -= take.count;
    take.first = own->first + own->waiting;
    return take;
}

/* Puts in what a take of `level` left behind; returns the deepest level with rays, -1: there is
   none. */
FN int wave_put(WaveLevel *levels, int level, WaveTake take, int going_on) {
    if (going_on > 0) {
        level++;
        levels[level].first = take.to;
        levels[level].waiting = going_on;
    }
    while (level >= 0 && levels[level].waiting == 0)
        level--;
    return level;
}

#endif
