/* SPDX-License-Identifier: MIT */
/* What is told of a frame while it is rendered: all of it, in parts; and that it ends where nobody
   wants it any more. */
#include "base/watch.h"

#include "verify/render_scene.h"
#include "device/self_test_scenes.h"
#include "render/adaptive.h"
#include "scene/camera.h"
#include "unit_test.h"

static HdError error;

typedef struct Setup {
    HdScene scene;
    HdCamera camera;
    HdRenderer *renderer;
    HdWatch watch;
    HdFrame frame;
} Setup;

static void begin(Setup *setup, HdSampling sampling, double max_error) {
    HdScene *scene = &setup->scene;
    const HdRenderOptions options = {.threads = 2};
    HdDevice device;
    int count;
    assert_int_equal(hd_self_test_scene(scene, HD_SELF_TEST_SOLID, false, false, &error), HD_OK);
    scene->sampling = sampling;
    scene->max_error = max_error;
    assert_int_equal(hd_camera_at(&setup->camera, scene, 0, &error), HD_OK);
    assert_int_equal(hd_backend_enumerate(&hd_backend_c, &device, 1, &count, &error), HD_OK);
    assert_int_equal(hd_renderer_open(&setup->renderer, &device, &options, &error), HD_OK);
    assert_int_equal(hd_upload_scene(setup->renderer, scene, HD_PRECISION_FLOAT, NULL, &error),
                     HD_OK);
    assert_int_equal(hd_frame_create(&setup->frame, scene->width, scene->height, &error), HD_OK);
}

static HdStatus render_grid(Setup *setup) {
    HdFrameTables tables;
    assert_int_equal(
        hd_compile_frame(&tables, &setup->scene, &setup->camera, HD_PRECISION_FLOAT, &error),
        HD_OK);
    tables.watched = (HdWatched){&setup->watch, HD_WATCH_FRAME};
    const HdStatus status = hd_renderer_render(setup->renderer, &tables, &setup->frame, &error);
    hd_frame_tables_free(&tables);
    return status;
}

static HdStatus refine(Setup *setup) {
    HdRefinement *refinement;
    assert_int_equal(hd_refinement_create(&refinement, &setup->scene, setup->renderer,
                                          HD_PRECISION_FLOAT, HD_CURVE_SRGB, &error),
                     HD_OK);
    const HdStatus status =
        hd_refinement_render(refinement, &setup->camera, &setup->watch, &setup->frame, &error);
    hd_refinement_free(refinement);
    return status;
}

/* Two frames are two, to the last count; an unwanted one ends before all of it is done. */
TEST(all_samples_and_passes_are_told) {
    const struct {
        HdStatus (*render)(Setup *setup);
        HdSampling sampling;
        double max_error;
    } cases[] = {{render_grid, HD_SAMPLING_GRID, 0.0},
                 {refine, HD_SAMPLING_ADAPTIVE, 0.0},
                 {refine, HD_SAMPLING_GRID, 1.0}};
    for (int i = 0; i < 3; i++) {
        Setup setup = {.watch = {0}};
        begin(&setup, cases[i].sampling, cases[i].max_error);
        assert_int_equal(cases[i].render(&setup), HD_OK);
        assert_true(setup.watch.done == HD_WATCH_FRAME);
        assert_int_equal(cases[i].render(&setup), HD_OK);
        assert_true(hd_watch_frames(&setup.watch) == 2.0);
        atomic_store(&setup.watch.is_unwanted, true);
        assert_int_equal(cases[i].render(&setup), HD_INTERRUPTED);
        assert_true(hd_watch_frames(&setup.watch) < 3.0);
        assert_false(hd_renderer_has_failed(setup.renderer));
        hd_renderer_close(setup.renderer);
        hd_frame_free(&setup.frame);
        hd_scene_free(&setup.scene);
    }
}
