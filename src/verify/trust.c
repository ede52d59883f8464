/* SPDX-License-Identifier: MIT */
#include "verify/trust.h"

#include <inttypes.h>
#include <string.h>

#include "device/kernel_cache.h"
#include "render/frame.h"
#include "system/machine.h"
#include "tables/table.h"
#include "verify/golden.h"
#include "verify/probe.h"

/* ---- test ---- */

/* Compiles the scene's tables with the needs of `like` too, so that the same kernels render it. */
static HdStatus compile_like(HdSceneTables *tables, const HdScene *scene, HdRenderer *renderer,
                             const HdSceneTables *like, HdError *error) {
    HdStatus status = hd_compile_scene(tables, scene, hd_renderer_options(renderer)->precision,
                                       hd_renderer_lanes(renderer), error);
    if (status == HD_OK && like != NULL)
        hd_scene_tables_raise(tables, like);
    return status;
}

/* Kernels for error bounds render grids as well. */
static HdStatus render_hash(HdRenderer *renderer, const HdSceneTables *tables, const HdScene *scene,
                            const HdCamera *camera, uint64_t *hash, HdError *error) {
    HdFrameTables view;
    HdFrame image;
    HD_TRY(hd_compile_frame(&view, scene, camera, tables->precision, NULL, error));
    view.floats = tables->bounded ? HD_BOUNDED_FLOATS : HD_RADIANCE_FLOATS;
    HdStatus status = hd_frame_create_with(&image, scene->width, scene->height, view.floats, error);
    if (status == HD_OK) {
        status = hd_renderer_upload(renderer, tables, error);
        if (status == HD_OK)
            status = hd_renderer_render(renderer, &view, &image, error);
        /* Skips the additional values of pixels with an error bound. */
        size_t pixels = (size_t)image.width * (size_t)image.height;
        for (size_t i = 0; i < pixels; i++)
            memmove(image.rgb + 3 * i, image.rgb + (size_t)image.floats * i, 3 * sizeof *image.rgb);
        image.floats = 3;
        *hash = hd_frame_hash(&image);
        hd_frame_free(&image);
    }
    hd_frame_tables_free(&view);
    return status;
}

typedef struct KernelTest {
    HdRenderer *renderer;
    const HdSceneTables *like; /* needs that the kernels were compiled for */
    int frames;                /* frames rendered correctly */
    bool is_wrong;             /* a frame was rendered wrongly */
} KernelTest;

static HdStatus check_hash(KernelTest *test, const HdGoldenFrame *frame, uint64_t hash,
                           HdError *error) {
    const HdDevice *device = hd_renderer_device(test->renderer);
    HdGoldenHashes expected = {0};
    hd_golden_find_hashes(frame->name, test->like->precision, &expected);
    test->is_wrong = hash != expected.frame;
    test->frames += !test->is_wrong;
    return test->is_wrong
               ? hd_fail(error, HD_UNAVAILABLE,
                         "%s (%s) computes wrongly: the kernels that were compiled for it render "
                         "the golden frame '%s' with the hash %016" PRIx64 ", expected %016" PRIx64
                         "; another version of its driver or compiler may do better",
                         device->name, device->driver, frame->name, hash, expected.frame)
               : HD_OK;
}

static HdStatus render_golden(KernelTest *test, const HdGoldenFrame *frame, HdError *error) {
    HdScene scene;
    HdCamera camera;
    HdSceneTables tables;
    uint64_t hash;
    HD_TRY(hd_golden_build(frame, &scene, &camera, error));
    HdStatus status = compile_like(&tables, &scene, test->renderer, test->like, error);
    if (status == HD_OK) {
        tables.many_lights = test->like->many_lights; /* kernels without it test each light */
        const HdKernelNeeds needs = hd_kernel_needs(&tables), there = hd_kernel_needs(test->like);
        if (hd_kernel_needs_equal(&needs, &there)) {
            status = render_hash(test->renderer, &tables, &scene, &camera, &hash, error);
            if (status == HD_OK)
                status = check_hash(test, frame, hash, error);
        }
        hd_scene_tables_free(&tables);
    }
    hd_scene_free(&scene);
    return status;
}

/* Replaces the renderer's scene. */
static HdStatus test_kernels(KernelTest *test, HdError *error) {
    HdKernelCache *kernels = hd_renderer_kernels(test->renderer);
    HdStatus status = HD_OK;
    kernels->is_on_trial = true;
    for (int i = 0; status == HD_OK && i < hd_golden_frame_count; i++)
        if (hd_golden_frames[i].tests_build)
            status = render_golden(test, &hd_golden_frames[i], error);
    kernels->is_on_trial = false;
    if (status == HD_OK && test->frames == 0)
        status = hd_fail(error, HD_FAILED, "no golden frame fits the kernels");
    return status;
}

/* ---- uploads ---- */

void hd_put_on_trial(HdRenderer *renderer) {
    HdKernelCache *kernels = hd_renderer_kernels(renderer);
    if (kernels != NULL)
        kernels->is_on_trial = true;
}

static HdStatus upload_tested(HdRenderer *renderer, const HdSceneTables *tables, bool *is_wrong,
                              HdError *error) {
    KernelTest test = {.renderer = renderer, .like = tables};
    HdStatus status = hd_probe_settle(renderer, error);
    if (status == HD_OK)
        status = hd_renderer_upload(renderer, tables, error);
    HdKernelCache *kernels = hd_renderer_kernels(renderer);
    if (status != HD_OK || kernels == NULL || !kernels->is_untested || kernels->is_on_trial)
        return status;
    if (kernels->shape.math == HD_MATH_STRICT) {
        status = test_kernels(&test, error);
        *is_wrong = test.is_wrong;
        if (status == HD_OK)
            status = hd_renderer_upload(renderer, tables, error);
    }
    if (status == HD_OK)
        hd_kernel_cache_accept(kernels);
    return status;
}

/* Falls back to the wavefront, with fewer nested branches, after the megakernel computed wrongly as
   `error` says. `error` remains if that is wrong too or unavailable. */
static HdStatus try_wavefront(HdRenderer *renderer, const HdSceneTables *tables, HdError *error) {
    HdError later;
    bool is_wrong = false;
    HdStatus status = hd_renderer_change_to_wavefront(renderer)
                          ? upload_tested(renderer, tables, &is_wrong, &later)
                          : HD_UNAVAILABLE;
    if (status == HD_OK)
        hd_fallback_note("the wavefront takes over: %s", error->message);
    else if (status == HD_INTERRUPTED)
        *error = later;
    else
        status = hd_renderer_fail(renderer, HD_UNAVAILABLE, error);
    return status;
}

HdStatus hd_put_tables(HdRenderer *renderer, const HdSceneTables *tables, HdError *error) {
    bool is_wrong = false;
    HdStatus status = upload_tested(renderer, tables, &is_wrong, error);
    return is_wrong ? try_wavefront(renderer, tables, error) : status;
}

HdStatus hd_put_scene(HdRenderer *renderer, const HdScene *scene, const HdSceneTables *like,
                      HdError *error) {
    HdSceneTables tables;
    HD_TRY(compile_like(&tables, scene, renderer, like, error));
    HdStatus status = hd_put_tables(renderer, &tables, error);
    hd_scene_tables_free(&tables);
    return status;
}

HdStatus hd_put_and_render(HdRenderer *renderer, const HdScene *scene, const HdCamera *camera,
                           const HdSceneTables *like, unsigned layers, HdFrame *frame,
                           HdError *error) {
    const HdFrameMaker maker = {
        .renderer = renderer, .scene = scene, .request.curve = HD_CURVE_SRGB};
    HD_TRY(hd_put_scene(renderer, scene, like, error));
    HD_TRY(hd_frame_create(frame, scene->width, scene->height, error));
    HdStatus status = hd_frame_add_layers(frame, layers, error);
    if (status == HD_OK)
        status = hd_frame_render(&maker, camera, frame, error);
    if (status != HD_OK)
        hd_frame_free(frame);
    return status;
}
