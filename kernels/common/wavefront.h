/* SPDX-License-Identifier: MIT */
/* Ray trees by ray depth: the rays of a depth wait in a queue, and secondary rays are appended to
   the next depth's. Packets and groups of threads are filled with live rays only.

   A batch is the samples whose trees are traced together. Each has its own sum, which loses bits
   (View.pixel_shift) when it is added to its pixel's. */
#ifndef HD_WAVEFRONT_H
#define HD_WAVEFRONT_H

#include "render.h"
#include "wave_stack.h"

/* As SCENE_PARAMETERS and SCENE_ARGUMENTS. */
#define QUEUE_PARAMETERS HD_QUEUE_ARGUMENTS(HD_PARAMETER)
#define QUEUE_ARGUMENTS  HD_QUEUE_ARGUMENTS(HD_ARGUMENT)

/* ---- the queue ---- */

/* Returns a packet of at most `count` rays from the place `from` on, and the numbers of their
   samples. The first word of a ray is its last hit and the side it runs on; -1: it is dead. Only
   scenes with meshes need the faces that rays leave. */
FN Ray load_rays(QUEUE_PARAMETERS int from, int count, int has_faces, vint *numbers) {
    GLOBAL const real *reals = ray_reals + from;
    uint64 stride = (uint64)queue_stride;
    vint state = load_ints(ray_ints + from);
    Ray ray;
    ray.alive = lanes_below(count) & ~lt_int(state, splat_int(0));
    ray.inside = eq_int(state & 1, splat_int(1));
    ray.last_hit = spread_first(state >> 1, ray.alive);
    *numbers = load_ints(ray_ints + stride + from);
    ray.face = has_faces ? load_ints(ray_ints + 2 * stride + from) : splat_int(-1);
    ray.origin =
        vec3(load_reals(reals), load_reals(reals + stride), load_reals(reals + 2 * stride));
    ray.direction = vec3(load_reals(reals + 3 * stride), load_reals(reals + 4 * stride),
                         load_reals(reals + 5 * stride));
    ray.weight = vec3(load_reals(reals + 6 * stride), load_reals(reals + 7 * stride),
                      load_reals(reals + 8 * stride));
    return ray;
}

/* Stores the lanes of `m` from the place `to` on and returns their count; may overwrite a packet's
   places. */
FN int store_rays(QUEUE_PARAMETERS int to, vmask m, const Ray *ray, int has_faces, vint numbers) {
    GLOBAL real *reals = ray_reals + to;
    uint64 stride = (uint64)queue_stride;
    vint side = vselect_int(ray->inside, splat_int(1), splat_int(0));
    vint state = vselect_int(ray->alive, (ray->last_hit + ray->last_hit) | side, splat_int(-1));
    int offset[HD_LANES];
    int count = lane_offsets(m, offset);
    store_lanes_int(ray_ints + to, offset, &state);
    store_lanes_int(ray_ints + stride + to, offset, &numbers);
    if (has_faces)
        store_lanes_int(ray_ints + 2 * stride + to, offset, &ray->face);
    store_lanes(reals, m, offset, &ray->origin.x);
    store_lanes(reals + stride, m, offset, &ray->origin.y);
    store_lanes(reals + 2 * stride, m, offset, &ray->origin.z);
    store_lanes(reals + 3 * stride, m, offset, &ray->direction.x);
    store_lanes(reals + 4 * stride, m, offset, &ray->direction.y);
    store_lanes(reals + 5 * stride, m, offset, &ray->direction.z);
    store_lanes(reals + 6 * stride, m, offset, &ray->weight.x);
    store_lanes(reals + 7 * stride, m, offset, &ray->weight.y);
    store_lanes(reals + 8 * stride, m, offset, &ray->weight.z);
    return count;
}

/* ---- the batch's sums ---- */

/* Sets the sums of a packet at depth 0, which has one ray for each sample: no one clears them. */
FN void set_sums(QUEUE_PARAMETERS int number, int has_bound, const Sample *sample) {
    GLOBAL fixed64 *sum = sums + number;
    for (int lane = 0; lane < HD_LANES; lane++) {
        sum[0] = lane_fix(&sample->r, lane);
        sum[(uint64)sum_stride] = lane_fix(&sample->g, lane);
        sum[2 * (uint64)sum_stride] = lane_fix(&sample->b, lane);
        if (has_bound)
            sum[3 * (uint64)sum_stride] = lane_fix(&sample->bound, lane);
        sum++;
    }
}

FN void add_to_sums(QUEUE_PARAMETERS vmask m, vint numbers, int has_bound, const Sample *sample) {
    vint chosen = vselect_int(m, splat_int(1), splat_int(0));
    for (int lane = 0; lane < HD_LANES; lane++) {
        if (!lane_int(&chosen, lane))
            continue;
        GLOBAL fixed64 *sum = sums + lane_int(&numbers, lane);
        add_shared(sum, lane_fix(&sample->r, lane));
        add_shared(sum + (uint64)sum_stride, lane_fix(&sample->g, lane));
        add_shared(sum + 2 * (uint64)sum_stride, lane_fix(&sample->b, lane));
        if (has_bound)
            add_shared(sum + 3 * (uint64)sum_stride, lane_fix(&sample->bound, lane));
    }
}

/* Adds the sums of `count` samples of an item, from `first` on, to its pixels. */
FN void gather_sums(GLOBAL const Header *header, GLOBAL const View *view,
                    GLOBAL const fixed64 *sums, int sum_stride, int first, int count,
                    PixelAccumulator *accumulator) {
    int per_pixel = view->samples;
    int place = first / per_pixel, left = per_pixel - first % per_pixel;
    for (int i = 0; i < count; i++) {
        fixed64 *pixel = accumulator->sums + place * PIXEL_SUMS;
        for (int channel = 0; channel < HD_RADIANCE_SUMS; channel++)
            pixel[channel] +=
                sums[(uint64)channel * (uint64)sum_stride + (uint64)i] >> view->pixel_shift;
        if (BOUNDED(header))
            pixel[HD_RADIANCE_SUMS] +=
                shifted_bound(view, sums[HD_RADIANCE_SUMS * (uint64)sum_stride + (uint64)i]);
        left--;
        if (left == 0) {
            left = per_pixel;
            place++;
        }
    }
}

/* ---- one thread with its own queue ---- */

FN void add_vector_counts(const Sample *sample, Sample *sum) {
    sum->mirrored = sum->mirrored + sample->mirrored;
    sum->transmitted = sum->transmitted + sample->transmitted;
    sum->shadow_tests = sum->shadow_tests + sample->shadow_tests;
    sum->clamps = sum->clamps + sample->clamps;
}

/* Appends rays; without compaction, a packet with a live one keeps its dead ones. */
FN int append_rays(QUEUE_PARAMETERS int to, const Ray *ray, int has_faces, vint numbers) {
    if (!any_lane(ray->alive))
        return 0;
    return store_rays(QUEUE_ARGUMENTS to, compact ? ray->alive : mask_all(), ray, has_faces,
                      numbers);
}

/* Returns the eye rays of at most `count` samples from `number` of the item on. */
FN Ray first_rays(SAMPLE_PARAMETERS int item, int number, int count) {
    Vec3 direction;
    vmask alive = sample_directions(SAMPLE_ARGUMENTS item, number, &direction);
    return eye_ray(direction, alive & lanes_below(count));
}

/* Traces the rays of a chunk, whose batch begins with the item's sample `first_sample`. Appends
   transmitted rays from the place chunk.to on, and mirrored ones chunk.rounded places later, which
   keeps each kind together. */
FN void trace_chunk(SCENE_PARAMETERS QUEUE_PARAMETERS int item, int first_sample, WaveChunk chunk,
                    int *passing, int *mirrored, RayCounts *counts) {
    Sample sum = empty_sample();
    *passing = *mirrored = 0;
    for (int i = 0; i < chunk.count; i += HD_LANES) {
        int number = chunk.first + i;
        Sample sample = empty_sample();
        Ray ray, mirror, through;
        vint numbers;
        if (chunk.level == 0) {
            ray = first_rays(SAMPLE_ARGUMENTS item, first_sample + number, chunk.count - i);
            numbers = lane_numbers() + number;
        } else {
            ray = load_rays(QUEUE_ARGUMENTS number, chunk.count - i, MESHES(header), &numbers);
        }
        if (!any_lane(ray.alive)) {
            if (chunk.level == 0)
                set_sums(QUEUE_ARGUMENTS number, BOUNDED(header), &sample);
            continue;
        }
        trace_and_shade(SCENE_ARGUMENTS & ray, chunk.level, &sample, &mirror, &through);
        if (chunk.level == 0)
            set_sums(QUEUE_ARGUMENTS number, BOUNDED(header), &sample);
        else
            add_to_sums(QUEUE_ARGUMENTS ray.alive, numbers, BOUNDED(header), &sample);
        add_vector_counts(&sample, &sum);
        *passing +=
            append_rays(QUEUE_ARGUMENTS chunk.to + *passing, &through, MESHES(header), numbers);
        *mirrored += append_rays(QUEUE_ARGUMENTS chunk.to + chunk.rounded + *mirrored, &mirror,
                                 MESHES(header), numbers);
    }
    add_counts(counts, counts_of(&sum));
}

/* Traces samples [first, first + batch) of an item. */
FN void trace_batch(SCENE_PARAMETERS QUEUE_PARAMETERS int item, int first, int batch,
                    RayCounts *counts) {
    WaveSegment stack[WAVE_STACK_SIZE(DEPTH_BOUND(view))];
    int top = -1;
    wave_put(stack, &top, 0, 0, batch);
    while (top >= 0) {
        int passing, mirrored;
        WaveChunk chunk =
            wave_take_chunk(stack, &top, view->depth, queue_stride, HD_LANES, WAVE_NO_LIMIT);
        trace_chunk(SCENE_ARGUMENTS QUEUE_ARGUMENTS item, first, chunk, &passing, &mirrored,
                    counts);
        wave_put(stack, &top, chunk.level + 1, chunk.to, passing);
        wave_put(stack, &top, chunk.level + 1, chunk.to + chunk.rounded, mirrored);
    }
}

/* Renders the pixels of one item, as render_item does, in batches of at most sum_stride samples, a
   multiple of HD_LANES. */
FN void render_item_by_waves(SCENE_PARAMETERS QUEUE_PARAMETERS int item, GLOBAL float *pixels,
                             GLOBAL RayCounts *counts) {
    PixelAccumulator accumulator;
    int samples = HD_PIXELS_PER_ITEM * view->samples;
    clear_accumulator(&accumulator);
    for (int first = 0; first < samples; first += sum_stride) {
        int batch = samples - first < sum_stride ? samples - first : sum_stride;
        trace_batch(SCENE_ARGUMENTS QUEUE_ARGUMENTS item, first, batch, &accumulator.counts);
        gather_sums(header, view, sums, sum_stride, first, batch, &accumulator);
    }
    store_pixels(header, view, item, &accumulator, pixels);
    *counts = accumulator.counts;
}

/* Renders every `workers`-th item from number first_item + worker to below end_item, with the
   worker's own part of the buffers. */
FN void render_items_by_waves(SCENE_PARAMETERS QUEUE_PARAMETERS int first_item, int end_item,
                              int worker, int workers, GLOBAL float *pixels,
                              GLOBAL RayCounts *counts) {
    uint64 own = (uint64)worker;
    ray_reals += own * (WAVE_REALS * (uint64)queue_stride + WAVE_SPARE);
    ray_ints += own * (WAVE_INTS * (uint64)queue_stride + WAVE_SPARE);
    sums += own * (WAVE_SUMS * (uint64)sum_stride + WAVE_SPARE);
    for (int item = first_item + worker; item < end_item; item += workers)
        render_item_by_waves(SCENE_ARGUMENTS QUEUE_ARGUMENTS item, pixels, counts + item);
}

/* ---- groups of threads with a shared queue ---- */

#if HD_GROUP_SIZE

/* The fields of a thread's packed counts, which one scan adds up: mirrored and transmitted rays,
   clamps (at most three a thread), shadow tests. */
enum { PASSING_SHIFT = 11, CLAMPS_SHIFT = 22, SHADOW_TESTS_SHIFT = 34, COUNT_MASK = (1 << 11) - 1 };

FN uint64 pack_counts(const Sample *sample) {
    return (uint64)lane_int(&sample->mirrored, 0) |
           (uint64)lane_int(&sample->transmitted, 0) << PASSING_SHIFT |
           (uint64)lane_int(&sample->clamps, 0) << CLAMPS_SHIFT |
           (uint64)lane_int(&sample->shadow_tests, 0) << SHADOW_TESTS_SHIFT;
}

/* Returns the sum of the values of the group's threads up to this one; `total` is that of all.
   `scratch` has two numbers for each thread. */
FN uint64 scan_group(LOCAL uint64 *scratch, int thread, int thread_count, uint64 value,
                     uint64 *total) {
    int side = 0;
    scratch[thread] = value;
    BARRIER();
    for (int step = 1; step < thread_count; step *= 2) {
        if (thread >= step)
            value += scratch[side + thread - step];
        side = thread_count - side;
        scratch[side + thread] = value;
        BARRIER();
    }
    *total = scratch[side + thread_count - 1];
    return value;
}

/* Appends the group's secondary rays, mirrored ones first; returns the group's packed counts. All
   of its threads must call this. *taken was `taken_before` when the launch began. */
FN uint64 append_by_group(QUEUE_PARAMETERS int to, uint taken_before, const Ray *mirror,
                          const Ray *through, int has_faces, vint number, const Sample *sample,
                          int thread, int thread_count, LOCAL uint64 *scratch, LOCAL uint *place,
                          GLOBAL uint *taken) {
    uint64 total, own = pack_counts(sample);
    uint64 before = scan_group(scratch, thread, thread_count, own, &total) - own;
    int mirrors = (int)(total & COUNT_MASK), passes = (int)(total >> PASSING_SHIFT & COUNT_MASK);
    int mirror_place = (int)(before & COUNT_MASK);
    int through_place = (int)(before >> PASSING_SHIFT & COUNT_MASK);
    vmask keeps_mirror = mirror->alive, keeps_through = through->alive;
    if (!compact) {
        mirror_place = through_place = thread;
        keeps_mirror = mirrors > 0 ? mask_all() : mask_none();
        keeps_through = passes > 0 ? mask_all() : mask_none();
        mirrors = mirrors > 0 ? thread_count : 0;
        passes = passes > 0 ? thread_count : 0;
    }
    if (thread == 0 && mirrors + passes > 0)
        *place = take_shared(taken, (uint)(mirrors + passes)) - taken_before;
    BARRIER();
    if (any_lane(keeps_mirror))
        store_rays(QUEUE_ARGUMENTS to + (int)*place + mirror_place, keeps_mirror, mirror, has_faces,
                   number);
    if (any_lane(keeps_through))
        store_rays(QUEUE_ARGUMENTS to + (int)*place + mirrors + through_place, keeps_through,
                   through, has_faces, number);
    return total;
}

/* Traces rays [first, first + count) of a depth by work groups, one lane a thread, and appends the
   secondary rays from the place `to` on. The batch begins with the item `first_item`. Each group
   adds its counts to counts[group_index], which the frame's first launch sets. `scratch` has two
   numbers for each thread of the group. */
FN void trace_chunk_by_group(SCENE_PARAMETERS QUEUE_PARAMETERS int first_item, int level, int first,
                             int count, int to, uint taken_before, int is_first_launch,
                             int group_index, int group_count, int thread, int thread_count,
                             LOCAL uint64 *scratch, LOCAL uint *place, GLOBAL uint *taken,
                             GLOBAL RayCounts *counts) {
    RayCounts sum = no_counts();
    int per_item = HD_PIXELS_PER_ITEM * view->samples;
    for (int start = group_index * thread_count; start < count;
         start += group_count * thread_count) {
        int i = start + thread;
        Sample sample = empty_sample();
        vint number = splat_int(first + i);
        Ray ray, mirror, through;
        mirror.alive = through.alive = ray.alive = mask_none();
        if (i < count)
            ray = level == 0 ? first_rays(SAMPLE_ARGUMENTS first_item + (first + i) / per_item,
                                          (first + i) % per_item, 1)
                             : load_rays(QUEUE_ARGUMENTS first + i, 1, MESHES(header), &number);
        if (any_lane(ray.alive)) {
            trace_and_shade(SCENE_ARGUMENTS & ray, level, &sample, &mirror, &through);
            if (level > 0)
                add_to_sums(QUEUE_ARGUMENTS ray.alive, number, BOUNDED(header), &sample);
        }
        if (level == 0 && i < count)
            set_sums(QUEUE_ARGUMENTS first + i, BOUNDED(header), &sample);
        uint64 total =
            append_by_group(QUEUE_ARGUMENTS to, taken_before, &mirror, &through, MESHES(header),
                            number, &sample, thread, thread_count, scratch, place, taken);
        sum.mirrored += total & COUNT_MASK;
        sum.transmitted += total >> PASSING_SHIFT & COUNT_MASK;
        sum.clamps += total >> CLAMPS_SHIFT & ((1 << (SHADOW_TESTS_SHIFT - CLAMPS_SHIFT)) - 1);
        sum.shadow_tests += total >> SHADOW_TESTS_SHIFT;
    }
    if (thread > 0)
        return;
    if (!is_first_launch)
        add_counts(&sum, counts[group_index]);
    counts[group_index] = sum;
}

/* Stores the pixels of a finished batch, items [first_item, first_item + item_count); this worker
   stores every `workers`-th item. */
FN void store_batch(GLOBAL const Header *header, GLOBAL const View *view,
                    GLOBAL const fixed64 *sums, int sum_stride, int first_item, int item_count,
                    int worker, int workers, GLOBAL float *pixels) {
    int per_item = HD_PIXELS_PER_ITEM * view->samples;
    for (int i = worker; i < item_count; i += workers) {
        PixelAccumulator accumulator;
        clear_accumulator(&accumulator);
        gather_sums(header, view, sums + i * per_item, sum_stride, 0, per_item, &accumulator);
        store_pixels(header, view, first_item + i, &accumulator, pixels);
    }
}

#endif

#endif
