/* SPDX-License-Identifier: MIT */
/* The plan of a wavefront's queue: places of waiting rays, and the next chunk to trace. The host
   and the CPU kernels use the same functions.

   Segments of rays of one depth form a stack, also in the queue; the top ones are traced first. A
   chunk is limited so that all its secondary rays fit and a packet of them fits at each further
   depth: every ray has a place. Secondary rays reuse the place of a finished segment if it is large
   enough, so that trees hundreds deep need little more capacity than they are wide. */
#ifndef HD_WAVE_STACK_H
#define HD_WAVE_STACK_H

#include "real.h"

/* Arrays of the queue, of reals and of ints, and of a batch's sums; each buffer has space for
   another packet at its end. */
enum { WAVE_REALS = 9, WAVE_INTS = 3, WAVE_SUMS = 4, WAVE_SPARE = 16 };

typedef struct {
    int level;
    int first, waiting; /* at depth 0 samples of the batch, otherwise places in the queue */
} WaveSegment;

typedef struct {
    int level;
    int first, count; /* rays to trace */
    int to;           /* first place for secondary rays, at most two for each of `rounded` */
    int rounded;      /* `count` in whole packets */
} WaveChunk;

/* The queue holds two rays for each sample of a batch at WAVE_BATCH_LEVELS depths, and two for each
   ray of a chunk at fewer. The rest of a depth repeats all further depths, so a chunk should hold a
   whole depth even if it has more rays than the batch has samples. */
enum { WAVE_BATCH_LEVELS = 32, WAVE_CHUNK_LEVELS = 4, WAVE_NO_LIMIT = 0x7fffffff };

FN int wave_min(int a, int b) {
    return a < b ? a : b;
}

/* Returns the minimum capacity of a queue, in rays. Rays come in packets of `grain`, not all of
   them alive. */
FN int wave_min_capacity(int depth, int grain) {
    return 2 * grain * (depth > 0 ? depth : 1);
}

/* Returns the maximum rays of a chunk with `levels` depths below it, 1 or more, and this capacity;
   at least a packet if the capacity is wave_min_capacity(levels, grain) or more. */
FN int wave_fitting(int capacity, int levels, int grain) {
    int pairs = capacity / (2 * grain);
    return grain * wave_min(pairs / wave_min(levels, WAVE_CHUNK_LEVELS), pairs - (levels - 1));
}

/* Returns the first place after the segments below `number`. */
FN int wave_end_below(const WaveSegment *stack, int number) {
    if (number == 0 || stack[number - 1].level == 0)
        return 0;
    return stack[number - 1].first + stack[number - 1].waiting;
}

/* Removes a chunk of at most `limit` rays from the end of the segment `top`; if the segment is
   empty then, `top` becomes the next one below. */
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

/* Pushes rays, whose places are above those on the stack; does nothing if `count` is 0. A depth
   never has more than two segments. */
FN void wave_put(WaveSegment *stack, int *top, int level, int first, int count) {
    if (count == 0)
        return;
    *top += 1;
    stack[*top].level = level;
    stack[*top].first = first;
    stack[*top].waiting = count;
}

/* The maximum of segments on a stack. */
#define WAVE_STACK_SIZE(depth) (2 * (depth) + 1)

#endif
