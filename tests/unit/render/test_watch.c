/* SPDX-License-Identifier: MIT */
/* What is told of a frame while it is rendered: all of it, in parts; and that it ends where nobody
   wants it any more. */
#include "base/watch.h"

#include "certify/render_scene.h"
#include "certify/scene_builder.h"
#include "render/adaptive.h"
#include "unit_test.h"

typedef struct Setup {
    HdScene scene;
    HdCamera camera;
    HdRenderer *renderer;
    HdWatch watch;
    HdFrame frame;
} Setup;

static void build(Setup *setup) {
    HdScene *scene = &setup->scene;
    *setup = (Setup){.watch = {0}};
    build_scene(scene, 75, 50, 4, 6, 1, 1);
    build_light(scene, 0, hd_vec3(3.0, -2.0, 5.0), hd_vec3(1.0, 0.9, 0.8));
    build_solid(scene, 0, HD_OCTAHEDRON, hd_vec3(0.1, 0.2, 0.05), 1.2, hd_vec3(0.9, 0.6, 0.3), 3);
    build_square_floor(scene, 4.0, -1.3);
    build_camera(&setup->camera, hd_vec3(2.3, -2.9, 1.4), hd_vec3(0.0, 0.0, 0.0), 50.0);
}

static void open_renderer(Setup *setup) {
    HdRenderOptions options = {.threads = 2};
    HdDevice device;
    HdError error;
    int count;
    assert_int_equal(hd_backend_enumerate(&hd_backend_c, &device, 1, &count, &error), HD_OK);
    assert_int_equal(hd_renderer_open(&setup->renderer, &device, &options, &error), HD_OK);
    assert_int_equal(
        hd_upload_scene(setup->renderer, &setup->scene, HD_PRECISION_FLOAT, NULL, &error), HD_OK);
    assert_int_equal(
        hd_frame_create(&setup->frame, setup->scene.width, setup->scene.height, &error), HD_OK);
}

static HdStatus render_grid(Setup *setup) {
    HdFrameTables tables;
    HdError error;
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
    HdError error;
    assert_int_equal(hd_refinement_create(&refinement, &setup->scene, setup->renderer,
                                          HD_PRECISION_FLOAT, HD_CURVE_SRGB, &error),
                     HD_OK);
    const HdStatus status =
        hd_refinement_render(refinement, &setup->camera, &setup->watch, &setup->frame, &error);
    hd_refinement_free(refinement);
    return status;
}

/* Two frames are two, to the last count; an unwanted one ends before all of it is done. */
static void check(Setup *setup, HdStatus (*render)(Setup *setup)) {
    open_renderer(setup);
    assert_int_equal(render(setup), HD_OK);
    assert_true(setup->watch.done == HD_WATCH_FRAME);
    assert_int_equal(render(setup), HD_OK);
    assert_true(hd_watch_frames(&setup->watch) == 2.0);
    atomic_store(&setup->watch.is_unwanted, true);
    assert_int_equal(render(setup), HD_INTERRUPTED);
    assert_true(hd_watch_frames(&setup->watch) < 3.0);
    assert_false(hd_renderer_has_failed(setup->renderer));
    hd_renderer_close(setup->renderer);
    hd_frame_free(&setup->frame);
    hd_scene_free(&setup->scene);
}

TEST(all_samples_are_told) {
    Setup setup;
    build(&setup);
    check(&setup, render_grid);
}

TEST(adaptive_passes_are_told) {
    Setup setup;
    build(&setup);
    setup.scene.sampling = HD_SAMPLING_ADAPTIVE;
    check(&setup, refine);
}

TEST(passes_of_a_bound_are_told) {
    Setup setup;
    build(&setup);
    setup.scene.max_error = 1.0;
    check(&setup, refine);
}

TEST(parts_come_to_the_whole) {
    HdWatch watch = {0};
    const HdWatched watched = {&watch, 1000003};
    for (int i = 6; i >= 0; i--)
        hd_watched_add(&watched, i, i + 1, 7);
    assert_true(watch.done == 1000003);
    hd_watched_add(&(HdWatched){NULL, 5}, 0, 1, 1); /* nobody looks */
}
