/* SPDX-License-Identifier: MIT */
#include "device/launch_plan.h"

#include <limits.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>

#include "base/minmax.h"
#include "system/interrupt.h"
#include "tables/table.h"

/* ---- size of a launch ---- */

enum {
    THREADS_PER_UNIT = 2048, /* in flight, on most devices */
    MAX_UNITS = 1 << 12,
    MIN_START = 1 << 14,
    START_PER_LEAST = 16,
    GROUPS_PER_UNIT = 4
};

static const double MAX_GROWTH = 2.0, CEILING_GROWTH = 1.25;

/* A launch with less than SMALLER of another's work should be nearer to the proportional time than
   to the same time. One that takes longer than ALIKE times the other has more expensive pixels. */
static const double SMALLER = 0.75, ALIKE = 1.1, MIN_SHRINKING = 0.25, TAILS = 1.5;
static const double TAIL_DECAY = 0.9;

static int within(double work, int least, int most) {
    if (!(work > (double)least))
        return least;
    return work < (double)most ? (int)work : most;
}

HdLaunchSize hd_launch_size_start(int compute_units, double longest) {
    int units = hd_min(compute_units, MAX_UNITS);
    int start = within((double)units * THREADS_PER_UNIT, MIN_START, HD_MAX_LAUNCH_WORK);
    return (HdLaunchSize){
        .limit = start,
        .least = start / START_PER_LEAST,
        .most = HD_MAX_LAUNCH_WORK,
        .ceiling = HD_MAX_LAUNCH_WORK,
        .fewest_groups = units > 0 ? units * GROUPS_PER_UNIT : 0,
        .longest = longest,
    };
}

HdLaunchSize hd_launch_size_fixed(int work) {
    return (HdLaunchSize){.limit = work, .least = work, .most = work, .ceiling = work};
}

void hd_launch_size_begin_frame(HdLaunchSize *size) {
    if (!size->too_long && size->limit == size->ceiling)
        size->ceiling = within(CEILING_GROWTH * (double)size->ceiling, size->least, size->most);
    if (!size->has_tail)
        size->tail *= TAIL_DECAY;
    size->too_long = size->has_tail = false;
}

int hd_launch_size_items(const HdLaunchSize *size, int left, int work, int grain) {
    int fitting = size->limit > work ? size->limit / work : 1;
    if (fitting / grain < size->fewest_groups)
        fitting = size->fewest_groups * grain;
    if (fitting >= left)
        return left;
    int parts = (left - 1) / fitting + 1;
    int even = ((left - 1) / parts + grain) / grain * grain;
    if (even > fitting)
        even = hd_max(fitting / grain, 1) * grain;
    return hd_min(even, left);
}

/* Estimates from two launches the time that does not grow with the work. Compares slowly decreasing
   sizes with the first of them. */
static void look_for_tail(HdLaunchSize *size, double work, double seconds) {
    double before = size->slow_seconds, share = before > 0.0 ? work / size->slow_work : 2.0;
    if (seconds <= size->longest)
        return;
    if (share < SMALLER && seconds > 0.5 * (1.0 + share) * before && seconds < ALIKE * before) {
        double tail = fmin(seconds, (seconds - share * before) / (1.0 - share));
        size->tail = fmax(tail, size->tail);
        size->has_tail = true;
    }
    if (share < SMALLER || share > 1.0) {
        size->slow_work = work;
        size->slow_seconds = seconds;
    }
}

void hd_launch_size_note(HdLaunchSize *size, double work, double seconds) {
    if (2.0 * work < (double)size->least)
        return;
    look_for_tail(size, work, seconds);
    const double longest = fmax(TAILS * size->tail, size->longest), aim = HD_LAUNCH_AIM * longest;
    const double growth = seconds > aim / MAX_GROWTH ? aim / seconds : MAX_GROWTH;
    int fitting = within(fmax(growth, MIN_SHRINKING) * work, size->least, size->ceiling);
    if (seconds > longest) {
        size->too_long = true;
        size->ceiling = size->limit = hd_min(fitting, size->limit);
    } else {
        size->limit = hd_max(fitting, size->limit);
    }
}

/* ---- the queue of a wavefront ---- */

enum { MAX_STRIDE = INT_MAX / 4 };

/* Returns the samples whose rays and sums fit, at two rays each on as many ray depths as are
   likely. */
static int batch_samples(const HdWaveNeeds *needs, size_t ray_bytes) {
    size_t places = (size_t)wave_min_capacity(wave_min(needs->depth, WAVE_BATCH_LEVELS), 1);
    size_t fitting = needs->bytes / (places * ray_bytes + WAVE_SUMS * sizeof(int64_t));
    fitting = hd_min_size(fitting, MAX_STRIDE / places);
    if (fitting >= (size_t)needs->samples)
        return needs->samples;
    return hd_max((int)fitting / needs->samples_at_once, 1) * needs->samples_at_once;
}

/* Returns the queue's capacity: two places for each sample and ray depth, as far as they fit. */
static int queue_places(const HdWaveNeeds *needs, int batch, size_t ray_bytes) {
    int least = wave_min_capacity(needs->depth, needs->grain);
    size_t sums = WAVE_SUMS * sizeof(int64_t) * (size_t)batch;
    size_t fitting = needs->bytes > sums ? (needs->bytes - sums) / ray_bytes : 0;
    int even = (batch + needs->grain - 1) / needs->grain * needs->grain;
    size_t useful = (size_t)wave_min_capacity(needs->depth, 1) * (size_t)even;
    fitting = hd_min_size(fitting, hd_min_size(useful, MAX_STRIDE));
    return hd_max((int)fitting, least);
}

HdWavePlan hd_wave_plan(const HdWaveNeeds *needs) {
    size_t real_size = needs->precision == HD_PRECISION_DOUBLE ? sizeof(double) : sizeof(float);
    size_t ray_bytes = WAVE_REALS * real_size + WAVE_INTS * sizeof(int32_t);
    HdWavePlan plan;
    plan.sum_stride = batch_samples(needs, ray_bytes);
    /* An odd number of packets, so that a ray's numbers do not all fall into one set of a cache. */
    int packets = (queue_places(needs, plan.sum_stride, ray_bytes) + WAVE_SPARE - 1) / WAVE_SPARE;
    plan.queue_stride = (packets | 1) * WAVE_SPARE;
    plan.bytes[0] = real_size * (WAVE_REALS * (size_t)plan.queue_stride + WAVE_SPARE);
    plan.bytes[1] = sizeof(int32_t) * (WAVE_INTS * (size_t)plan.queue_stride + WAVE_SPARE);
    plan.bytes[2] = sizeof(int64_t) * (WAVE_SUMS * (size_t)plan.sum_stride + WAVE_SPARE);
    return plan;
}

bool hd_wave_halve(HdWaveNeeds *needs) {
    if (needs->bytes <= HD_WAVE_MIN_BYTES)
        return false;
    needs->bytes = needs->bytes / 2 > HD_WAVE_MIN_BYTES ? needs->bytes / 2 : HD_WAVE_MIN_BYTES;
    return true;
}

int hd_wave_samples(int items, int samples_per_item) {
    return hd_min(items, MAX_STRIDE / samples_per_item) * samples_per_item;
}

int hd_wave_groups(const HdWavePlan *plan, int group_size, int grid) {
    enum { MAX_GROUPS = 1 << 15 };
    int threads = hd_max(plan->queue_stride, plan->sum_stride);
    return hd_min((threads + group_size - 1) / group_size, grid > 0 ? grid : (int)MAX_GROUPS);
}

/* The batch is empty after the last item. */
static void begin_batch(HdWaveRun *run) {
    HdWaveStep *step = &run->step;
    step->first_item += step->item_count;
    step->item_count =
        hd_min(run->items - step->first_item, run->plan->sum_stride / run->samples_per_item);
    run->top = -1;
    wave_put(run->stack, &run->top, 0, 0, step->item_count * run->samples_per_item);
}

HdStatus hd_wave_next(HdWaveRun *run, unsigned taken, const HdLaunchSize *size, HdError *error) {
    HdWaveStep *step = &run->step;
    step->is_first = step->item_count == 0;
    if (step->is_first || step->action == HD_WAVE_STORES)
        begin_batch(run);
    else
        wave_put(run->stack, &run->top, step->chunk.level + 1, step->chunk.to,
                 (int)(taken - step->taken_before));
    step->taken_before = taken;
    step->action = step->item_count == 0 ? HD_WAVE_IS_DONE
                   : run->top < 0        ? HD_WAVE_STORES
                                         : HD_WAVE_TRACES;
    if (step->action != HD_WAVE_TRACES)
        return HD_OK;
    if (hd_interrupt_signal() != 0)
        return hd_fail(error, HD_INTERRUPTED, "interrupted during a frame");
    int limit = hd_launch_size_items(size, run->stack[run->top].waiting, 1, run->grain);
    step->chunk = wave_take_chunk(run->stack, &run->top, run->depth, run->plan->queue_stride,
                                  run->grain, limit);
    return HD_OK;
}
