/* SPDX-License-Identifier: MIT */
/* Defaults for a device, its unsupported requests, and requests that any device supports. */
#include "device/backend.h"

#include "device/options.h"
#include "unit_test.h"

#define MEGA  HD_PIPELINE_MEGA
#define WAVES HD_PIPELINE_WAVEFRONT

enum { GPU, GPU_WITHOUT_ATOMICS, SHOWING_GPU, SHOWING_GPU_WITHOUT_ATOMICS, CPU };

static const HdDevice devices[] = {
    [GPU] = {.has_wide_atomics = true},
    [GPU_WITHOUT_ATOMICS] = {.name = "a GPU"},
    [SHOWING_GPU] = {.has_timeout = true, .has_wide_atomics = true},
    [SHOWING_GPU_WITHOUT_ATOMICS] = {.has_timeout = true},
    [CPU] = {.is_cpu = true, .has_double = true, .lanes = {1 | 4 | 8 | 16, 1 | 4 | 8}},
};

/* A display must not freeze for as long as a tree of hundreds of levels takes. */
TEST(pipelines_suit_devices_and_scenes) {
    static const struct {
        int device, endless_lights;
        HdRenderOptions options;
        HdPipeline expected;
    } cases[] = {
        {CPU, 0, {0}, MEGA},
        {CPU, 0, {.pipeline = WAVES}, WAVES},
        {CPU, 99, {0}, MEGA},
        {CPU, 100, {0}, WAVES},
        {CPU, 100, {.pipeline = MEGA}, MEGA},
        {GPU, 100, {0}, MEGA},
        {SHOWING_GPU, 0, {0}, MEGA},
        {SHOWING_GPU, 0, {.has_deep_trees = true}, WAVES},
        {SHOWING_GPU, 0, {.has_deep_trees = true, .pipeline = MEGA}, MEGA},
        {SHOWING_GPU_WITHOUT_ATOMICS, 0, {.has_deep_trees = true}, MEGA},
        {GPU, 0, {.has_deep_trees = true}, MEGA},
        {GPU, 0, {.has_deep_trees = true, .launch_ms = 100.0}, WAVES},
        {CPU, 0, {.has_deep_trees = true, .launch_ms = 100.0}, MEGA},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        HdLight lights[100] = {{.falloff = {.end = 0.0}}};
        const HdScene scene = {.lights = lights, .light_count = 100};
        for (int k = cases[i].endless_lights; k < 100; k++)
            lights[k].falloff.end = 2.0;
        const HdPipeline found =
            hd_choose_pipeline(&devices[cases[i].device], &cases[i].options, &scene);
        if (found != cases[i].expected)
            fail_msg("case %zu takes %s", i, hd_pipeline_names[found]);
    }
    assert_int_equal(hd_choose_pipeline(&devices[CPU], &(HdRenderOptions){0}, NULL), MEGA);
}

static void expect_unsupported(const HdDevice *device, HdRenderOptions options,
                               const char *expected) {
    const char *found = hd_device_unsupported_reason(device, &options);
    if (expected == NULL)
        assert_null(found);
    else
        assert_string_equal(found, expected);
}

TEST(a_wavefront_of_groups_needs_wide_atomics) {
    static const char lack[] = "the wavefront pipeline needs 64-bit integer atomics, which the "
                               "device lacks; --pipeline mega would work";
    const HdRenderOptions waves = {.pipeline = HD_PIPELINE_WAVEFRONT};
    const HdDevice *lacking = &devices[GPU_WITHOUT_ATOMICS];
    expect_unsupported(lacking, waves, lack);
    expect_unsupported(lacking, (HdRenderOptions){.pipeline = HD_PIPELINE_WAVEFRONT_UNCOMPACTED},
                       lack);
    expect_unsupported(lacking, (HdRenderOptions){.pipeline = HD_PIPELINE_AUTO}, NULL);
    expect_unsupported(&devices[GPU], waves, NULL);
    expect_unsupported(&devices[CPU], waves, NULL);
}

TEST(lanes_that_the_device_lacks_are_refused) {
    static const struct {
        int offered;
        const char *unsupported_reason; /* to 16 lanes */
    } cases[] = {{1 | 4 | 8, "the processor has registers for 1, 4 or 8 lanes in this precision"},
                 {1 | 2 | 4, "the processor has registers for 1, 2 or 4 lanes in this precision"},
                 {1 | 4, "the processor has registers for 1 or 4 lanes in this precision"},
                 {1, "the processor has registers for 1 lane in this precision"},
                 {0, NULL}}; /* none is known */
    HdDevice cpu = devices[CPU];
    HdRenderOptions options = {.lanes = 16};
    expect_unsupported(&cpu, options, NULL);
    options.precision = HD_PRECISION_DOUBLE;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        cpu.lanes[HD_PRECISION_DOUBLE] = cases[i].offered;
        expect_unsupported(&cpu, options, cases[i].unsupported_reason);
    }
    options = (HdRenderOptions){.lanes = 2};
    expect_unsupported(&cpu, options,
                       "the processor has registers for 1, 4, 8 or 16 lanes in this precision");
    options.lanes = 8;
    expect_unsupported(&cpu, options, NULL);
}

TEST(launches_last_as_long_as_they_may) {
    HdRenderOptions options = {.launch_ms = 0.0};
    assert_true(hd_longest_launch(&devices[SHOWING_GPU], &options) == 0.05);
    assert_true(hd_longest_launch(&devices[GPU], &options) == 0.5);
    options.launch_ms = 0.5;
    assert_true(hd_longest_launch(&devices[GPU], &options) == 5e-4);
}

TEST(supported_requests_are_possible) {
    static const HdRenderOptions possible[] = {
        {.lanes = 1},
        {.lanes = 4},
        {.lanes = 16},
        {.threads = 1, .block = 32, .grid = 1},
        {.threads = 1024, .block = 256, .grid = 1 << 20},
        {.registers = 16, .launch_ms = 1.0},
        {.registers = 255, .launch_ms = 10000.0},
        {.pipeline = HD_PIPELINE_WAVEFRONT_UNCOMPACTED},
    };
    static const HdRenderOptions impossible[] = {
        {.lanes = -1},
        {.lanes = 3},
        {.threads = -1},
        {.threads = 1025},
        {.block = -32},
        {.block = 33},
        {.block = 288},
        {.grid = -1},
        {.grid = (1 << 20) + 1},
        {.registers = 15},
        {.registers = 256},
        {.launch_ms = 0.5},
        {.launch_ms = 10001.0},
        {.launch_ms = (double)NAN},
        {.pipeline = HD_PIPELINE_COUNT},
    };
    for (size_t i = 0; i < sizeof possible / sizeof *possible; i++)
        if (!hd_render_options_are_possible(&possible[i]))
            fail_msg("case %zu is not possible", i);
    for (size_t i = 0; i < sizeof impossible / sizeof *impossible; i++)
        if (hd_render_options_are_possible(&impossible[i]))
            fail_msg("case %zu is possible", i);
}
