/* SPDX-License-Identifier: MIT */
/* Where rays wait in a wavefront's queue, and how many of them are traced next. The host and the
   kernels of CPUs plan with the same functions.

   Segments of rays of one level form a stack, in the queue too: those on top are traced first. As
   many are taken as have room for all their rays that go on, on the next levels, and no more than
   leave room for a packet of them on every level below: none is ever without a place. Rays that go
   on take the place of those before the last ones, if it is large enough, so that trees of
   hundreds of levels need little more room than they are wide. */
#ifndef HD_WAVE_STACK_H
#define HD_WAVE_STACK_H

#include "real.h"

/* Arrays of the queue, of reals and of ints, and of a batch's sums; behind each buffer there is
   room for another packet. */
enum { WAVE_REALS = 9, WAVE_INTS = 3, WAVE_SUMS = 4, WAVE_SPARE = 16 };

typedef struct {
    int level;
    int first, waiting; /* of level 0: samples of the batch; below: places in the queue */
} WaveSegment;

typedef struct {
    int level;
    int first, count; /* the rays to be traced */
    int to;           /* the first place for those that go on, at most two for each of `rounded` */
    int rounded;      /* `count` in whole packets */
} WaveChunk;

/* Two rays for each sample of a batch have room on so many levels, and two for each that is taken
   on fewer: what is left over of a level makes all levels below it again, so a level should be
   taken whole even where it has more rays than the batch has samples. */
enum { WAVE_BATCH_LEVELS = 32, WAVE_CHUNK_LEVELS = 4, WAVE_NO_LIMIT = 0x7fffffff };

FN int wave_min(int a, int b) {
    return a < b ? a : b;
}

/* A queue of this many rays or more can be worked off. Rays come in packets of `grain`, of which
   not all need be alive. */
FN int wave_min_capacity(int depth, int grain) {
    return 2 * grain * (depth > 0 ? depth : 1);
}

/* How many rays may be taken that have so many levels below them, 1 or more, where there is so much
   room: a packet or more where that is at least wave_min_capacity(levels, grain). */
FN int wave_fitting(int capacity, int levels, int grain) {
    int pairs = capacity / (2 * grain);
    return grain * wave_min(pairs / wave_min(levels, WAVE_CHUNK_LEVELS), pairs - (levels - 1));
}

/* The first place after those of the segments below number `number`. */
FN int wave_end_below(const WaveSegment *stack, int number) {
    if (number == 0 || stack[number - 1].level == 0)
        return 0;
    return stack[number - 1].first + stack[number - 1].waiting;
}

/* Takes rays, `limit` at most, from the end of the segment on top of the stack; `top` is its
   number, which becomes that of the next one below where nothing is left. */
FN WaveChunk wave_take_chunk(WaveSegment *stack, int *top, int depth, int capacity, int grain,
                             int limit) {
    WaveSegment *segment = stack + *top;
    int first = segment->level == 0 ? 0 : segment->first;
    int end = segment->level == 0 ? 0 : first + segment->waiting;
    WaveChunk chunk;
    chunk.level = segment->level;
    chunk.count = wave_min(segment->waiting, limit);
    if (chunk.level < depth)
        chunk.count =
            wave_min(chunk.count, wave_fitting(capacity - end, depth - chunk.level, grain));
    segment->waiting -= chunk.count;
    chunk.first = segment->first + segment->waiting;
    chunk.rounded = (chunk.count + grain - 1) / grain * grain;
    chunk.to = end;
    if (segment->waiting == 0) {
        int below = wave_end_below(stack, *top);
        if (2 * chunk.rounded <= first - below)
            chunk.to = below;
        *top -= 1;
    }
    return chunk;
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
