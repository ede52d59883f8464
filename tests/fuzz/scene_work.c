/* SPDX-License-Identifier: MIT */
#include "fuzz.h"

#include "device/renderer.h"
#include "render/backends.h"
#include "scene/camera.h"
#include "verify/trust.h"

/* More takes the campaign's time. */
enum { MAX_SOLIDS = 8, MAX_LIGHTS = 2000, WIDTH = 8, HEIGHT = 6, MAX_DEPTH = 3 };

/* Kernels that sanitizers check (cpu_kernels.cmake): packets of floats with the default lanes,
   single lanes of doubles. */
static HdRenderer *open_renderer(HdPrecision precision) {
    static HdError error;
    HdDevice device;
    HdRenderer *renderer = NULL;
    int count;
    const HdRenderOptions options = {
        .threads = 1, .precision = precision, .lanes = precision == HD_PRECISION_DOUBLE};
    HdStatus status = hd_backend_enumerate(&hd_backend_c, &device, 1, &count, &error);
    if (status == HD_OK)
        status = hd_renderer_open(&renderer, &device, &options, &error);
    fuzz_expect(status == HD_OK, error.message);
    return renderer;
}

static void render(const HdScene *scene, const HdCamera *camera, HdPrecision precision) {
    static HdRenderer *renderers[2]; /* by precision; they live as long as the process */
    static HdError error;
    HdFrame frame;
    HdRenderer **renderer = &renderers[precision == HD_PRECISION_DOUBLE];
    if (*renderer == NULL)
        *renderer = open_renderer(precision);
    const HdStatus status = hd_put_and_render(*renderer, scene, camera, NULL, 0, &frame, &error);
    fuzz_expect(status == HD_OK, error.message);
    hd_frame_free(&frame);
}

/* Makes the scene's picture small. */
static HdScene shrunk(const HdScene *scene) {
    HdScene small = *scene;
    hd_scene_drop_error_bound(&small);
    small.width = WIDTH;
    small.height = HEIGHT;
    small.crop = (HdCrop){0};
    small.samples_per_side = 1;
    small.depth = scene->depth < MAX_DEPTH ? scene->depth : MAX_DEPTH;
    return small;
}

void fuzz_render_scene(const HdScene *scene) {
    static HdError error;
    HdCamera camera;
    int lights = scene->light_count;
    for (int i = 0; i < scene->solid_count; i++)
        lights += hd_edge_light_count(&scene->solids[i]);
    const HdScene small = shrunk(scene);
    const HdStatus status = hd_camera_at(&camera, &small, scene->frame_count - 1, &error);
    fuzz_expect_input_status(status, &error);
    if (status != HD_OK || scene->solid_count > MAX_SOLIDS || lights > MAX_LIGHTS)
        return;
    render(&small, &camera, HD_PRECISION_FLOAT);
    render(&small, &camera, HD_PRECISION_DOUBLE);
}
