/* SPDX-License-Identifier: MIT */
#include "run/frame_scheduler.h"
#include "unit_test.h"

/* A worker that takes so many seconds a frame; 0: unknown yet. */
#define GPU(time)                                                                                  \
    (HdScheduledWorker) {                                                                          \
        .seconds = (time)                                                                          \
    }
#define CPU(time)                                                                                  \
    (HdScheduledWorker) {                                                                          \
        .is_cpu = true, .seconds = (time)                                                          \
    }

static HdFrameScheduler scheduler_of(int count, HdScheduledWorker first, HdScheduledWorker second,
                                     HdScheduledWorker third) {
    return (HdFrameScheduler){
        .mutex = PTHREAD_MUTEX_INITIALIZER, .list = {first, second, third}, .count = count};
}

/* Returns a bit for each worker that wants a frame. */
static int wanting(HdFrameScheduler *scheduler, int left, double now) {
    int all = 0;
    for (int i = 0; i < scheduler->count; i++)
        if (hd_scheduler_wants(scheduler, i, left, now))
            all |= 1 << i;
    return all;
}

/* A frame of 10 s pays off if the others need as long for the rest. */
TEST(slow_workers_leave_the_last_frames_to_others) {
    HdFrameScheduler scheduler = scheduler_of(2, GPU(1.0), CPU(9.5), GPU(0.0));
    assert_int_equal(wanting(&scheduler, 10, 0.0), 3);
    assert_int_equal(wanting(&scheduler, 9, 0.0), 1);
    scheduler.list[0].busy_until = 5.0; /* counting its own frames */
    assert_int_equal(wanting(&scheduler, 5, 0.0), 3);
    assert_int_equal(wanting(&scheduler, 4, 0.0), 1);
    assert_int_equal(wanting(&scheduler, 5, 5.0), 1);
    scheduler.list[1].busy_until = 1.0;
    assert_int_equal(wanting(&scheduler, 5, 0.0), 1);
    HdFrameScheduler alike = scheduler_of(3, GPU(1.0), GPU(1.0), GPU(1.0));
    assert_int_equal(wanting(&alike, 3, 0.0), 7);
    assert_int_equal(wanting(&alike, 2, 0.0), 3);
}

/* A single worker begins frames before their time is known. */
TEST(a_new_one_takes_one_frame_unless_it_is_alone) {
    HdFrameScheduler scheduler = scheduler_of(2, GPU(1.0), GPU(0.0), GPU(0.0));
    assert_int_equal(wanting(&scheduler, 1, 0.0), 3);
    hd_scheduler_begun(&scheduler, 1, 0.0);
    assert_int_equal(wanting(&scheduler, 100, 0.0), 1);
    hd_scheduler_ended(&scheduler, 1, 2.0, 2.0);
    assert_int_equal(wanting(&scheduler, 100, 2.0), 3);
    scheduler = scheduler_of(1, GPU(0.0), GPU(0.0), GPU(0.0));
    hd_scheduler_begun(&scheduler, 0, 0.0);
    assert_int_equal(wanting(&scheduler, 1, 0.0), 1);
    /* So does the last remaining one, however slow. */
    scheduler = scheduler_of(2, GPU(1.0), CPU(1000.0), GPU(0.0));
    assert_int_equal(wanting(&scheduler, 1, 0.0), 1);
    hd_scheduler_leave(&scheduler, 0);
    assert_true(hd_scheduler_wants(&scheduler, 1, 1, 0.0));
}

TEST(cpus_wait_for_gpus) {
    HdFrameScheduler scheduler = scheduler_of(3, GPU(1.0), GPU(0.0), CPU(1.0));
    assert_int_equal(wanting(&scheduler, 100, 0.0), 3);
    scheduler.list[2].seconds = 0.0;
    assert_int_equal(wanting(&scheduler, 100, 0.0), 3);
    hd_scheduler_estimate(&scheduler, 1, 1.0);
    assert_int_equal(wanting(&scheduler, 100, 0.0), 7);
    scheduler.list[1].seconds = 0.0;
    scheduler.list[1].is_gone = true;
    assert_int_equal(wanting(&scheduler, 100, 0.0) & 4, 4);
    HdFrameScheduler cpus = scheduler_of(2, CPU(0.0), CPU(0.0), GPU(0.0));
    assert_int_equal(wanting(&cpus, 100, 0.0), 3);
}

TEST(frames_in_flight_count) {
    HdFrameScheduler scheduler = scheduler_of(2, GPU(4.0), GPU(4.0), GPU(0.0));
    const HdScheduledWorker *worker = &scheduler.list[0];
    hd_scheduler_begun(&scheduler, 0, 10.0);
    hd_scheduler_begun(&scheduler, 0, 11.0);
    expect_near(worker->busy_until, 18.0, 1e-12);
    hd_scheduler_ended(&scheduler, 0, 2.0, 12.0);
    expect_near(worker->seconds, 3.0, 1e-12);
    expect_near(worker->busy_until, 15.0, 1e-12);
    assert_int_equal(worker->count_in_flight, 1);
    hd_scheduler_ended(&scheduler, 0, 0.0, 13.0);
    expect_near(worker->busy_until, 13.0, 1e-12);
    assert_int_equal(worker->count_in_flight, 0);
}
