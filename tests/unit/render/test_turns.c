/* SPDX-License-Identifier: MIT */
#include "render/turns.h"
#include "unit_test.h"

static HdTurn gpu(double seconds) {
    return (HdTurn){.seconds = seconds};
}

static HdTurn cpu(double seconds) {
    return (HdTurn){.is_cpu = true, .seconds = seconds};
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

TEST(alike_all_want_while_there_is_enough) {
    HdTurns turns = turns_of(3, gpu(1.0), gpu(1.0), gpu(1.0));
    assert_int_equal(wanting(&turns, 3, 0.0), 7);
    assert_int_equal(wanting(&turns, 2, 0.0), 3);
    assert_int_equal(wanting(&turns, 1, 0.0), 1);
}

/* A frame that takes 10 s is worth beginning if the others need as long for what is left. */
TEST(slow_ones_leave_the_last_frames_to_others) {
    HdTurns turns = turns_of(2, gpu(1.0), cpu(9.5), gpu(0.0));
    assert_int_equal(wanting(&turns, 10, 0.0), 3);
    assert_int_equal(wanting(&turns, 9, 0.0), 1);
    turns.list[0].busy_until = 5.0; /* with what it has already */
    assert_int_equal(wanting(&turns, 5, 0.0), 3);
    assert_int_equal(wanting(&turns, 4, 0.0), 1);
    assert_int_equal(wanting(&turns, 5, 5.0), 1);
    turns.list[1].busy_until = 1.0;
    assert_int_equal(wanting(&turns, 5, 0.0), 1);
}

TEST(whoever_is_left_wants) {
    HdTurns turns = turns_of(2, gpu(1.0), cpu(1000.0), gpu(0.0));
    assert_int_equal(wanting(&turns, 1, 0.0), 1);
    hd_turns_leave(&turns, 0);
    assert_true(hd_turns_want(&turns, 1, 1, 0.0));
}

TEST(a_new_one_takes_one_frame) {
    HdTurns turns = turns_of(2, gpu(1.0), gpu(0.0), gpu(0.0));
    assert_int_equal(wanting(&turns, 1, 0.0), 3);
    hd_turns_begun(&turns, 1, 0.0);
    assert_int_equal(wanting(&turns, 100, 0.0), 1);
    hd_turns_finished(&turns, 1, 2.0, 2.0);
    assert_int_equal(wanting(&turns, 100, 2.0), 3);
}

/* It begins frames before it is known how long they take. */
TEST(one_alone_takes_what_it_gets) {
    HdTurns turns = turns_of(2, gpu(0.0), gpu(0.0), gpu(0.0));
    turns.count = 1;
    for (int i = 0; i < 3; i++) {
        assert_true(hd_turns_want(&turns, 0, 1, 0.0));
        hd_turns_begun(&turns, 0, 0.0);
    }
}

TEST(cpus_wait_for_gpus) {
    HdTurns turns = turns_of(3, gpu(1.0), gpu(0.0), cpu(1.0));
    assert_int_equal(wanting(&turns, 100, 0.0), 3);
    turns.list[2].seconds = 0.0;
    assert_int_equal(wanting(&turns, 100, 0.0), 3);
    hd_turns_estimate(&turns, 1, 1.0);
    assert_int_equal(wanting(&turns, 100, 0.0), 7);
    turns.list[1].seconds = 0.0;
    turns.list[1].is_gone = true;
    assert_int_equal(wanting(&turns, 100, 0.0) & 4, 4);
    HdTurns cpus = turns_of(2, cpu(0.0), cpu(0.0), gpu(0.0));
    assert_int_equal(wanting(&cpus, 100, 0.0), 3);
}

TEST(frames_under_way_count) {
    HdTurns turns = turns_of(2, gpu(4.0), gpu(4.0), gpu(0.0));
    const HdTurn *turn = &turns.list[0];
    hd_turns_begun(&turns, 0, 10.0);
    expect_near(turn->busy_until, 14.0, 1e-12);
    hd_turns_begun(&turns, 0, 11.0);
    expect_near(turn->busy_until, 18.0, 1e-12);
    assert_int_equal(turn->in_flight, 2);
    hd_turns_finished(&turns, 0, 2.0, 12.0);
    expect_near(turn->seconds, 3.0, 1e-12);
    expect_near(turn->busy_until, 15.0, 1e-12);
    assert_int_equal(turn->in_flight, 1);
    hd_turns_given_back(&turns, 0, 13.0);
    expect_near(turn->busy_until, 13.0, 1e-12);
    assert_int_equal(turn->in_flight, 0);
}
