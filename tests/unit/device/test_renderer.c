/* SPDX-License-Identifier: MIT */
#include "device/renderer.h"

#include "device/self_test_scenes.h"
#include "unit_test.h"

static HdError error;
static HdRendererFunctions functions;
static HdBackend backend;
static HdRenderer *renderer;
static HdScene scene;
static HdSceneTables tables;
static int drops;

static void count_drop(void *state) {
    (void)state;
    drops++;
}

/* Plain C, but for what it drops. */
static int begin(void **state) {
    (void)state;
    const HdRenderOptions options = {.threads = 1, .lanes = 1};
    HdDevice device;
    int count;
    backend = hd_backend_c;
    functions = *hd_backend_c.functions;
    functions.drop = count_drop;
    backend.functions = &functions;
    drops = 0;
    assert_int_equal(hd_backend_enumerate(&backend, &device, 1, &count, &error), HD_OK);
    assert_int_equal(hd_renderer_open(&renderer, &device, &options, &error), HD_OK);
    assert_int_equal(hd_self_test_scene(&scene, HD_SELF_TEST_SOLID, false, false, &error), HD_OK);
    assert_int_equal(hd_compile_scene(&tables, &scene, HD_PRECISION_FLOAT, 1, &error), HD_OK);
    return 0;
}

static int end(void **state) {
    (void)state;
    hd_renderer_close(renderer);
    hd_scene_tables_free(&tables);
    hd_scene_free(&scene);
    return 0;
}

TEST(frames_that_are_under_way_are_dropped) {
    static const HdFrameWish radiance = {.radiance = true};
    HdCamera camera;
    HdFrameTables view;
    assert_int_equal(hd_renderer_upload(renderer, &tables, &error), HD_OK);
    assert_int_equal(hd_camera_at(&camera, &scene, 0, &error), HD_OK);
    assert_int_equal(hd_compile_frame(&view, &scene, &camera, HD_PRECISION_FLOAT, &error), HD_OK);
    hd_renderer_drop(renderer);
    assert_int_equal(drops, 0);
    assert_int_equal(hd_renderer_submit(renderer, &view, &radiance, &error), HD_OK);
    hd_renderer_drop(renderer);
    hd_renderer_drop(renderer);
    assert_int_equal(drops, 1);
    hd_frame_tables_free(&view);
}

TEST(tables_without_their_data_are_refused) {
    HdSceneTables others = tables;
    int last = others.table_count - 1;
    while (others.table[last].bytes == 0)
        last--;
    others.table[last].data = NULL;
    assert_int_equal(hd_renderer_upload(renderer, &others, &error), HD_BAD_INPUT);
    expect_contains(error.message, "of the scene has ");
    others = tables;
    others.table_count--;
    assert_int_equal(hd_renderer_upload(renderer, &others, &error), HD_BAD_INPUT);
    others = tables;
    others.precision = HD_PRECISION_DOUBLE;
    assert_int_equal(hd_renderer_upload(renderer, &others, &error), HD_BAD_INPUT);
}

TEST(options_are_checked) {
    const HdRenderOptions wrong = {.block = 33};
    HdRenderer *none = renderer;
    assert_int_equal(hd_renderer_open(&none, hd_renderer_device(renderer), &wrong, &error),
                     HD_BAD_INPUT);
    assert_null(none);
}

EACH(begin, end)
