/* SPDX-License-Identifier: MIT */
#include "device/renderer.h"

#include "device/self_test_scenes.h"
#include "unit_test.h"

static HdError error;
static int drops;

static void count_drop(void *state) {
    (void)state;
    drops++;
}

/* By plain C, but for what it drops. */
TEST(what_is_wrong_is_refused_and_frames_under_way_are_dropped) {
    static const HdFrameWish radiance = {.radiance = true};
    const HdRenderOptions options = {.threads = 1, .lanes = 1}, wrong = {.block = 33};
    HdRendererFunctions functions = *hd_backend_c.functions;
    HdBackend backend = hd_backend_c;
    HdDevice device;
    HdRenderer *renderer;
    HdScene scene;
    HdSceneTables tables;
    HdCamera camera;
    HdFrameTables view;
    int count;
    functions.drop = count_drop;
    backend.functions = &functions;
    assert_int_equal(hd_backend_enumerate(&backend, &device, 1, &count, &error), HD_OK);
    assert_int_equal(hd_renderer_open(&renderer, &device, &wrong, &error), HD_BAD_INPUT);
    assert_null(renderer);
    assert_int_equal(hd_renderer_open(&renderer, &device, &options, &error), HD_OK);
    assert_int_equal(hd_self_test_scene(&scene, HD_SELF_TEST_SOLID, false, false, &error), HD_OK);
    assert_int_equal(hd_compile_scene(&tables, &scene, HD_PRECISION_FLOAT, 1, &error), HD_OK);

    HdSceneTables others[] = {tables, tables, tables};
    others[0].table[0].data = NULL;
    others[1].table_count--;
    others[2].precision = HD_PRECISION_DOUBLE;
    for (int i = 0; i < 3; i++)
        assert_int_equal(hd_renderer_upload(renderer, &others[i], &error), HD_BAD_INPUT);

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
    hd_renderer_close(renderer);
    hd_scene_tables_free(&tables);
    hd_scene_free(&scene);
}
