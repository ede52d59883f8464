/* SPDX-License-Identifier: MIT */
#include "expect.h"
#include "render/tracer_pace.h"

static HdTracerPace gpu(double seconds) {
    return (HdTracerPace){.seconds = seconds};
}

static HdTracerPace cpu(double seconds) {
    return (HdTracerPace){.is_cpu = true, .seconds = seconds};
}

/* A bit for each of the tracers that want a frame. */
static int wanting(const HdTracerPace *paces, int count, int left, double now) {
    int all = 0;
    for (int i = 0; i < count; i++)
        if (hd_tracer_pace_wants(paces, count, i, left, now))
            all |= 1 << i;
    return all;
}

static void alike_all_want_while_there_is_enough(void **state) {
    (void)state;
    const HdTracerPace paces[3] = {gpu(1.0), gpu(1.0), gpu(1.0)};
    assert_int_equal(wanting(paces, 3, 3, 0.0), 7);
    assert_int_equal(wanting(paces, 3, 2, 0.0), 3);
    assert_int_equal(wanting(paces, 3, 1, 0.0), 1);
}

/* A frame that takes 10 s is worth beginning if the others need as long for what is left. */
static void slow_ones_leave_the_last_frames_to_others(void **state) {
    (void)state;
    HdTracerPace paces[2] = {gpu(1.0), cpu(9.5)};
    assert_int_equal(wanting(paces, 2, 10, 0.0), 3);
    assert_int_equal(wanting(paces, 2, 9, 0.0), 1);
    paces[0].busy_until = 5.0; /* with what it has already */
    assert_int_equal(wanting(paces, 2, 5, 0.0), 3);
    assert_int_equal(wanting(paces, 2, 4, 0.0), 1);
    assert_int_equal(wanting(paces, 2, 5, 5.0), 1);
    paces[1].busy_until = 1.0;
    assert_int_equal(wanting(paces, 2, 5, 0.0), 1);
}

static void whoever_is_left_wants(void **state) {
    (void)state;
    HdTracerPace paces[2] = {gpu(1.0), cpu(1000.0)};
    assert_int_equal(wanting(paces, 2, 1, 0.0), 1);
    paces[0].is_gone = true;
    assert_true(hd_tracer_pace_wants(paces, 2, 1, 1, 0.0));
}

static void a_new_one_takes_one_frame(void **state) {
    (void)state;
    HdTracerPace paces[2] = {gpu(1.0), gpu(0.0)};
    assert_int_equal(wanting(paces, 2, 1, 0.0), 3);
    hd_tracer_pace_begun(&paces[1], 0.0);
    assert_int_equal(wanting(paces, 2, 100, 0.0), 1);
    hd_tracer_pace_finished(&paces[1], 2.0, 2.0);
    assert_int_equal(wanting(paces, 2, 100, 2.0), 3);
}

static void cpus_wait_for_gpus(void **state) {
    (void)state;
    HdTracerPace paces[3] = {gpu(1.0), gpu(0.0), cpu(1.0)};
    assert_int_equal(wanting(paces, 3, 100, 0.0), 3);
    paces[2].seconds = 0.0;
    assert_int_equal(wanting(paces, 3, 100, 0.0), 3);
    paces[1].seconds = 1.0;
    assert_int_equal(wanting(paces, 3, 100, 0.0), 7);
    paces[1].seconds = 0.0;
    paces[1].is_gone = true;
    assert_int_equal(wanting(paces, 3, 100, 0.0) & 4, 4);
    HdTracerPace cpus[2] = {cpu(0.0), cpu(0.0)};
    assert_int_equal(wanting(cpus, 2, 100, 0.0), 3);
}

static void frames_under_way_count(void **state) {
    (void)state;
    HdTracerPace pace = gpu(4.0);
    hd_tracer_pace_begun(&pace, 10.0);
    expect_near(pace.busy_until, 14.0, 1e-12);
    hd_tracer_pace_begun(&pace, 11.0);
    expect_near(pace.busy_until, 18.0, 1e-12);
    assert_int_equal(pace.in_flight, 2);
    hd_tracer_pace_finished(&pace, 2.0, 12.0);
    expect_near(pace.seconds, 3.0, 1e-12);
    expect_near(pace.busy_until, 15.0, 1e-12);
    assert_int_equal(pace.in_flight, 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(alike_all_want_while_there_is_enough),
        cmocka_unit_test(slow_ones_leave_the_last_frames_to_others),
        cmocka_unit_test(whoever_is_left_wants),
        cmocka_unit_test(a_new_one_takes_one_frame),
        cmocka_unit_test(cpus_wait_for_gpus),
        cmocka_unit_test(frames_under_way_count),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
