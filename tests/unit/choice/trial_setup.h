/* SPDX-License-Identifier: MIT */
/* A job for a fake device, and a clock that is made up: each look at it takes `clock_step`, and
   each frame of the device with a number `frame_seconds` of that number. */
#ifndef HD_TEST_TRIAL_SETUP_H
#define HD_TEST_TRIAL_SETUP_H

#include "choice/trial.h"
#include "device/self_test_scenes.h"
#include "fake_backend.h"
#include "test_folder.h"
#include "wrapped.h"

static HdError error;
static HdRenderOptions options;
static HdScene scene;
static HdJob job;
static double now, clock_step, frame_seconds[2];

static double read_clock(void) {
    return now += clock_step;
}
REPLACE(hd_monotonic_seconds, read_clock)

static HdStatus take_time(FakePoint point, int index, HdError *failure) {
    (void)failure;
    now += point == FAKE_COLLECT ? frame_seconds[index] : 0.0;
    return HD_OK;
}

/* The arithmetic is fast, so that the kernels do not test themselves first. */
static void begin_trial(int frames) {
    memset(&fake, 0, sizeof fake);
    fake.event = take_time;
    setenv("HEDRON_CACHE", "cache", 1);
    options = (HdRenderOptions){.threads = 1, .math = HD_MATH_FAST};
    assert_int_equal(hd_self_test_scene(&scene, HD_SELF_TEST_SOLID, false, false, &error), HD_OK);
    scene.width = scene.height = 4;
    scene.samples_per_side = 1;
    job = (HdJob){.scene = &scene, .frame_count = frames};
}

static int end_trial(void **state) {
    (void)state;
    hd_scene_free(&scene);
    remove_folder("cache");
    return 0;
}

#endif
