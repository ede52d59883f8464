/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700
#include "choice/fastest_device.h"

#include "trial_setup.h"

enum { FAKE, C };

static HdCandidates candidates;
static HdDevice chosen;

static int begin(void **state) {
    (void)state;
    int count;
    begin_trial(100);
    clock_step = 1e-3;
    frame_seconds[0] = 0.4;
    frame_seconds[1] = 0.0;
    candidates = (HdCandidates){.wish = {.options = &options, .job = &job},
                                .count = 2,
                                .is_free = true,
                                .compared = 2,
                                .frame_seconds = 1.0};
    candidates.list[FAKE].device = fake_device();
    hd_backend_enumerate(&hd_backend_c, &candidates.list[C].device, 1, &count, &error);
    return 0;
}

static HdStatus open_it(void) {
    HdTeamDevice opened;
    candidates.why[0] = candidates.note[0] = '\0';
    HdStatus status = hd_fastest_open(&candidates, &opened, &error);
    if (status != HD_OK)
        return status;
    assert_non_null(opened.renderer);
    chosen = opened.device;
    hd_launch_close(&opened);
    for (int i = 0; i < candidates.count; i++)
        candidates.list[i].renderer = NULL;
    return status;
}

static void expect_chosen(const HdBackend *backend, const char *reason) {
    assert_int_equal(open_it(), HD_OK);
    assert_ptr_equal(chosen.backend, backend);
    expect_contains(candidates.why, reason);
}

/* `opened`: how many times the fake device is opened for it. */
static void expect_fastest(const char *when, int opened) {
    fake.opened = 0;
    expect_chosen(&hd_backend_c, "the fastest of 2 on this kind of scene, ");
    expect_contains(candidates.why, when);
    assert_int_equal(fake.opened, opened);
}

static const char now_measured[] = "scene, 3 ms against 403 ms (fake 0)";
static const char earlier[] = "measured earlier, 3 ms against 403 ms (fake 0)";

TEST(the_fastest_is_taken_and_remembered) {
    expect_fastest(now_measured, 1);
    assert_int_equal(fake.rendered, 2);
    expect_fastest(earlier, 0);
    assert_int_equal(fake.rendered, 2);
    assert_string_equal(candidates.note, "");
    scene.width *= 4;
    expect_fastest(now_measured, 1);
    options.precision = HD_PRECISION_DOUBLE;
    expect_fastest(now_measured, 1);
    snprintf(candidates.list[FAKE].device.driver, 16, "driver 8");
    expect_fastest(now_measured, 1);
    expect_fastest(earlier, 0);
}

TEST(order_decides_nothing) {
    candidates.list[1] = candidates.list[0];
    candidates.list[1].device.index = 1;
    for (int slow = 0; slow < 2; slow++) {
        frame_seconds[slow] = 0.4;
        frame_seconds[1 - slow] = 0.0;
        expect_chosen(&fake_backend, "the fastest of 2 on this kind of scene, ");
        assert_int_equal(chosen.index, 1 - slow);
        remove_folder("cache");
    }
}

TEST(a_job_too_short_is_not_measured) {
    job.frame_count = 1;
    expect_chosen(&hd_backend_c, "it needs about 1 s, too little to measure");
    assert_int_equal(fake.opened, 0);
    candidates.compared = 1; /* only GPUs are wanted */
    expect_chosen(&fake_backend, "");
}

/* Only what fails at work is tried again. */
TEST(what_cannot_be_used_is_passed_over) {
    static const char *const notes[] = {"fake: Fake 1000 (driver 7) computes wrongly",
                                        "fake: it is missing", "fake: it fails"};
    for (int i = 0; i < 3; i++) {
        fake.renders_wrongly = i == 0;
        options.math = i == 0 ? HD_MATH_STRICT : HD_MATH_FAST;
        fake.is_missing = i == 1;
        fake.fails = i == 2;
        expect_chosen(&hd_backend_c, "the fastest of 2 on this kind of scene");
        expect_contains(candidates.note, notes[i]);
        fake.opened = 0;
        expect_chosen(&hd_backend_c, i == 2 ? "the fastest of 2" : "measured earlier");
        assert_int_equal(fake.opened, i == 2);
        remove_folder("cache");
    }
    fake.is_missing = true;
    candidates.compared = 1;
    expect_chosen(&hd_backend_c, "the next after one that cannot be used");
    expect_contains(candidates.note, "fake: it is missing");
    candidates.count = 1;
    assert_int_equal(open_it(), HD_UNAVAILABLE);
    expect_contains(error.message, "fake: it is missing");
}

/* Of 4096 samples where they take long enough to be believed; else of more, until a job of so many
   frames surely takes less than is enough, or the picture is whole. */
TEST(the_estimate_scales_with_the_picture) {
    static const struct {
        double step, enough, expected;
    } cases[] = {
        {0.025, 0.0, 4 * 0.075}, {0.005, 0.0, 0.015}, {0.005, 6.1, 4 * 0.015}, {0.005, 5.9, 0.015}};
    double seconds;
    scene.solid_count = 0;
    scene.width = scene.height = 128;
    scene.samples_per_side = 1;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        clock_step = cases[i].step;
        assert_int_equal(hd_trial_estimate(&options, &job, cases[i].enough, &seconds, &error),
                         HD_OK);
        expect_near(seconds, cases[i].expected, 1e-6);
    }
}

EACH(begin, end_trial)
