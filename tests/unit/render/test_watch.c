/* SPDX-License-Identifier: MIT */
/* Progress of a frame during rendering: all of it, in parts; and its cancellation. */
#include "base/watch.h"

#include "render/backends.h"
#include "render/frame.h"
#include "scene/camera.h"
#include "small_scene.h"
#include "unit_test.h"
#include "verify/trust.h"

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
    assert_int_equal(small_scene(scene, "hexahedron", &error), HD_OK);
    scene->sampling = sampling;
    scene->max_error = max_error;
    assert_int_equal(hd_camera_at(&setup->camera, scene, 0, &error), HD_OK);
    assert_int_equal(hd_backend_enumerate(&hd_backend_c, &device, 1, &count, &error), HD_OK);
    assert_int_equal(hd_renderer_open(&setup->renderer, &device, &options, &error), HD_OK);
    assert_int_equal(hd_put_scene(setup->renderer, scene, NULL, &error), HD_OK);
    assert_int_equal(hd_frame_create(&setup->frame, scene->width, scene->height, &error), HD_OK);
}

static HdStatus render(Setup *setup) {
    const HdFrameMaker maker = {.renderer = setup->renderer,
                                .scene = &setup->scene,
                                .request.curve = HD_CURVE_SRGB,
                                .watch = &setup->watch};
    return hd_frame_render(&maker, &setup->camera, &setup->frame, &error);
}

/* Two frames count as two, to the last count; a cancelled one ends before all of it is done. */
TEST(all_samples_and_passes_are_reported) {
    const struct {
        HdSampling sampling;
        double max_error;
    } cases[] = {{HD_SAMPLING_GRID, 0.0}, {HD_SAMPLING_GRID, 1.0}, {HD_SAMPLING_MULTIJITTER, 1.0}};
    for (int i = 0; i < 3; i++) {
        Setup setup = {.watch = {0}};
        begin(&setup, cases[i].sampling, cases[i].max_error);
        assert_int_equal(render(&setup), HD_OK);
        assert_true(setup.watch.done == HD_WATCH_FRAME);
        assert_int_equal(render(&setup), HD_OK);
        assert_true(hd_watch_frames(&setup.watch) == 2.0);
        atomic_store(&setup.watch.is_cancelled, true);
        assert_int_equal(render(&setup), HD_INTERRUPTED);
        assert_true(hd_watch_frames(&setup.watch) < 3.0);
        assert_false(hd_renderer_has_failed(setup.renderer));
        hd_renderer_close(setup.renderer);
        hd_frame_free(&setup.frame);
        hd_scene_free(&setup.scene);
    }
}
