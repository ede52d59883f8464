/* SPDX-License-Identifier: MIT */
/* Which pipeline is taken, and what it needs of a device. */

#include "device/renderer.h"
#include "unit_test.h"

TEST(auto_is_mega) {
    HdDevice device = {.is_cpu = true};
    HdRenderOptions options = {.pipeline = HD_PIPELINE_AUTO};
    assert_int_equal(hd_choose_pipeline(&device, &options, NULL), HD_PIPELINE_MEGA);
    options.pipeline = HD_PIPELINE_WAVEFRONT;
    assert_int_equal(hd_choose_pipeline(&device, &options, NULL), HD_PIPELINE_WAVEFRONT);
    assert_string_equal(hd_pipeline_names[HD_PIPELINE_WAVEFRONT_UNCOMPACTED],
                        "wavefront-uncompacted");
}

TEST(many_endless_lights_on_a_cpu_take_the_wavefront) {
    HdLight lights[100] = {{.falloff = {.end = 0.0}}};
    HdScene scene = {.lights = lights, .light_count = 100};
    HdDevice cpu = {.is_cpu = true}, gpu = {.is_cpu = false};
    HdRenderOptions options = {.pipeline = HD_PIPELINE_AUTO};
    assert_int_equal(hd_scene_endless_light_count(&scene), 100);
    assert_int_equal(hd_choose_pipeline(&cpu, &options, &scene), HD_PIPELINE_WAVEFRONT);
    assert_int_equal(hd_choose_pipeline(&gpu, &options, &scene), HD_PIPELINE_MEGA);
    lights[7].falloff.end = 2.0;
    assert_int_equal(hd_scene_endless_light_count(&scene), 99);
    assert_int_equal(hd_choose_pipeline(&cpu, &options, &scene), HD_PIPELINE_MEGA);
}

/* A display must not stand still for as long as a tree of hundreds of levels takes. */
TEST(deep_trees_on_a_gpu_with_a_display_take_the_wavefront) {
    HdDevice gpu = {.has_timeout = true, .has_wide_atomics = true}, cpu = {.is_cpu = true};
    HdRenderOptions options = {.pipeline = HD_PIPELINE_AUTO, .has_deep_trees = true};
    assert_int_equal(hd_choose_pipeline(&gpu, &options, NULL), HD_PIPELINE_WAVEFRONT);
    assert_int_equal(hd_choose_pipeline(&cpu, &options, NULL), HD_PIPELINE_MEGA);
    gpu.has_timeout = false;
    assert_int_equal(hd_choose_pipeline(&gpu, &options, NULL), HD_PIPELINE_MEGA);
    options.launch_ms = 100.0;
    assert_int_equal(hd_choose_pipeline(&gpu, &options, NULL), HD_PIPELINE_WAVEFRONT);
    assert_int_equal(hd_choose_pipeline(&cpu, &options, NULL), HD_PIPELINE_MEGA);
    options.launch_ms = 0.0;
    gpu.has_timeout = true;
    gpu.has_wide_atomics = false;
    assert_int_equal(hd_choose_pipeline(&gpu, &options, NULL), HD_PIPELINE_MEGA);
    gpu.has_wide_atomics = true;
    options.has_deep_trees = false;
    assert_int_equal(hd_choose_pipeline(&gpu, &options, NULL), HD_PIPELINE_MEGA);
    options.pipeline = HD_PIPELINE_MEGA;
    options.has_deep_trees = true;
    assert_int_equal(hd_choose_pipeline(&gpu, &options, NULL), HD_PIPELINE_MEGA);
}

TEST(a_wavefront_of_groups_needs_wide_atomics) {
    HdDevice gpu = {.name = "a GPU"};
    HdRenderOptions options = {.pipeline = HD_PIPELINE_WAVEFRONT};
    const char *obstacle = hd_device_obstacle(&gpu, &options);
    assert_non_null(obstacle);
    assert_non_null(strstr(obstacle, "64-bit integer atomics"));
    options.pipeline = HD_PIPELINE_WAVEFRONT_UNCOMPACTED;
    assert_non_null(hd_device_obstacle(&gpu, &options));
    options.pipeline = HD_PIPELINE_AUTO;
    assert_null(hd_device_obstacle(&gpu, &options));
    options.pipeline = HD_PIPELINE_WAVEFRONT;
    gpu.has_wide_atomics = true;
    assert_null(hd_device_obstacle(&gpu, &options));
    HdDevice cpu = {.is_cpu = true};
    assert_null(hd_device_obstacle(&cpu, &options));
}

TEST(sizes_of_launches_are_checked) {
    static const HdRenderOptions wrong[] = {
        {.block = 33},
        {.block = -32},
        {.block = HD_MAX_BLOCK + 32},
        {.grid = -1},
        {.grid = HD_MAX_GRID + 1},
        {.pipeline = HD_PIPELINE_COUNT},
    };
    HdDevice device = {.backend = &hd_backend_c, .is_cpu = true, .has_double = true};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        HdError error;
        HdRenderer *renderer;
        assert_int_equal(hd_renderer_open(&renderer, &device, &wrong[i], &error), HD_BAD_INPUT);
        assert_null(renderer);
    }
}

TEST(more_lanes_than_registers_are_refused) {
    HdDevice cpu = {.is_cpu = true, .has_double = true, .most_lanes = {16, 8}};
    HdRenderOptions options = {.lanes = 16};
    assert_null(hd_device_obstacle(&cpu, &options));
    options.precision = HD_PRECISION_DOUBLE;
    assert_string_equal(hd_device_obstacle(&cpu, &options),
                        "the processor has registers for 1, 4 or 8 lanes in this precision");
    options.lanes = 8;
    assert_null(hd_device_obstacle(&cpu, &options));
    cpu.most_lanes[HD_PRECISION_DOUBLE] = 4;
    assert_string_equal(hd_device_obstacle(&cpu, &options),
                        "the processor has registers for 1 or 4 lanes in this precision");
    cpu.most_lanes[HD_PRECISION_DOUBLE] = 1;
    assert_string_equal(hd_device_obstacle(&cpu, &options),
                        "the processor has registers for 1 lane in this precision");
    cpu.most_lanes[HD_PRECISION_DOUBLE] = 0; /* none is known */
    assert_null(hd_device_obstacle(&cpu, &options));
}

TEST(launches_last_as_long_as_they_may) {
    HdDevice gpu = {.has_timeout = true};
    HdRenderOptions options = {.launch_ms = 0.0};
    assert_true(hd_longest_launch(&gpu, &options) == 0.05);
    gpu.has_timeout = false;
    assert_true(hd_longest_launch(&gpu, &options) == 0.5);
    options.launch_ms = 0.5;
    assert_true(hd_longest_launch(&gpu, &options) == 5e-4);
}

TEST(a_lost_device_is_known_by_its_error) {
    HdError error;
    assert_int_equal(hd_fail_lost(&error, "clFinish"), HD_UNAVAILABLE);
    assert_true(hd_is_loss(&error));
    error.status = HD_FAILED;
    assert_false(hd_is_loss(&error));
    hd_fail(&error, HD_UNAVAILABLE, "there is no device");
    assert_false(hd_is_loss(&error));
}
