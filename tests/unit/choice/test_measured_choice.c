/* SPDX-License-Identifier: MIT */
/* Measured and remembered choices: the fastest device and its best launch. The clock is simulated:
   each reading takes `clock_step`, and each frame of the fake device takes `frame_seconds` of its
   number. */
#define _XOPEN_SOURCE 700
#include "choice/devices.h"
#include "fake_backend.h"
#include "render/backends.h"
#include "small_scene.h"
#include "test_folder.h"
#include "wrapped.h"

static HdError error;
static HdRenderOptions options;
static HdScene scene;
static HdJob job;
static HdDevice device;
static HdTuning tuning;
static HdCandidates candidates;
static HdDevice chosen; /* of the candidates */
static double now, clock_step, frame_seconds[2];

static double read_clock(void) {
    return now += clock_step;
}
REPLACE(hd_monotonic_seconds, read_clock)

static HdStatus advance_time(FakePoint point, int index, HdError *failure) {
    (void)failure;
    now += point == FAKE_COLLECT ? frame_seconds[index] : 0.0;
    return HD_OK;
}

enum { FAKE, C };

/* The arithmetic is fast, so that the kernels do not test themselves first. */
static int begin(void **state) {
    (void)state;
    int count;
    memset(&fake, 0, sizeof fake);
    fake.event = advance_time;
    clock_step = 0.0;
    frame_seconds[0] = 0.4;
    frame_seconds[1] = 0.0;
    setenv("HEDRON_CACHE", "cache", 1);
    options = (HdRenderOptions){.threads = 1, .math = HD_MATH_FAST};
    assert_int_equal(small_scene(&scene, "hexahedron", &error), HD_OK);
    scene.width = scene.height = 4;
    scene.samples_per_side = 1;
    job = (HdJob){.scene = &scene, .frame_count = 100};
    device = fake_device();
    device.has_wide_atomics = true;
    device.compute_units = 10;
    candidates = (HdCandidates){.selection = {.options = &options, .job = &job},
                                .count = 2,
                                .is_free = true,
                                .compared = 2,
                                .frame_seconds = 1.0};
    candidates.list[FAKE].device = fake_device();
    hd_backend_enumerate(&hd_backend_c, &candidates.list[C].device, 1, &count, &error);
    return 0;
}

static int end(void **state) {
    (void)state;
    hd_scene_free(&scene);
    remove_folder("cache");
    return 0;
}

EACH(begin, end)

/* ---- the fastest device ---- */

static HdStatus open_it(void) {
    HdTeamDevice opened;
    clock_step = 1e-3;
    candidates.why[0] = candidates.note[0] = '\0';
    HdStatus status = hd_candidates_open(&candidates, &opened, &error);
    if (status != HD_OK)
        return status;
    assert_non_null(opened.renderer);
    chosen = opened.device;
    hd_team_device_close(&opened);
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

TEST(the_fastest_is_taken_and_remembered) {
    static const char measured[] = "scene, 3 ms against 403 ms (fake 0)";
    static const char earlier[] = "measured earlier, 3 ms against 403 ms (fake 0)";
    expect_fastest(measured, 1);
    assert_int_equal(fake.rendered, 2);
    expect_fastest(earlier, 0);
    assert_int_equal(fake.rendered, 2);
    assert_string_equal(candidates.note, "");
    scene.width *= 4;
    expect_fastest(measured, 1);
    snprintf(candidates.list[FAKE].device.driver, 16, "driver 8");
    expect_fastest(measured, 1);
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
    candidates.compared = 1; /* only GPUs are requested */
    expect_chosen(&fake_backend, "");
}

/* Only a device that fails at work is tried again. */
TEST(unusable_devices_are_skipped) {
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

/* Measures 4096 samples if they take long enough; else more, until a job of so many frames surely
   takes less than the limit, or the picture is whole. */
TEST(the_estimate_scales_with_the_picture) {
    static const struct {
        double step, enough, expected;
    } cases[] = {
        {0.025, 0.0, 4 * 0.075}, {0.005, 0.0, 0.015}, {0.005, 6.1, 4 * 0.015}, {0.005, 5.9, 0.015}};
    HdRenderer *renderer;
    HdTrial trial;
    scene.solid_count = 0;
    scene.width = scene.height = 128;
    scene.samples_per_side = 1;
    assert_int_equal(hd_trial_open(&renderer, &candidates.list[C].device, &options, &job, &error),
                     HD_OK);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const HdTrialRequest selection = hd_trial_request(cases[i].enough);
        clock_step = cases[i].step;
        assert_int_equal(hd_trial(renderer, &job, &selection, &trial, &error), HD_OK);
        expect_near(trial.frame_seconds, cases[i].expected, 1e-6);
    }
    hd_renderer_close(renderer);
}

/* ---- tuning ---- */

/* Sets the reported tracing times of frames; NULL: the real ones. */
static void tune(double (*seconds)(const HdRenderOptions *asked)) {
    fake.trace_seconds = seconds;
    assert_int_equal(hd_tune(&tuning, &device, &options, &job, &error), HD_OK);
    assert_true(tuning.count > 0 && tuning.best >= 0 && tuning.best < tuning.count);
}

static HdRenderOptions best(void) {
    return tuning.candidates[tuning.best].options;
}

/* Prefers the wavefront, 96 registers, groups of 256, 320 of them, as some GPU may. */
static double picky(const HdRenderOptions *asked) {
    double seconds = asked->pipeline == HD_PIPELINE_WAVEFRONT ? 1.0 : 1.2;
    seconds *= asked->registers == 96 ? 0.9 : 1.0;
    seconds *= asked->block == 256 ? 0.9 : 1.0;
    return seconds * (asked->grid == 320 ? 0.9 : 1.0);
}

TEST(a_gpu_has_its_candidates_and_a_cpu_pipelines_and_lanes) {
    static const char *const expected[][18] = {
        {"mega", "mega, at most 64 registers", "mega, at most 80 registers",
         "mega, at most 96 registers", "mega, at most 128 registers", "mega, at most 168 registers",
         "wavefront", "wavefront, at most 64 registers", "wavefront, at most 80 registers",
         "wavefront, at most 96 registers", "wavefront, at most 128 registers",
         "wavefront, at most 168 registers", "wavefront, groups of 64, at most 96 registers",
         "wavefront, groups of 128, at most 96 registers",
         "wavefront, groups of 256, at most 96 registers",
         "wavefront, groups of 256, at most 80 groups, at most 96 registers",
         "wavefront, groups of 256, at most 320 groups, at most 96 registers"},
        {"mega", "wavefront", "wavefront, 2 lanes", "wavefront, 4 lanes", "wavefront, 16 lanes"}};
    static const int best_of[] = {16, 1};
    device.nvidia_arch = 90;
    for (int is_cpu = 0; is_cpu < 2; is_cpu++) {
        int count = 0;
        device.is_cpu = is_cpu;
        device.lanes[HD_PRECISION_FLOAT] = is_cpu ? 1 | 2 | 4 | 16 : 0;
        tune(picky);
        for (; expected[is_cpu][count] != NULL; count++) {
            char described[128];
            hd_launch_describe(&tuning.candidates[count].options, described, sizeof described);
            assert_string_equal(described, expected[is_cpu][count]);
        }
        assert_int_equal(tuning.count, count);
        assert_int_equal(tuning.best, best_of[is_cpu]);
        assert_true(tuning.candidates[0].seconds == 1.2);
        device.nvidia_arch = 0;
    }
}

TEST(values_fixed_by_options_stay) {
    device.nvidia_arch = 90;
    options.pipeline = HD_PIPELINE_MEGA;
    options.block = 128;
    options.grid = 7;
    tune(picky);
    assert_int_equal(tuning.count, 6);
    for (int i = 0; i < tuning.count; i++) {
        const HdRenderOptions *launch = &tuning.candidates[i].options;
        assert_true(launch->pipeline == HD_PIPELINE_MEGA && launch->block == 128 &&
                    launch->grid == 7);
    }
    assert_int_equal(best().registers, 96);
}

static double nearly_alike(const HdRenderOptions *asked) {
    return asked->pipeline == HD_PIPELINE_WAVEFRONT ? 0.99 : asked->block > 0 ? 0.985 : 1.0;
}

/* At its first measurement another program uses the machine. */
static double unlucky_once(const HdRenderOptions *asked) {
    if (asked->pipeline != HD_PIPELINE_WAVEFRONT)
        return 1.0;
    return fake.opened == 2 ? 1.4 : 0.5;
}

TEST(noise_does_not_decide) {
    tune(nearly_alike);
    assert_int_equal(tuning.best, 0);
    fake.opened = 0;
    tune(unlucky_once);
    assert_int_equal(best().pipeline, HD_PIPELINE_WAVEFRONT);
    assert_int_equal(best().block, 0);
}

static bool refuses_wavefronts_and_256(const HdRenderOptions *asked) {
    return asked->pipeline == HD_PIPELINE_WAVEFRONT || asked->block == 256;
}

/* This device is not NVIDIA's, which alone have limits of registers. */
TEST(unusable_devices_are_reported) {
    fake.refuses = refuses_wavefronts_and_256;
    tune(picky);
    assert_int_equal(tuning.count, 7);
    expect_contains(tuning.candidates[1].failure, "fake: it refuses");
    expect_contains(tuning.candidates[4].failure, "fake: it refuses");
    assert_string_equal(tuning.candidates[0].failure, "");
    assert_int_equal(best().pipeline, HD_PIPELINE_MEGA);
    assert_int_equal(best().block, 0);
    assert_int_equal(best().grid, 320);
    device.has_wide_atomics = false;
    tune(picky);
    expect_contains(tuning.candidates[1].failure, "64-bit integer atomics");
    fake.is_missing = true;
    assert_int_equal(hd_tune(&tuning, &device, &options, &job, &error), HD_UNAVAILABLE);
    expect_contains(error.message, "fake: it is missing");
}

static double likes_mega(const HdRenderOptions *asked) {
    return asked->pipeline == HD_PIPELINE_WAVEFRONT ? 2.0 : 1.0;
}

TEST(deep_trees_do_not_freeze_a_display) {
    device.has_timeout = true;
    tune(likes_mega);
    assert_int_equal(best().pipeline, HD_PIPELINE_MEGA);
    options.has_deep_trees = true;
    tune(likes_mega);
    for (int i = 0; i < tuning.count; i++)
        assert_int_equal(tuning.candidates[i].options.pipeline, HD_PIPELINE_WAVEFRONT);
    device.has_timeout = false;
    tune(likes_mega);
    assert_int_equal(best().pipeline, HD_PIPELINE_MEGA);
}

/* Runs of one candidate, which is measured once, and twice more after each of three stages. */
TEST(pictures_are_as_large_as_time_allows) {
    static const struct {
        double seconds;
        int side, found_in, times;
    } cases[] = {{0.3, 8, 2, 2}, {0.06, 8, 2, 8}, {0.04, 16, 4, 12}, {0.001, 16, 4, 40}};
    options.pipeline = HD_PIPELINE_MEGA;
    options.block = 64;
    options.grid = 1;
    scene.solid_count = 0;
    scene.width = scene.height = 16;
    scene.samples_per_side = 8;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        frame_seconds[0] = cases[i].seconds;
        fake.rendered = 0;
        tune(NULL);
        assert_int_equal(tuning.count, 1);
        assert_int_equal(tuning.width, cases[i].side);
        assert_int_equal(tuning.height, cases[i].side);
        assert_int_equal(fake.rendered, cases[i].found_in + 7 * cases[i].times);
    }
}

/* ---- remembering ---- */

static void remember(void) {
    HdTeamDevice measured = {.device = device, .options = options, .seconds = 1.0};
    measured.options.pipeline = HD_PIPELINE_WAVEFRONT;
    measured.options.block = 64;
    measured.options.grid = 80;
    measured.options.registers = 96;
    assert_int_equal(hd_measured_put(&measured, 1, &options, &scene, &error), HD_OK);
}

static HdTeamDevice opened;

/* Returns whether the record was used: the device opens, or refuses to. */
static bool is_recalled(void) {
    opened = (HdTeamDevice){.device = device};
    HdStatus status = hd_team_device_open(&opened, &options, &job, false, &error);
    assert_true(status == HD_OK || status == HD_UNAVAILABLE);
    hd_team_device_close(&opened);
    return opened.is_tuned;
}

/* A record applies to a device of the same name and driver, and to a similar job. */
TEST(a_choice_is_remembered) {
    fake.refuses = refuses_wavefronts_and_256;
    assert_false(is_recalled());
    remember();
    assert_true(is_recalled());
    expect_contains(error.message, "fake: it refuses");
    assert_true(opened.options.pipeline == HD_PIPELINE_WAVEFRONT && opened.options.block == 64 &&
                opened.options.grid == 80 && opened.options.registers == 96);
    device.index = 3;
    assert_true(is_recalled());
    scene.width *= 4;
    assert_false(is_recalled());
    scene.width /= 4;
    snprintf(device.driver, sizeof device.driver, "driver 8");
    assert_false(is_recalled());
    device = fake_device();
    snprintf(device.name, sizeof device.name, "Fake 2000");
    assert_false(is_recalled());
}

TEST(the_best_of_a_tuning_is_remembered) {
    device.nvidia_arch = 90;
    tune(picky);
    assert_int_equal(hd_tuning_remember(&tuning, &device, &options, &scene, &error), HD_OK);
    assert_true(is_recalled());
    assert_true(opened.options.pipeline == HD_PIPELINE_WAVEFRONT && opened.options.block == 256 &&
                opened.options.grid == 320 && opened.options.registers == 96);
}

/* Nor does a record with another choice change theirs. */
TEST(options_of_a_run_win) {
    static const HdRenderOptions fixed[] = {
        {.pipeline = HD_PIPELINE_MEGA}, {.block = 128}, {.grid = 2}, {.registers = 64}};
    remember();
    for (size_t i = 0; i < sizeof fixed / sizeof *fixed; i++) {
        options = fixed[i];
        options.threads = 1;
        options.math = HD_MATH_FAST;
        assert_false(is_recalled());
        assert_memory_equal(&opened.options, &options, sizeof options);
        remember();
        assert_false(is_recalled());
        assert_memory_equal(&opened.options, &options, sizeof options);
    }
}

TEST(nonsense_is_ignored) {
    static const struct {
        double seconds;
        HdRenderOptions options;
    } cases[] = {{1.0, {.block = 64, .grid = 80}}, /* the only good one */
                 {-1.0, {.block = 64, .grid = 80}},
                 {(double)NAN, {.block = 64, .grid = 80}},
                 {1.0, {.pipeline = HD_PIPELINE_COUNT}},
                 {1.0, {.lanes = 3}},
                 {1.0, {.lanes = 8}},
                 {1.0, {.grid = HD_MAX_GRID + 1}}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const HdTeamDevice measured = {
            .device = device, .options = cases[i].options, .seconds = cases[i].seconds};
        assert_int_equal(hd_measured_put(&measured, 1, &options, &scene, &error), HD_OK);
        assert_int_equal(is_recalled(), i == 0);
    }
    remember();
    device.has_wide_atomics = false;
    assert_false(is_recalled());
}

/* ---- trials ---- */

static int measured;

static double fall(const HdRenderOptions *asked) {
    (void)asked;
    return 5.0 - (double)measured++;
}

static HdStatus measure(HdRenderer *renderer, double share, int times, HdTrial *trial) {
    const HdTrialRequest selection = {.share = share, .times = times};
    return hd_trial(renderer, &job, &selection, trial, &error);
}

TEST(the_smallest_of_several_counts) {
    HdRenderer *renderer;
    HdTrial trial;
    measured = 0;
    fake.trace_seconds = fall;
    scene.width = 64;
    scene.height = 32;
    assert_int_equal(hd_trial_open(&renderer, &device, &options, &job, &error), HD_OK);
    assert_int_equal(measure(renderer, 0.25, 3, &trial), HD_OK);
    assert_int_equal(fake.rendered, 3);
    assert_true(trial.trace_seconds == 3.0 && trial.share == 0.25);
    assert_true(trial.width == 32 && trial.height == 16);
    expect_near(trial.seconds, frame_seconds[0], 1e-9);
    measured = -100; /* rising */
    assert_int_equal(measure(renderer, 1e-9, 1, &trial), HD_OK);
    assert_true(trial.trace_seconds == 105.0);
    assert_true(trial.width == 1 && trial.height == 1);
    fake.fails = true;
    assert_int_equal(measure(renderer, 0.25, 3, &trial), HD_FAILED);
    scene.eye = scene.target; /* which is no view */
    assert_int_equal(measure(renderer, 0.25, 1, &trial), HD_BAD_INPUT);
    hd_renderer_close(renderer);
}
