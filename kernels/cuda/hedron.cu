/* SPDX-License-Identifier: MIT */
/* Entry points for CUDA; their parameters are those of kernel_arguments.h, by the names there. */
#include "dialect.h"

/* The text has each file once, where it is asked for first: what either part needs comes before. */
#include "../common/dialect.h"
#include "../common/scene_arguments.h"
#if HD_PROBE
#include "../common/probe.h"
#else
#include "../common/encode.h"
#include "../common/render.h"
#if HD_WAVEFRONT
#include "../common/wavefront.h"
#endif
#endif

#define KERNEL extern "C" __global__ void

/* Switches that bench/gpu_switches measures; see there. With HD_CONSTANT_TABLES=1 the host copies
   small tables to constant memory too, with 2 those of lights as well; with HD_EXACT the numbers of
   objects and lights are those of one scene. Kernels begin with USE_SWITCHES. */
#ifndef HD_CONSTANT_TABLES
#define HD_CONSTANT_TABLES 0
#endif
#define HD_CONSTANT_SHAPES(X)                                                                      \
    X(Header, header, 1)                                                                           \
    X(Object, objects, 16)                                                                         \
    X(Plane, planes, 64)                                                                           \
    X(Edge, edges, 64)                                                                             \
    X(Material, materials, 24)                                                                     \
    X(Vector, object_offsets, 64)                                                                  \
    X(FloorMap, floor_map, 1)                                                                      \
    X(View, view, 1)
#define HD_CONSTANT_LIGHTS(X)                                                                      \
    X(Light, lights, 240)                                                                          \
    X(Vector, light_offsets, 960)                                                                  \
    X(real, light_coordinates, 4096)                                                               \
    X(LightSides, light_sides, 960)
#define DEFINE_CONSTANT(type, name, count)                                                         \
    extern "C" {                                                                                   \
    __constant__ type hedron_constant_##name[count];                                               \
    }
#define USE_CONSTANT(type, name, count) const type *const name = hedron_constant_##name;

#if HD_CONSTANT_TABLES > 1
#define CONSTANT_TABLES(X) HD_CONSTANT_SHAPES(X) HD_CONSTANT_LIGHTS(X)
#elif HD_CONSTANT_TABLES
#define CONSTANT_TABLES(X) HD_CONSTANT_SHAPES(X)
#else
#define CONSTANT_TABLES(X)
#endif

#ifdef HD_EXACT
#define USE_SWITCHES                                                                               \
    CONSTANT_TABLES(USE_CONSTANT)                                                                  \
    Header exact_header = *header;                                                                 \
    exact_header.solid_count = HD_EXACT_SOLIDS;                                                    \
    exact_header.floor_end = exact_header.object_count = HD_EXACT_OBJECTS;                         \
    exact_header.plane_count = HD_EXACT_PLANES;                                                    \
    exact_header.light_count = HD_EXACT_LIGHTS;                                                    \
    {                                                                                              \
        const Header *const header = &exact_header;
#define END_SWITCHES }
#else
#define USE_SWITCHES CONSTANT_TABLES(USE_CONSTANT)
#define END_SWITCHES
#endif

#if HD_PROBE

KERNEL hedron_probe(HD_PROBE_ARGUMENTS(HD_PARAMETER, HD_LAST_PARAMETER)) {
    probe_tuples(first, second, third, bits, count, numbers, integers, sums, counters,
                 (int)(blockIdx.x * blockDim.x + threadIdx.x), (int)(gridDim.x * blockDim.x));
}

#else

CONSTANT_TABLES(DEFINE_CONSTANT)

#if HD_WAVEFRONT

KERNEL hedron_trace_take(
    SCENE_PARAMETERS QUEUE_PARAMETERS HD_TRACE_TAKE_ARGUMENTS(HD_PARAMETER, HD_LAST_PARAMETER)) {
    __shared__ uint64 room[2 * HD_GROUP_SIZE];
    __shared__ uint place;
    {
        USE_SWITCHES
        trace_take_by_group(SCENE_ARGUMENTS QUEUE_ARGUMENTS first_item, level, first, count, to,
                            taken_before, is_first_launch, (int)blockIdx.x, (int)gridDim.x,
                            (int)threadIdx.x, (int)blockDim.x, room, &place, taken, counts);
        END_SWITCHES
    }
}

KERNEL hedron_store_batch(HD_STORE_BATCH_ARGUMENTS(HD_PARAMETER, HD_LAST_PARAMETER)) {
    int worker = (int)(blockIdx.x * blockDim.x + threadIdx.x);
    store_batch(header, view, sums, sum_stride, first_item, item_count, worker,
                (int)(gridDim.x * blockDim.x), pixels);
}

#else

KERNEL hedron_render(SCENE_PARAMETERS HD_RENDER_ARGUMENTS(HD_PARAMETER, HD_LAST_PARAMETER)) {
    __shared__ fixed64 room[GROUP_ROOM * HD_GROUP_SIZE];
    {
        USE_SWITCHES
        render_by_group(SCENE_ARGUMENTS first_item, item_count, parts, (int)blockIdx.x,
                        (int)gridDim.x, (int)threadIdx.x, (int)blockDim.x, room, pixels, counts);
        END_SWITCHES
    }
}

#endif

KERNEL hedron_sum_counts(HD_SUM_COUNTS_ARGUMENTS(HD_PARAMETER, HD_LAST_PARAMETER)) {
    int worker = (int)(blockIdx.x * blockDim.x + threadIdx.x);
    if (worker < workers)
        sum_counts(counts, count, worker, workers, sums);
}

#if HD_FIRST_HITS

KERNEL hedron_first_hits(SCENE_PARAMETERS HD_FIRST_HITS_ARGUMENTS(HD_PARAMETER,
                                                                  HD_LAST_PARAMETER)) {
    USE_SWITCHES
    int step = (int)(gridDim.x * blockDim.x);
    for (int item = (int)(blockIdx.x * blockDim.x + threadIdx.x); item < item_count; item += step)
        find_first_hits(SCENE_ARGUMENTS first_item + item, floats, hits);
    END_SWITCHES
}

#endif

KERNEL hedron_encode(HD_ENCODE_ARGUMENTS(HD_PARAMETER, HD_LAST_PARAMETER)) {
    int worker = (int)(blockIdx.x * blockDim.x + threadIdx.x);
    encode_pixels(pixels, count, thresholds, worker, (int)(gridDim.x * blockDim.x), image);
}

#endif
