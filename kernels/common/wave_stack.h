/* SPDX-License-Identifier: MIT */
/* Where rays wait in a wavefront's queue, and how many of them are traced next. The host and the
   kernels of CPUs plan with the same functions.

   Segments of rays of one level form a stack, in the queue too: those on top are traced first. Only
   as many are taken as have room for all their rays that go on, on every level below: none is ever
   without a place. */
#ifndef HD_WAVE_STACK_H
#define HD_WAVE_STACK_H

#include "dialect.h"

/* Arrays of the queue, of reals and of ints, and of a batch's sums; behind each buffer there is
   room for another bundle. */
enum { WAVE_REALS = 9, WAVE_INTS = 4, WAVE_SUMS = 5, WAVE_SPARE = 16 };

typedef struct {
    int level;
    int first, waiting; /* of level 0: samples of the batch; below: places in the queue */
} WaveSegment;

typedef struct {
    int level;
    int first, count; /* the rays to be traced */
    int to;           /* the first place for those that go on, at most two for each of `room` */
    int room;         /* `count` in whole bundles */
} WaveTake;

/* A queue of this many rays or more can be worked off. Rays come in bundles of `grain`, of which
   not all need be alive. */
FN int wave_least_capacity(int depth, int grain) {
    return 2 * grain * (depth > 0 ? depth : 1);
}

/* Takes rays from the end of the segment on top of the stack; `top` is its number, which becomes
   that of the next one below where nothing is left. */
FN WaveTake wave_take(WaveSegment *stack, int *top, int depth, int capacity, int grain) {
    WaveSegment *segment = stack + *top;
    WaveTake take;
    take.level = segment->level;
    take.to = take.level == 0 ? 0 : segment->first + segment->waiting;
    take.count = segment->waiting;
    if (take.level < depth) {
        int most = (capacity - take.to) / (2 * grain * (depth - take.level)) * grain;
        take.count = most < take.count ? most : take.count;
    }
    segment->waiting -= take.count;
    take.first = segment->first + segment->waiting;
    take.room = (take.count + grain - 1) / grain * grain;
    if (segment->waiting == 0)
        *top -= 1;
    return take;
}

/* Puts rays on the stack, whose places are above those of the rays that are there; none: does
   nothing. There are never more than two segments of a level. */
FN void wave_put(WaveSegment *stack, int *top, int level, int first, int count) {
    if (count == 0)
        return;
    *top += 1;
    stack[*top].level = level;
    stack[*top].first = first;
    stack[*top].waiting = count;
}

/* Segments that a stack has at most. */
#define WAVE_STACK_SIZE(depth) (2 * (depth) + 1)

#endif
