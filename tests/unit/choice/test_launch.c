/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700
#include "choice/tuning.h"

#include "choice/record.h"
#include "trial_setup.h"

static HdDevice device;
static HdTuning tuning;

static int begin(void **state) {
    (void)state;
    begin_trial(1);
    frame_seconds[0] = 0.3;
    device = fake_device();
    device.has_wide_atomics = true;
    device.compute_units = 10;
    return 0;
}

/* ---- tuning ---- */

/* By what a frame's tracing is said to take; NULL: what it takes. */
static void tune(double (*seconds)(const HdRenderOptions *asked)) {
    fake.trace_seconds = seconds;
    assert_int_equal(hd_tune(&tuning, &device, &options, &job, &error), HD_OK);
    assert_true(tuning.count > 0 && tuning.best >= 0 && tuning.best < tuning.count);
}

static HdLaunch best(void) {
    return tuning.candidates[tuning.best].launch;
}

/* The GPU that likes the wavefront, 96 registers, groups of 256, 320 of them. */
static double picky(const HdRenderOptions *asked) {
    double seconds = asked->pipeline == HD_PIPELINE_WAVEFRONT ? 1.0 : 1.2;
    seconds *= asked->registers == 96 ? 0.9 : 1.0;
    seconds *= asked->block == 256 ? 0.9 : 1.0;
    return seconds * (asked->grid == 320 ? 0.9 : 1.0);
}

TEST(a_gpu_has_its_candidates_and_a_cpu_pipelines_and_lanes) {
    static const char *const candidates[][16] = {
        {"mega", "mega, at most 64 registers", "mega, at most 96 registers",
         "mega, at most 128 registers", "mega, at most 168 registers", "wavefront",
         "wavefront, at most 64 registers", "wavefront, at most 96 registers",
         "wavefront, at most 128 registers", "wavefront, at most 168 registers",
         "wavefront, groups of 64, at most 96 registers",
         "wavefront, groups of 128, at most 96 registers",
         "wavefront, groups of 256, at most 96 registers",
         "wavefront, groups of 256, at most 80 groups, at most 96 registers",
         "wavefront, groups of 256, at most 320 groups, at most 96 registers"},
        {"mega", "wavefront", "wavefront, 4 lanes", "wavefront, 8 lanes", "wavefront, 16 lanes"}};
    static const int best_of[] = {14, 1};
    device.nvidia_arch = 90;
    for (int is_cpu = 0; is_cpu < 2; is_cpu++) {
        int count = 0;
        device.is_cpu = is_cpu;
        tune(picky);
        for (; candidates[is_cpu][count] != NULL; count++) {
            char described[128];
            hd_launch_describe(&tuning.candidates[count].launch, described, sizeof described);
            assert_string_equal(described, candidates[is_cpu][count]);
        }
        assert_int_equal(tuning.count, count);
        assert_int_equal(tuning.best, best_of[is_cpu]);
        assert_true(tuning.candidates[0].seconds == 1.2);
        device.nvidia_arch = 0;
    }
}

TEST(what_the_options_fix_stays) {
    device.nvidia_arch = 90;
    options.pipeline = HD_PIPELINE_MEGA;
    options.block = 128;
    options.grid = 7;
    tune(picky);
    assert_int_equal(tuning.count, 5);
    for (int i = 0; i < tuning.count; i++) {
        assert_int_equal(tuning.candidates[i].launch.pipeline, HD_PIPELINE_MEGA);
        assert_int_equal(tuning.candidates[i].launch.block, 128);
        assert_int_equal(tuning.candidates[i].launch.grid, 7);
    }
    assert_int_equal(best().registers, 96);
}

static double nearly_alike(const HdRenderOptions *asked) {
    return asked->pipeline == HD_PIPELINE_WAVEFRONT ? 0.99 : asked->block > 0 ? 0.985 : 1.0;
}

/* The first time that it is measured, somebody else uses the machine. */
static double unlucky_once(const HdRenderOptions *asked) {
    if (asked->pipeline != HD_PIPELINE_WAVEFRONT)
        return 1.0;
    return fake.opened == 2 ? 1.4 : 0.5;
}

TEST(noise_decides_nothing) {
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

/* Nor is this a device of NVIDIA's, which alone have limits of registers. */
TEST(what_cannot_be_used_is_told) {
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

TEST(a_display_is_not_kept_by_deep_trees) {
    device.has_timeout = true;
    tune(likes_mega);
    assert_int_equal(best().pipeline, HD_PIPELINE_MEGA);
    options.has_deep_trees = true;
    tune(likes_mega);
    for (int i = 0; i < tuning.count; i++)
        assert_int_equal(tuning.candidates[i].launch.pipeline, HD_PIPELINE_WAVEFRONT);
    device.has_timeout = false;
    tune(likes_mega);
    assert_int_equal(best().pipeline, HD_PIPELINE_MEGA);
}

/* Of one candidate, which is measured once, and twice more after each of three stages. */
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

static const HdLaunch choice = {
    .pipeline = HD_PIPELINE_WAVEFRONT, .block = 64, .grid = 80, .registers = 96};

static void remember(void) {
    assert_int_equal(hd_launch_remember(&device, &options, &scene, &choice, &error), HD_OK);
}

static bool is_recalled(void) {
    HdLaunch launch;
    return hd_launch_recall(&launch, &device, &options, &scene);
}

/* It is meant for a device of the same name and driver, and for a like job. */
TEST(a_choice_is_remembered) {
    HdLaunch launch;
    assert_false(is_recalled());
    remember();
    device.index = 3;
    assert_true(hd_launch_recall(&launch, &device, &options, &scene));
    assert_memory_equal(&launch, &choice, sizeof launch);
    scene.width *= 4;
    assert_false(is_recalled());
    scene.width /= 4;
    snprintf(device.driver, sizeof device.driver, "driver 8");
    assert_false(is_recalled());
    device = fake_device();
    snprintf(device.name, sizeof device.name, "Fake 2000");
    assert_false(is_recalled());
}

/* Nor does a record that says otherwise change what they say. */
TEST(options_of_a_run_win) {
    static const HdRenderOptions fixed[] = {
        {.pipeline = HD_PIPELINE_MEGA}, {.block = 128}, {.grid = 2}, {.registers = 64}};
    remember();
    for (size_t i = 0; i < sizeof fixed / sizeof *fixed; i++) {
        HdLaunch launch;
        options = fixed[i];
        options.threads = 1;
        options.math = HD_MATH_FAST;
        const HdLaunch own = hd_launch_of(&options);
        assert_false(hd_launch_recall(&launch, &device, &options, &scene));
        assert_memory_equal(&launch, &own, sizeof own);
        remember();
        assert_false(is_recalled());
    }
}

TEST(nonsense_is_ignored) {
    static const HdLaunch wrong[] = {
        {.pipeline = HD_PIPELINE_COUNT}, {.lanes = 3},       {.lanes = 8},      {.block = 33},
        {.grid = HD_MAX_GRID + 1},       {.registers = 256}, {.registers = 15}, {.grid = -1}};
    static const char *const texts[] = {
        "pipeline 2, lanes 0, block 64, grid 80, registers 96\n", /* the only good one */
        "",
        "pipeline 2, lanes 0, block 64, grid 80, registers 96",
        "pipeline 2, lanes 0, block 64, grid 80, registers 96\nmore",
        "pipeline 2, lanes 0, block 64, grid 80",
        "pipeline x",
        "-1\n"};
    for (int i = 0; i < 8; i++) {
        assert_int_equal(hd_launch_remember(&device, &options, &scene, &wrong[i], &error), HD_OK);
        assert_false(is_recalled());
    }
    for (int i = 0; i < 7; i++) {
        assert_int_equal(hd_record_put("launch", &scene, &options, "fake Fake 1000 (driver 7)\n",
                                       texts[i], &error),
                         HD_OK);
        assert_int_equal(is_recalled(), i == 0);
    }
    remember();
    device.has_wide_atomics = false;
    assert_false(is_recalled());
}

static HdPipeline opened_pipeline;

static bool note_pipeline(const HdRenderOptions *asked) {
    opened_pipeline = asked->pipeline;
    return false;
}

static void expect_opened(bool is_tuned, HdPipeline pipeline) {
    HdTeamDevice opened = {.device = device};
    assert_int_equal(hd_launch_open(&opened, &options, &job, false, &error), HD_OK);
    hd_launch_close(&opened);
    assert_int_equal(opened.is_tuned, is_tuned);
    assert_int_equal(opened_pipeline, pipeline);
    if (is_tuned)
        assert_memory_equal(&opened.launch, &choice, sizeof choice);
}

TEST(what_is_remembered_is_opened) {
    HdRenderer *renderer;
    fake.refuses = note_pipeline;
    expect_opened(false, HD_PIPELINE_MEGA);
    remember();
    expect_opened(true, HD_PIPELINE_WAVEFRONT);
    /* To measure a candidate, though, is to measure that one. */
    assert_int_equal(hd_trial_open(&renderer, &device, &options, &job, &error), HD_OK);
    hd_renderer_close(renderer);
    assert_int_equal(opened_pipeline, HD_PIPELINE_MEGA);
}

/* ---- trials ---- */

static int measured;

static double fall(const HdRenderOptions *asked) {
    (void)asked;
    return 5.0 - (double)measured++;
}

static HdStatus measure(HdRenderer *renderer, double share, int times, HdTrialTime *time) {
    return hd_trial_measure(renderer, options.precision, &job, share, times, time, &error);
}

TEST(the_least_of_several_counts) {
    HdRenderer *renderer;
    HdTrialTime time;
    measured = 0;
    fake.trace_seconds = fall;
    scene.width = 64;
    scene.height = 32;
    assert_int_equal(hd_trial_open(&renderer, &device, &options, &job, &error), HD_OK);
    assert_int_equal(measure(renderer, 0.25, 3, &time), HD_OK);
    assert_int_equal(fake.rendered, 3);
    assert_true(time.trace_seconds == 3.0 && time.share == 0.25);
    assert_true(time.width == 32 && time.height == 16);
    expect_near(time.seconds, frame_seconds[0], 1e-9);
    measured = -100; /* rising */
    assert_int_equal(measure(renderer, 1e-9, 1, &time), HD_OK);
    assert_true(time.trace_seconds == 105.0);
    assert_true(time.width == 1 && time.height == 1);
    fake.fails = true;
    assert_int_equal(measure(renderer, 0.25, 3, &time), HD_FAILED);
    scene.eye = scene.target; /* which is no view */
    assert_int_equal(measure(renderer, 0.25, 1, &time), HD_BAD_INPUT);
    hd_renderer_close(renderer);
}

EACH(begin, end_trial)
