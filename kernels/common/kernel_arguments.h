/* SPDX-License-Identifier: MIT */
/* The arguments of each kernel, in their order: the kernels' parameters and what a host hands over
   are made of the same lists.

   X(kind, type, name) stands for an argument, LAST(kind, type, name) for the last one of a kernel,
   which no comma follows in a list of parameters. The kinds are
   INPUT    a buffer of `type` that is only read
   BUFFER   a buffer of `type` that is written
   NUMBER   a value of `type`, int or uint
   A kernel that has more says so here: TABLES are those of HD_SCENE_TABLES and then of
   HD_FRAME_TABLES (scene_tables.h), all of kind INPUT. */
#ifndef HD_KERNEL_ARGUMENTS_H
#define HD_KERNEL_ARGUMENTS_H

/* hedron_render: TABLES, then these. Items [first_item, first_item + item_count) are rendered, each
   by `parts` threads. */
#define HD_RENDER_ARGUMENTS(X, LAST)                                                               \
    X(NUMBER, int, first_item)                                                                     \
    X(NUMBER, int, item_count)                                                                     \
    X(NUMBER, int, parts)                                                                          \
    X(BUFFER, float, pixels)                                                                       \
    LAST(BUFFER, RayCounts, counts)

/* The queue and the batch's sums as structures of arrays: ray_reals has WAVE_REALS arrays of
   queue_stride numbers, ray_ints WAVE_INTS, sums WAVE_SUMS of sum_stride. `compact` is 0 where rays
   are appended with the dead ones of their bundle or group, to see what leaving them out is worth.
 */
#define HD_QUEUE_ARGUMENTS(X)                                                                      \
    X(BUFFER, real, ray_reals)                                                                     \
    X(BUFFER, int, ray_ints)                                                                       \
    X(BUFFER, fixed64, sums)                                                                       \
    X(NUMBER, int, queue_stride)                                                                   \
    X(NUMBER, int, sum_stride)                                                                     \
    X(NUMBER, int, compact)

/* hedron_trace_take: TABLES, HD_QUEUE_ARGUMENTS, then these (trace_take_by_group). */
#define HD_TRACE_TAKE_ARGUMENTS(X, LAST)                                                           \
    X(NUMBER, int, first_item)                                                                     \
    X(NUMBER, int, level)                                                                          \
    X(NUMBER, int, first)                                                                          \
    X(NUMBER, int, count)                                                                          \
    X(NUMBER, int, to)                                                                             \
    X(NUMBER, uint, taken_before)                                                                  \
    X(NUMBER, int, is_first_launch)                                                                \
    X(BUFFER, uint, taken)                                                                         \
    LAST(BUFFER, RayCounts, counts)

/* hedron_store_batch: `sums` and `sum_stride` are the queue's. */
#define HD_STORE_BATCH_ARGUMENTS(X, LAST)                                                          \
    X(INPUT, Header, header)                                                                       \
    X(INPUT, View, view)                                                                           \
    X(INPUT, fixed64, sums)                                                                        \
    X(NUMBER, int, sum_stride)                                                                     \
    X(NUMBER, int, first_item)                                                                     \
    X(NUMBER, int, item_count)                                                                     \
    LAST(BUFFER, float, pixels)

/* hedron_render_by_waves, of devices without groups: TABLES, HD_QUEUE_ARGUMENTS, then these. */
#define HD_RENDER_BY_WAVES_ARGUMENTS(X, LAST)                                                      \
    X(NUMBER, int, item_count)                                                                     \
    X(BUFFER, float, pixels)                                                                       \
    LAST(BUFFER, RayCounts, counts)

/* hedron_sum_counts: `count` of `counts` become `workers` sums. */
#define HD_SUM_COUNTS_ARGUMENTS(X, LAST)                                                           \
    X(INPUT, RayCounts, counts)                                                                    \
    X(NUMBER, int, count)                                                                          \
    X(BUFFER, RayCounts, sums)                                                                     \
    LAST(NUMBER, int, workers)

/* hedron_encode: `pixels` are floats, by their bits; `thresholds` as encode8 takes them. */
#define HD_ENCODE_ARGUMENTS(X, LAST)                                                               \
    X(INPUT, int, pixels)                                                                          \
    X(NUMBER, int, count)                                                                          \
    X(INPUT, int, thresholds)                                                                      \
    LAST(BUFFER, uint, image)

#endif
