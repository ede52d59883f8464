/* SPDX-License-Identifier: MIT */
#include "device/wave_plan.h"

#include <limits.h>
#include <stdint.h>
#include <stdio.h>

#include "base/minmax.h"
#include "system/interrupt.h"
#include "tables/table.h"

enum { MAX_STRIDE = INT_MAX / 4 };

static int round_up(int count, int grain) {
    return (count + grain - 1) / grain * grain;
}

/* Samples whose rays and sums fit, if each had two rays on as many levels as are likely. */
static int batch_samples(const HdWaveNeeds *needs, size_t ray_bytes) {
    size_t places = (size_t)wave_least_capacity(wave_lesser(needs->depth, WAVE_BATCH_LEVELS), 1);
    size_t fitting = needs->bytes / (places * ray_bytes + WAVE_SUMS * sizeof(int64_t));
    fitting = hd_min_size(fitting, MAX_STRIDE / places);
    if (fitting >= (size_t)needs->samples)
        return needs->samples;
    return hd_max((int)fitting / needs->samples_at_once, 1) * needs->samples_at_once;
}

/* The queue's room: two places for each sample and level, as far as they fit. */
static int queue_places(const HdWaveNeeds *needs, int batch, size_t ray_bytes) {
    int least = wave_least_capacity(needs->depth, needs->grain);
    size_t sums = WAVE_SUMS * sizeof(int64_t) * (size_t)batch;
    size_t fitting = needs->bytes > sums ? (needs->bytes - sums) / ray_bytes : 0;
    size_t useful =
        (size_t)wave_least_capacity(needs->depth, 1) * (size_t)round_up(batch, needs->grain);
    fitting = hd_min_size(fitting, hd_min_size(useful, MAX_STRIDE));
    return hd_max((int)fitting, least);
}

/* An odd number of bundles: a ray's numbers must not all fall into one set of a cache. */
static int spread_stride(int places) {
    int bundles = (places + WAVE_SPARE - 1) / WAVE_SPARE;
    return (bundles | 1) * WAVE_SPARE;
}

size_t hd_wave_budget(uint64_t device_memory) {
    const size_t most = 1 << 30;
    return hd_min_size((size_t)(device_memory / 8), most);
}

HdWavePlan hd_wave_plan(const HdWaveNeeds *needs) {
    size_t real_size = needs->precision == HD_PRECISION_DOUBLE ? sizeof(double) : sizeof(float);
    size_t ray_bytes = WAVE_REALS * real_size + WAVE_INTS * sizeof(int32_t);
    HdWavePlan plan;
    plan.sum_stride = batch_samples(needs, ray_bytes);
    plan.queue_stride = spread_stride(queue_places(needs, plan.sum_stride, ray_bytes));
    plan.bytes[0] = real_size * (WAVE_REALS * (size_t)plan.queue_stride + WAVE_SPARE);
    plan.bytes[1] = sizeof(int32_t) * (WAVE_INTS * (size_t)plan.queue_stride + WAVE_SPARE);
    plan.bytes[2] = sizeof(int64_t) * (WAVE_SUMS * (size_t)plan.sum_stride + WAVE_SPARE);
    return plan;
}

bool hd_wave_halve(HdWaveNeeds *needs) {
    if (needs->bytes <= HD_WAVE_LEAST_BYTES)
        return false;
    needs->bytes = needs->bytes / 2 > HD_WAVE_LEAST_BYTES ? needs->bytes / 2 : HD_WAVE_LEAST_BYTES;
    return true;
}

void hd_wave_tell_cut(size_t bytes, char *text, int capacity) {
    char room[HD_BYTE_TEXT_SIZE];
    hd_byte_text((double)bytes, room);
    snprintf(text, (size_t)capacity, ", the queue cut to %s, for more memory was refused", room);
}

int hd_wave_samples(int items, int samples_per_item) {
    return hd_min(items, MAX_STRIDE / samples_per_item) * samples_per_item;
}

int hd_wave_groups(const HdWavePlan *plan, int group_size, int grid) {
    enum { MAX_GROUPS = 1 << 15 };
    int threads = hd_max(plan->queue_stride, plan->sum_stride);
    return hd_min((threads + group_size - 1) / group_size, grid > 0 ? grid : (int)MAX_GROUPS);
}

/* None, where all items had theirs. */
static void begin_batch(HdWaveRun *run) {
    HdWaveStep *step = &run->step;
    step->first_item += step->item_count;
    step->item_count =
        hd_min(run->items - step->first_item, run->plan->sum_stride / run->samples_per_item);
    run->top = -1;
    wave_put(run->stack, &run->top, 0, 0, step->item_count * run->samples_per_item);
}

/* As many rays as there is room for, at most what one launch may have. */
static void take_rays(HdWaveRun *run, const HdLaunchSize *size) {
    int limit = hd_launch_size_items(size, run->stack[run->top].waiting, 1, run->grain);
    WaveTake take =
        wave_take(run->stack, &run->top, run->depth, run->plan->queue_stride, run->grain, limit);
    run->step.level = take.level;
    run->step.first = take.first;
    run->step.count = take.count;
    run->step.to = take.to;
}

HdStatus hd_wave_next(HdWaveRun *run, unsigned taken, const HdLaunchSize *size, HdError *error) {
    HdWaveStep *step = &run->step;
    step->is_first = step->item_count == 0;
    if (step->is_first || step->action == HD_WAVE_STORES)
        begin_batch(run);
    else
        wave_put(run->stack, &run->top, step->level + 1, step->to,
                 (int)(taken - step->taken_before));
    step->taken_before = taken;
    step->action = step->item_count == 0 ? HD_WAVE_IS_DONE
                   : run->top < 0        ? HD_WAVE_STORES
                                         : HD_WAVE_TRACES;
    if (step->action != HD_WAVE_TRACES)
        return HD_OK;
    if (hd_interrupt_signal() != 0)
        return hd_fail(error, HD_INTERRUPTED, "interrupted in the midst of a frame");
    take_rays(run, size);
    return HD_OK;
}
