/* SPDX-License-Identifier: MIT */
/* The order of tracing a wavefront's rays, on a device that only counts them. */
#include <signal.h>
#include <stdlib.h>

#include "device/launch_plan.h"
#include "kernels/host/shared.h"
#include "system/interrupt.h"
#include "unit_test.h"

/* Every ray has `children` continuing rays, which a launch appends with those of its group: places
   of dead rays are filled too. Negative: trees of a scene with an error bound, which widen at first
   and then thin out for hundreds of levels. */
typedef struct Account {
    const HdWavePlan *plan;
    const HdWaveRun *frame;
    int children;
    char *waits; /* 1 for each place of the queue whose ray is still to be traced */
    int64_t traced, steps;
    unsigned taken;
    int next_item;   /* the first one that is not stored */
    int batch_first; /* current item of the batch */
    int batch_samples;
} Account;

static int rays_going_on(const Account *account, const HdWaveStep *step) {
    int grain = account->frame->grain, groups = (step->chunk.count + grain - 1) / grain;
    if (step->chunk.level >= account->frame->depth)
        return 0;
    if (account->children < 0)
        return step->chunk.level < 4 ? step->chunk.count / 2 * 3 : step->chunk.count / 20 * 19;
    return account->children * groups * grain;
}

static void trace(Account *account, const HdWaveStep *step) {
    assert_true(step->chunk.count > 0);
    assert_int_equal(step->taken_before, account->taken);
    assert_int_equal(step->is_first, account->steps == 0);
    assert_in_range(step->chunk.level, 0, account->frame->depth);
    if (step->chunk.level == 0) {
        assert_int_equal(step->first_item, account->next_item);
        account->batch_samples += step->chunk.count;
        assert_true(step->chunk.first + step->chunk.count <= account->plan->sum_stride);
    }
    int going_on = rays_going_on(account, step);
    assert_true(step->chunk.to + going_on <= account->plan->queue_stride);
    for (int i = step->chunk.to; i < step->chunk.to + going_on; i++) {
        assert_false(account->waits[i]); /* nor is it being read */
        account->waits[i] = 1;
    }
    for (int i = step->chunk.first;
         step->chunk.level > 0 && i < step->chunk.first + step->chunk.count; i++) {
        assert_true(account->waits[i]);
        account->waits[i] = 0;
    }
    account->traced += step->chunk.count;
    account->steps++;
    account->taken += (unsigned)going_on;
}

static void store(Account *account, const HdWaveStep *step) {
    assert_int_equal(step->first_item, account->next_item);
    assert_int_equal(account->batch_samples, step->item_count * account->frame->samples_per_item);
    for (int i = 0; i < account->plan->queue_stride; i++)
        assert_false(account->waits[i]);
    account->batch_samples = 0;
    account->next_item += step->item_count;
}

/* Limit of one launch. */
static int launch_rays = HD_MAX_LAUNCH_WORK;

static int64_t steps; /* of the last frame */

/* Runs a frame; returns the number of rays traced. */
static int64_t run(size_t bytes, const HdWaveRun *frame, int children) {
    HdError error;
    HdWaveNeeds needs = {
        .bytes = bytes,
        .depth = frame->depth,
        .grain = frame->grain,
        .samples = frame->items * frame->samples_per_item,
        .samples_at_once = frame->samples_per_item,
    };
    HdWavePlan plan = hd_wave_plan(&needs);
    assert_true(plan.bytes[0] >= sizeof(float) * WAVE_REALS * (size_t)plan.queue_stride);
    HdLaunchSize size = hd_launch_size_fixed(launch_rays);
    Account account = {.plan = &plan, .frame = frame, .children = children};
    account.waits = calloc((size_t)plan.queue_stride, 1);
    HdWaveRun run = *frame;
    run.plan = &plan;
    while (hd_wave_next(&run, account.taken, &size, &error) == HD_OK &&
           run.step.action != HD_WAVE_IS_DONE)
        (run.step.action == HD_WAVE_STORES ? store : trace)(&account, &run.step);
    assert_int_equal(run.step.action, HD_WAVE_IS_DONE);
    assert_int_equal(account.next_item, frame->items);
    free(account.waits);
    steps = account.steps;
    return account.traced;
}

/* The account detects rays that overlap. It rounds up to groups only if they are split, so that it
   counts those of whole groups on each level. */
TEST(all_rays_are_traced_in_any_memory_by_launches_of_any_size) {
    static const int sizes[] = {1, 5, 32, 40, 150, HD_MAX_LAUNCH_WORK};
    static const size_t budgets[] = {1, 3000, 5000, 20000, 50000, 100000, 1 << 20, 1 << 28};
    for (size_t i = 0; i < 6 * 8 * 7 * 3; i++) {
        const int depth = (int)(i / 3 % 7), children = (int)(i % 3);
        const size_t bytes = budgets[i / 21 % 8];
        const HdWaveRun even = {.items = 24, .samples_per_item = 4, .depth = depth, .grain = 4},
                        uneven = {.items = 23, .samples_per_item = 9, .depth = depth, .grain = 32};
        int64_t expected = 0, of_level = 96;
        for (int level = 0; level <= depth; level++, of_level *= children)
            expected += of_level;
        launch_rays = sizes[i / 168];
        assert_int_equal(run(bytes, &even, children), expected);
        run(bytes, &uneven, children);
    }
}

/* With launches of at most their size, and enough memory, each level is a step for each. The rest
   of a deep tree's level would repeat all levels below it, so levels run whole. */
TEST(capacity_decides_the_number_of_steps) {
    const HdWaveRun frame = {.items = 64, .samples_per_item = 4, .depth = 5, .grain = 32};
    run(1 << 24, &frame, 1);
    assert_int_equal(steps, 6);
    run(20000, &frame, 1);
    const int64_t few = steps;
    run(1, &frame, 1);
    assert_true(few > 6 && steps > few);
    launch_rays = 64;
    run(1 << 24, &frame, 1);
    assert_int_equal(steps, 4 * 6);
    launch_rays = HD_MAX_LAUNCH_WORK;
    const HdWaveRun deep = {.items = 20000, .samples_per_item = 4, .depth = 500, .grain = 128};
    run((1 << 25) / 13 * 12, &deep, -1);
    assert_in_range(steps, 9 * 100, 9 * 110); /* nine batches, which live for 103 levels */
}

/* The places of a finished level serve the next one. */
TEST(rays_are_placed_below_their_parents) {
    WaveSegment stack[] = {{.level = 0},
                           {.level = 1, .first = 0, .waiting = 8},
                           {.level = 2, .first = 100, .waiting = 8}};
    int top = 2;
    const WaveChunk chunk = wave_take_chunk(stack, &top, 3, 1000, 4, WAVE_NO_LIMIT);
    assert_int_equal(chunk.count, 8);
    assert_int_equal(chunk.to, 8);
    assert_int_equal(top, 1);
}

TEST(plans_stay_within_their_budget) {
    const HdWaveNeeds few = {
        .bytes = 1 << 28, .depth = 4, .grain = 32, .samples = 1000, .samples_at_once = 10};
    assert_int_equal(hd_wave_plan(&few).sum_stride, 1000);
    for (int levels = 1; levels <= 40; levels++)
        assert_int_equal(wave_fitting(wave_min_capacity(levels, 4), levels, 4), 4);
    for (int depth = 1; depth <= 1000; depth = depth * 3 + 1)
        for (size_t bytes = 1 << 26; bytes <= (size_t)1 << 30; bytes *= 4) {
            HdWaveNeeds needs = {.bytes = bytes,
                                 .precision = HD_PRECISION_DOUBLE,
                                 .depth = depth,
                                 .grain = 128,
                                 .samples = hd_wave_samples(1 << 22, 16),
                                 .samples_at_once = 16};
            HdWavePlan plan = hd_wave_plan(&needs);
            size_t used = plan.bytes[0] + plan.bytes[1] + plan.bytes[2];
            assert_true(used < bytes + 10000);
            assert_true(used > bytes / 2);
            const size_t queue = (size_t)plan.queue_stride, sums = (size_t)plan.sum_stride;
            assert_true(plan.bytes[0] >= sizeof(double) * WAVE_REALS * queue);
            assert_true(plan.bytes[1] >= sizeof(int32_t) * WAVE_INTS * queue);
            assert_true(plan.bytes[2] >= sizeof(int64_t) * WAVE_SUMS * sums);
            assert_int_equal(plan.sum_stride % 16, 0);
            assert_true(plan.queue_stride >= wave_min_capacity(depth, 128));
        }
}

/* A device that refuses memory is asked for less, down to the minimum. */
TEST(a_refused_queue_is_halved) {
    HdWaveNeeds needs = {.bytes = 9 << 20};
    static const size_t expected[] = {9 << 19, 9 << 18, 9 << 17, HD_WAVE_MIN_BYTES};
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        assert_true(hd_wave_halve(&needs));
        assert_int_equal(needs.bytes, expected[i]);
    }
    assert_false(hd_wave_halve(&needs));
    needs.bytes = 1;
    assert_false(hd_wave_halve(&needs));
    assert_int_equal(needs.bytes, 1);
}

TEST(launches_have_the_groups_that_they_need) {
    static const int cases[][4] = {
        {1000, 3000, 0, 24}, {1000, 3000, 5, 5}, {3000, 1000, 0, 24}, {1 << 30, 1000, 0, 1 << 15}};
    for (int i = 0; i < 4; i++) {
        const HdWavePlan plan = {.queue_stride = cases[i][0], .sum_stride = cases[i][1]};
        assert_int_equal(hd_wave_groups(&plan, 128, cases[i][2]), cases[i][3]);
    }
}

/* The last test: a signal is remembered. */
TEST(a_signal_ends_the_frame) {
    HdError error;
    HdWavePlan plan = {.queue_stride = 64, .sum_stride = 64};
    HdWaveRun frame = {.plan = &plan, .items = 1, .samples_per_item = 1, .grain = 32};
    HdLaunchSize size = hd_launch_size_fixed(launch_rays);
    hd_interrupt_install();
    raise(SIGTERM);
    assert_int_equal(hd_wave_next(&frame, 0, &size, &error), HD_INTERRUPTED);
}
