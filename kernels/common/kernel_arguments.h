/* SPDX-License-Identifier: MIT */
/* The arguments of each kernel, in order: the lists define both the kernels' parameters and what a
   host passes.

   X(kind, type, name) stands for an argument, LAST(kind, type, name) for the last one of a kernel,
   which no comma follows in a list of parameters. The kinds are
   INPUT    a buffer of `type` that is only read
   BUFFER   a buffer of `type` that is written
   NUMBER   a value of `type`, int or uint
   A kernel that has more says so here: TABLES are those of HD_SCENE_TABLES and then of
   HD_FRAME_TABLES (scene_tables.h), all of kind INPUT. */
#ifndef HD_KERNEL_ARGUMENTS_H
#define HD_KERNEL_ARGUMENTS_H

/* hedron_render: TABLES, then these. Renders items [first_item, first_item + item_count), each by
   `parts` threads; `parts` divides the number of samples. */
#define HD_RENDER_ARGUMENTS(X, LAST)                                                               \
    X(NUMBER, int, first_item)                                                                     \
    X(NUMBER, int, item_count)                                                                     \
    X(NUMBER, int, parts)                                                                          \
    X(BUFFER, float, pixels)                                                                       \
    LAST(BUFFER, RayCounts, counts)

/* The queue and the batch's sums as structures of arrays: ray_reals has WAVE_REALS arrays of
   queue_stride numbers, ray_ints WAVE_INTS, sums WAVE_SUMS of sum_stride. If `compact` is 0, rays
   are appended with the dead ones of their packet or group, to measure what compaction gains. */
#define HD_QUEUE_ARGUMENTS(X)                                                                      \
    X(BUFFER, real, ray_reals)                                                                     \
    X(BUFFER, int, ray_ints)                                                                       \
    X(BUFFER, fixed64, sums)                                                                       \
    X(NUMBER, int, queue_stride)                                                                   \
    X(NUMBER, int, sum_stride)                                                                     \
    X(NUMBER, int, compact)

/* hedron_trace_chunk: TABLES, HD_QUEUE_ARGUMENTS, then these (trace_chunk_by_group). */
#define HD_TRACE_CHUNK_ARGUMENTS(X, LAST)                                                          \
    X(NUMBER, int, first_item)                                                                     \
    X(NUMBER, int, level)                                                                          \
    X(NUMBER, int, first)                                                                          \
    X(NUMBER, int, count)                                                                          \
    X(NUMBER, int, to)                                                                             \
    X(NUMBER, uint, taken_before)                                                                  \
    X(NUMBER, int, is_first_launch)                                                                \
    X(BUFFER, uint, taken)                                                                         \
    LAST(BUFFER, RayCounts, counts)

/* hedron_store_batch: `sums` and `sum_stride` belong to the queue. */
#define HD_STORE_BATCH_ARGUMENTS(X, LAST)                                                          \
    X(INPUT, Header, header)                                                                       \
    X(INPUT, View, view)                                                                           \
    X(INPUT, fixed64, sums)                                                                        \
    X(NUMBER, int, sum_stride)                                                                     \
    X(NUMBER, int, first_item)                                                                     \
    X(NUMBER, int, item_count)                                                                     \
    LAST(BUFFER, float, pixels)

/* hedron_render_by_waves, for devices without groups: TABLES, HD_QUEUE_ARGUMENTS, then these.
   Renders items [first_item, end_item). */
#define HD_RENDER_BY_WAVES_ARGUMENTS(X, LAST)                                                      \
    X(NUMBER, int, first_item)                                                                     \
    X(NUMBER, int, end_item)                                                                       \
    X(BUFFER, float, pixels)                                                                       \
    LAST(BUFFER, RayCounts, counts)

/* hedron_first_hits: TABLES, then these. Items [first_item, first_item + item_count), each by a
   thread (find_first_hits). */
#define HD_FIRST_HITS_ARGUMENTS(X, LAST)                                                           \
    X(NUMBER, int, first_item)                                                                     \
    X(NUMBER, int, item_count)                                                                     \
    X(NUMBER, int, floats)                                                                         \
    LAST(BUFFER, float, hits)

/* hedron_sum_counts: adds `count` of `counts` up to `workers` sums. */
#define HD_SUM_COUNTS_ARGUMENTS(X, LAST)                                                           \
    X(INPUT, RayCounts, counts)                                                                    \
    X(NUMBER, int, count)                                                                          \
    X(BUFFER, RayCounts, sums)                                                                     \
    LAST(NUMBER, int, workers)

/* hedron_encode: `pixels` are the bits of floats; `thresholds` as in encode8. */
#define HD_ENCODE_ARGUMENTS(X, LAST)                                                               \
    X(INPUT, int, pixels)                                                                          \
    X(NUMBER, int, count)                                                                          \
    X(INPUT, int, thresholds)                                                                      \
    LAST(BUFFER, uint, image)

/* hedron_probe: applies every primitive to each of `count` tuples of numbers (first, second, third)
   and of bits. Results that are numbers go to `numbers`, others to `integers`: `count` for each
   primitive, in the order of the lists below. With groups, atomic additions go to `sums` and
   `counters`, which all threads share. */
#define HD_PROBE_ARGUMENTS(X, LAST)                                                                \
    X(INPUT, real, first)                                                                          \
    X(INPUT, real, second)                                                                         \
    X(INPUT, real, third)                                                                          \
    X(INPUT, fixed64, bits)                                                                        \
    X(NUMBER, int, count)                                                                          \
    X(BUFFER, real, numbers)                                                                       \
    X(BUFFER, fixed64, integers)                                                                   \
    X(BUFFER, fixed64, sums)                                                                       \
    LAST(BUFFER, uint, counters)

/* The probe's results: a name and a description for messages. a, b and c are a tuple's numbers, x
   its 64 bits as an integer, n the lower 32. */
#define HD_PROBE_NUMBERS(X)                                                                        \
    X(sum, "a + b")                                                                                \
    X(difference, "a - b")                                                                         \
    X(product, "a * b")                                                                            \
    X(negative, "-a")                                                                              \
    X(quotient, "a / b")                                                                           \
    X(root, "the square root of a")                                                                \
    X(fused, "fma(a, b, c)")                                                                       \
    X(unfused, "a * b + c, rounded twice,")                                                        \
    X(unfused_from, "c - a * b, rounded twice,")                                                   \
    X(in_order, "(a + b) + c")                                                                     \
    X(lost, "(a + b) - a")                                                                         \
    X(nothing, "a - a")                                                                            \
    X(plus_zero, "a + 0")                                                                          \
    X(absolute, "the absolute value of a")                                                         \
    X(vmin, "the minimum of a and b")                                                              \
    X(vmax, "the maximum of a and b")                                                              \
    X(signed, "a times the sign of b")                                                             \
    X(picked, "a <= b ? c : a")                                                                    \
    X(of_int, "(real) n")                                                                          \
    X(of_fixed, "(real) x")

#define HD_PROBE_INTEGERS(X)                                                                       \
    X(less, "a < b")                                                                               \
    X(less_equal, "a <= b")                                                                        \
    X(is_number, "a <= a")                                                                         \
    X(to_int, "(int) a, within 2^30,")                                                             \
    X(to_fixed, "(64-bit integer) of a, within 2^62,")                                             \
    X(int_order, "n < (int) a ? n : (int) a")                                                      \
    X(shifted, "n >> 5")                                                                           \
    X(fixed_sum, "x + (x >> 7)")                                                                   \
    X(lowest_bit, "the lowest bit of n | 2^31")                                                    \
    X(bit_count, "the number of bits of n")

enum {
    HD_PROBE_SUMS = 8,     /* sums that threads add to */
    HD_PROBE_COUNTERS = 8, /* likewise */
    HD_PROBE_GRAIN = 16    /* the count of tuples is a multiple: the maximum of lanes */
};

/* Turn a list of arguments into parameters and into a call's arguments. */
#define HD_PARAMETER_INPUT(type, name)      GLOBAL const type *RESTRICT name
#define HD_PARAMETER_BUFFER(type, name)     GLOBAL type *RESTRICT name
#define HD_PARAMETER_NUMBER(type, name)     type name
#define HD_LAST_PARAMETER(kind, type, name) HD_PARAMETER_##kind(type, name)
#define HD_PARAMETER(kind, type, name)      HD_PARAMETER_##kind(type, name),
#define HD_ARGUMENT(kind, type, name)       name,

#define HD_TABLE_PARAMETER(type, name) GLOBAL const type *RESTRICT name,
#define HD_TABLE_ARGUMENT(type, name)  name,

/* Both end with a comma: f(SCENE_PARAMETERS int x) is called as f(SCENE_ARGUMENTS 1). */
#define SCENE_PARAMETERS HD_SCENE_TABLES(HD_TABLE_PARAMETER) HD_FRAME_TABLES(HD_TABLE_PARAMETER)
#define SCENE_ARGUMENTS  HD_SCENE_TABLES(HD_TABLE_ARGUMENT) HD_FRAME_TABLES(HD_TABLE_ARGUMENT)

/* Likewise for the tables that locate a frame's samples. */
#define SAMPLE_PARAMETERS                                                                          \
    GLOBAL const View *RESTRICT view, GLOBAL const int *RESTRICT entries,                          \
        GLOBAL const int *RESTRICT sample_places,
#define SAMPLE_ARGUMENTS view, entries, sample_places,

/* Bounds: constants if the kernels are built at run time, otherwise the scene's own numbers. Every
   solid has at least three planes. */
#ifdef HD_PLANE_BOUND
#define PLANE_BOUND(header)     HD_PLANE_BOUND
#define SOLID_BOUND(header)     (HD_PLANE_BOUND / 3 + 1)
#define DEPTH_BOUND(view)       HD_DEPTH_BOUND
#define REFRACTS(header)        HD_REFRACTS
#define LIT_FROM_BEHIND(header) HD_LIT_FROM_BEHIND
#define MANY_LIGHTS(header)     HD_MANY_LIGHTS
#define BOUNDED(header)         HD_BOUNDED
#define CUT_OUTS(header)        (HD_CUT_OUTS && (header)->cut_outs)
#define ENVIRONMENT(header)     (HD_ENVIRONMENT && (header)->environment_picture >= 0)
#define PIXEL_SUMS              (HD_BOUNDED ? HD_BOUNDED_SUMS : HD_RADIANCE_SUMS)
#define MESHES(header)          (HD_NODE_STACK > 0 && (header)->instance_count > 0)
#define NODE_STACK(header)      (HD_NODE_STACK + 1)
#define WIDE_STACK(header)      (HD_WIDE_STACK + 1)
/* Otherwise barriers do not suffice (docs/lost-light.md). */
#define ALIGNS_DEPTHS (HD_NODE_STACK == 0)
#else
#ifndef HD_PLAIN
#define HD_PLAIN 0
#endif
#define PLANE_BOUND(header)     ((header)->plane_count + 1)
#define SOLID_BOUND(header)     ((header)->solid_count + 1)
#define DEPTH_BOUND(view)       ((view)->depth + 1)
#define REFRACTS(header)        (!HD_PLAIN && (header)->refracts)
#define LIT_FROM_BEHIND(header) (!HD_PLAIN && (header)->lit_from_behind)
#define MANY_LIGHTS(header)     1
#define BOUNDED(header)         ((header)->bounded)
#define CUT_OUTS(header)        ((header)->cut_outs)
#define ENVIRONMENT(header)     (!HD_PLAIN && (header)->environment_picture >= 0)
#define PIXEL_SUMS              HD_BOUNDED_SUMS
#define MESHES(header)          (!HD_PLAIN && (header)->instance_count > 0)
#define NODE_STACK(header)      ((header)->node_stack + 1)
#define WIDE_STACK(header)      ((header)->wide_stack + 1)
#define ALIGNS_DEPTHS           0
#endif

#endif
