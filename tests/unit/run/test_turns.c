/* SPDX-License-Identifier: MIT */
#include "run/turns.h"
#include "unit_test.h"

/* A tracer that takes so many seconds a frame; 0: nobody knows yet. */
#define GPU(time)                                                                                  \
    (HdTurn) {                                                                                     \
        .seconds = (time)                                                                          \
    }
#define CPU(time)                                                                                  \
    (HdTurn) {                                                                                     \
        .is_cpu = true, .seconds = (time)                                                          \
    }

static HdTurns turns_of(int count, HdTurn first, HdTurn second, HdTurn third) {
    return (HdTurns){
        .mutex = PTHREAD_MUTEX_INITIALIZER, .list = {first, second, third}, .count = count};
}

/* A bit for each of the tracers that want a frame. */
static int wanting(HdTurns *turns, int left, double now) {
    int all = 0;
    for (int i = 0; i < turns->count; i++)
        if (hd_turns_want(turns, i, left, now))
            all |= 1 << i;
    return all;
}

/* A frame that takes 10 s is worth beginning if the others need as long for what is left. */
TEST(slow_ones_leave_the_last_frames_to_others) {
    HdTurns turns = turns_of(2, GPU(1.0), CPU(9.5), GPU(0.0));
    assert_int_equal(wanting(&turns, 10, 0.0), 3);
    assert_int_equal(wanting(&turns, 9, 0.0), 1);
    turns.list[0].busy_until = 5.0; /* with what it has already */
    assert_int_equal(wanting(&turns, 5, 0.0), 3);
    assert_int_equal(wanting(&turns, 4, 0.0), 1);
    assert_int_equal(wanting(&turns, 5, 5.0), 1);
    turns.list[1].busy_until = 1.0;
    assert_int_equal(wanting(&turns, 5, 0.0), 1);
    HdTurns alike = turns_of(3, GPU(1.0), GPU(1.0), GPU(1.0));
    assert_int_equal(wanting(&alike, 3, 0.0), 7);
    assert_int_equal(wanting(&alike, 2, 0.0), 3);
}

/* One alone begins frames before it is known how long they take. */
TEST(a_new_one_takes_one_frame_unless_it_is_alone) {
    HdTurns turns = turns_of(2, GPU(1.0), GPU(0.0), GPU(0.0));
    assert_int_equal(wanting(&turns, 1, 0.0), 3);
    hd_turns_begun(&turns, 1, 0.0);
    assert_int_equal(wanting(&turns, 100, 0.0), 1);
    hd_turns_ended(&turns, 1, 2.0, 2.0);
    assert_int_equal(wanting(&turns, 100, 2.0), 3);
    turns = turns_of(1, GPU(0.0), GPU(0.0), GPU(0.0));
    hd_turns_begun(&turns, 0, 0.0);
    assert_int_equal(wanting(&turns, 1, 0.0), 1);
    /* So does one that is left alone, however slow. */
    turns = turns_of(2, GPU(1.0), CPU(1000.0), GPU(0.0));
    assert_int_equal(wanting(&turns, 1, 0.0), 1);
    hd_turns_leave(&turns, 0);
    assert_true(hd_turns_want(&turns, 1, 1, 0.0));
}

TEST(cpus_wait_for_gpus) {
    HdTurns turns = turns_of(3, GPU(1.0), GPU(0.0), CPU(1.0));
    assert_int_equal(wanting(&turns, 100, 0.0), 3);
    turns.list[2].seconds = 0.0;
    assert_int_equal(wanting(&turns, 100, 0.0), 3);
    hd_turns_estimate(&turns, 1, 1.0);
    assert_int_equal(wanting(&turns, 100, 0.0), 7);
    turns.list[1].seconds = 0.0;
    turns.list[1].is_gone = true;
    assert_int_equal(wanting(&turns, 100, 0.0) & 4, 4);
    HdTurns cpus = turns_of(2, CPU(0.0), CPU(0.0), GPU(0.0));
    assert_int_equal(wanting(&cpus, 100, 0.0), 3);
}

TEST(frames_under_way_count) {
    HdTurns turns = turns_of(2, GPU(4.0), GPU(4.0), GPU(0.0));
    const HdTurn *turn = &turns.list[0];
    hd_turns_begun(&turns, 0, 10.0);
    hd_turns_begun(&turns, 0, 11.0);
    expect_near(turn->busy_until, 18.0, 1e-12);
    hd_turns_ended(&turns, 0, 2.0, 12.0);
    expect_near(turn->seconds, 3.0, 1e-12);
    expect_near(turn->busy_until, 15.0, 1e-12);
    assert_int_equal(turn->in_flight, 1);
    hd_turns_ended(&turns, 0, 0.0, 13.0);
    expect_near(turn->busy_until, 13.0, 1e-12);
    assert_int_equal(turn->in_flight, 0);
}
