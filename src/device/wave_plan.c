/* SPDX-License-Identifier: MIT */
#include "device/wave_plan.h"

#include <limits.h>
#include <stdint.h>
#include <stdio.h>

#include "base/limits.h"
#include "kernels/host/shared.h"
#include "system/interrupt.h"
#include "tables/room.h"

enum { MAX_STRIDE = INT_MAX / 4 };

static int round_up(int count, int grain) {
    return (count + grain - 1) / grain * grain;
}

/* Samples whose rays and sums fit, if each had two rays on as many levels as are likely. */
static int batch_samples(const HdWaveNeeds *needs, size_t ray_bytes) {
    size_t places = (size_t)wave_least_capacity(wave_lesser(needs->depth, WAVE_BATCH_LEVELS), 1);
    size_t fitting = needs->bytes / (places * ray_bytes + WAVE_SUMS * sizeof(int64_t));
    size_t most = MAX_STRIDE / places;
    fitting = fitting < most ? fitting : most;
    if (fitting >= (size_t)needs->samples)
        return needs->samples;
    int whole = (int)fitting / needs->samples_at_once * needs->samples_at_once;
    return whole > 0 ? whole : needs->samples_at_once;
}

/* The queue's room: two places for each sample and level, as far as they fit. */
static int queue_places(const HdWaveNeeds *needs, int batch, size_t ray_bytes) {
    int least = wave_least_capacity(needs->depth, needs->grain);
    size_t sums = WAVE_SUMS * sizeof(int64_t) * (size_t)batch;
    size_t fitting = needs->bytes > sums ? (needs->bytes - sums) / ray_bytes : 0;
    size_t useful =
        (size_t)wave_least_capacity(needs->depth, 1) * (size_t)round_up(batch, needs->grain);
    useful = useful < MAX_STRIDE ? useful : MAX_STRIDE;
    fitting = fitting < useful ? fitting : useful;
    return fitting > (size_t)least ? (int)fitting : least;
}

/* An odd number of bundles: a ray's numbers must not all fall into one set of a cache. */
static int spread_stride(int places) {
    int bundles = (places + WAVE_SPARE - 1) / WAVE_SPARE;
    return (bundles | 1) * WAVE_SPARE;
}

size_t hd_wave_budget(uint64_t device_memory) {
    const uint64_t most = 1 << 30;
    uint64_t share = device_memory / 8;
    return (size_t)(share < most ? share : most);
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
    needs->bytes /= 2;
    if (needs->bytes < HD_WAVE_LEAST_BYTES)
        needs->bytes = HD_WAVE_LEAST_BYTES;
    return true;
}

void hd_wave_tell_cut(size_t bytes, char *text, int capacity) {
    char room[HD_BYTE_TEXT_SIZE];
    hd_byte_text((double)bytes, room);
    snprintf(text, (size_t)capacity, ", the queue cut to %s, for more memory was refused", room);
}

typedef struct Run {
    const HdWavePlan *plan;
    const HdWaveFrame *frame;
    const HdWaveDevice *device;
    unsigned taken;
    bool has_begun;
} Run;

/* Takes as many rays as there is room for, at most what one launch may have. */
static WaveTake take_rays(const Run *run, WaveSegment *stack, int *top) {
    int grain = run->frame->grain;
    int limit = hd_launch_size_items(run->device->size, stack[*top].waiting, 1, grain);
    return wave_take(stack, top, run->frame->depth, run->plan->queue_stride, grain, limit);
}

static HdStatus trace_batch(Run *run, int first_item, int samples, HdError *error) {
    WaveSegment stack[WAVE_STACK_SIZE(HD_MAX_DEPTH)];
    int top = -1;
    wave_put(stack, &top, 0, 0, samples);
    while (top >= 0) {
        if (hd_interrupt_signal() != 0)
            return hd_fail(error, HD_INTERRUPTED, "interrupted in the midst of a frame");
        WaveTake take = take_rays(run, stack, &top);
        HdWaveStep step = {
            .first_item = first_item,
            .level = take.level,
            .first = take.first,
            .count = take.count,
            .to = take.to,
            .taken_before = run->taken,
            .is_first = !run->has_begun,
        };
        HdStatus status = run->device->trace(run->device->context, &step, &run->taken, error);
        if (status != HD_OK)
            return status;
        run->has_begun = true;
        wave_put(stack, &top, take.level + 1, take.to, (int)(run->taken - step.taken_before));
    }
    return HD_OK;
}

int hd_wave_samples(int items, int samples_per_item) {
    int most = MAX_STRIDE / samples_per_item;
    return (items < most ? items : most) * samples_per_item;
}

int hd_wave_groups(const HdWavePlan *plan, int group_size, int grid) {
    enum { MAX_GROUPS = 1 << 15 };
    int groups = (plan->queue_stride + group_size - 1) / group_size;
    int samples = (plan->sum_stride + group_size - 1) / group_size;
    int most = grid > 0 ? grid : (int)MAX_GROUPS;
    groups = groups > samples ? groups : samples;
    return groups < most ? groups : most;
}

HdStatus hd_wave_run(const HdWavePlan *plan, const HdWaveFrame *frame, const HdWaveDevice *device,
                     HdError *error) {
    Run run = {.plan = plan, .frame = frame, .device = device};
    int batch = plan->sum_stride / frame->samples_per_item;
    HdStatus status = HD_OK;
    for (int first = 0; status == HD_OK && first < frame->items; first += batch) {
        int count = frame->items - first < batch ? frame->items - first : batch;
        status = trace_batch(&run, first, count * frame->samples_per_item, error);
        if (status == HD_OK)
            status = device->store(device->context, first, count, error);
    }
    return status;
}
