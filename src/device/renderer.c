/* SPDX-License-Identifier: MIT */
#include "device/renderer.h"

#include <limits.h>
#include <stdlib.h>

#include "base/limits.h"
#include "device/kernel_cache.h"
#include "kernels/host/shared.h"

struct HdRenderer {
    const HdBackend *backend;
    void *state; /* the backend's renderer */
    HdDevice device;
    HdRenderOptions options;
    bool has_scene;
    bool has_failed;
    double longest_launch; /* seconds; negative: unknown */
    int in_flight;
    const HdFrameTables *frames[HD_FRAMES_IN_FLIGHT]; /* the oldest first */
};

HdStatus hd_renderer_fail(HdRenderer *renderer, HdStatus status, HdError *error) {
    if (status != HD_OK && status != HD_INTERRUPTED)
        renderer->has_failed = true;
    if (status != HD_OK)
        hd_error_prefix(error, renderer->backend->name);
    return status;
}

HdStatus hd_renderer_open(HdRenderer **renderer, const HdDevice *device,
                          const HdRenderOptions *options, HdError *error) {
    *renderer = NULL;
    if (!hd_render_options_are_possible(options))
        return hd_fail(error, HD_BAD_INPUT, "no device can have such lanes, threads or launches");
    const char *unsupported_reason = hd_device_unsupported_reason(device, options);
    if (unsupported_reason != NULL)
        return hd_fail(error, HD_UNAVAILABLE, "%s: %s cannot do this: %s", device->backend->name,
                       device->name, unsupported_reason);
    HdRenderer *opened = calloc(1, sizeof *opened);
    if (!opened)
        return HD_NO_ROOM(error, "a renderer");
    opened->backend = device->backend;
    opened->longest_launch = -1.0;
    opened->device = *device;
    opened->options = *options;
    opened->options.pipeline = hd_choose_pipeline(device, options, NULL);
    HdStatus status =
        opened->backend->functions->open(device, &opened->options, &opened->state, error);
    if (status == HD_OK) {
        *renderer = opened;
        return HD_OK;
    }
    hd_error_prefix(error, device->backend->name);
    free(opened);
    return status;
}

HdKernelCache *hd_renderer_kernels(const HdRenderer *renderer) {
    return renderer->backend->functions->kernels != NULL
               ? renderer->backend->functions->kernels(renderer->state)
               : NULL;
}

bool hd_renderer_change_to_wavefront(HdRenderer *renderer) {
    HdRenderOptions waves = renderer->options;
    HdError ignored;
    void *state;
    waves.pipeline = HD_PIPELINE_WAVEFRONT;
    if (hd_pipeline_is_wavefront(renderer->options.pipeline) ||
        renderer->options.test.keeps_pipeline ||
        hd_device_unsupported_reason(&renderer->device, &waves) != NULL ||
        renderer->backend->functions->open(&renderer->device, &waves, &state, &ignored) != HD_OK)
        return false;
    renderer->backend->functions->close(renderer->state);
    renderer->state = state;
    renderer->options = waves;
    renderer->has_scene = false;
    return true;
}

HdStatus hd_renderer_compute(HdRenderer *renderer, const HdProbeBatch *batch,
                             HdProbeResults *results, HdError *error) {
    renderer->has_scene = false;
    HdStatus status = renderer->backend->functions->probe(renderer->state, batch, results, error);
    return hd_renderer_fail(renderer, status, error);
}

/* Checks the precision of the tables and the number of frames in flight before `what` is done. */
static HdStatus check_use(const HdRenderer *renderer, const char *what, HdPrecision precision,
                          int max_in_flight, HdError *error) {
    if (precision != renderer->options.precision)
        return hd_fail(error, HD_BAD_INPUT,
                       "the tables of the %s are not in the precision of the renderer", what);
    if (renderer->in_flight > max_in_flight)
        return hd_fail(error, HD_BAD_INPUT, "a %s came while %d frames were in flight, at most %d",
                       what, renderer->in_flight, max_in_flight);
    return HD_OK;
}

HdStatus hd_renderer_upload(HdRenderer *renderer, const HdSceneTables *tables, HdError *error) {
    HD_TRY(check_use(renderer, "scene", tables->precision, 0, error));
    if (tables->lanes != hd_renderer_lanes(renderer))
        return hd_fail(error, HD_BAD_INPUT, "a scene was compiled for %d lanes, not %d",
                       tables->lanes, hd_renderer_lanes(renderer));
    HdStatus status = renderer->backend->functions->upload(renderer->state, tables, error);
    renderer->has_scene = status == HD_OK;
    return hd_renderer_fail(renderer, status, error);
}

/* Kernels count work items and a picture's values in int, in whole blocks. */
static HdStatus check_size(int width, int height, HdError *error) {
    int64_t columns = (width + HD_BLOCK_SIDE - 1) / HD_BLOCK_SIDE;
    int64_t rows = (height + HD_BLOCK_SIDE - 1) / HD_BLOCK_SIDE;
    int64_t limit = INT_MAX / 3 / HD_BLOCK_PIXELS;
    if (columns * rows > limit)
        return hd_fail(error, HD_BAD_INPUT,
                       "a frame of %d x %d pixels is too large: at most about %lld million pixels",
                       width, height, (long long)(limit * HD_BLOCK_PIXELS / 1000000));
    return HD_OK;
}

static HdStatus check_frame_tables(const HdRenderer *renderer, const HdFrameTables *tables,
                                   HdError *error) {
    if (!renderer->has_scene)
        return hd_fail(error, HD_BAD_INPUT, "a frame was requested before a scene was uploaded");
    const HdKernelCache *kernels = hd_renderer_kernels(renderer);
    if (kernels != NULL && kernels->is_untested && !kernels->is_on_trial)
        return hd_fail(error, HD_BAD_INPUT, "a frame was requested with untested kernels");
    return check_size(tables->width, tables->height, error);
}

HdStatus hd_renderer_submit(HdRenderer *renderer, const HdFrameTables *tables,
                            const HdFrameRequest *request, HdError *error) {
    HD_TRY(check_frame_tables(renderer, tables, error));
    HD_TRY(check_use(renderer, "frame", tables->precision, HD_FRAMES_IN_FLIGHT - 1, error));
    HdStatus status = renderer->backend->functions->submit(renderer->state, tables, request, error);
    if (status == HD_OK)
        renderer->frames[renderer->in_flight++] = tables;
    return hd_renderer_fail(renderer, status, error);
}

double hd_renderer_take_longest_launch(HdRenderer *renderer) {
    double seconds = renderer->longest_launch;
    renderer->longest_launch = -1.0;
    return seconds;
}

HdStatus hd_renderer_collect(HdRenderer *renderer, HdFrame *frame, HdError *error) {
    const HdFrameTables *tables = renderer->frames[0];
    if (renderer->in_flight == 0)
        return hd_fail(error, HD_BAD_INPUT, "a frame was collected and none was in flight");
    if (frame->floats != tables->floats || frame->width != tables->width ||
        frame->height != tables->height)
        return hd_fail(
            error, HD_BAD_INPUT,
            "a frame of %d x %d pixels and %d floats was given for one of %d x %d and %d",
            frame->width, frame->height, frame->floats, tables->width, tables->height,
            tables->floats);
    HdStatus status = renderer->backend->functions->collect(renderer->state, tables, frame, error);
    if (status == HD_OK && frame->longest_launch > renderer->longest_launch)
        renderer->longest_launch = frame->longest_launch;
    renderer->in_flight--;
    for (int i = 0; i < renderer->in_flight; i++)
        renderer->frames[i] = renderer->frames[i + 1];
    return hd_renderer_fail(renderer, status, error);
}

HdStatus hd_renderer_first_hits(HdRenderer *renderer, const HdFrameTables *tables, HdFrame *frame,
                                HdError *error) {
    HD_TRY(check_frame_tables(renderer, tables, error));
    HdStatus status =
        renderer->backend->functions->first_hits(renderer->state, tables, frame, error);
    return hd_renderer_fail(renderer, status, error);
}

bool hd_renderer_has_failed(const HdRenderer *renderer) {
    return renderer->has_failed;
}

void hd_renderer_drop(HdRenderer *renderer) {
    if (renderer->in_flight > 0)
        renderer->backend->functions->drop(renderer->state);
    renderer->in_flight = 0;
}

HdStatus hd_renderer_render(HdRenderer *renderer, const HdFrameTables *tables, HdFrame *frame,
                            HdError *error) {
    static const HdFrameRequest radiance = {.radiance = true};
    HD_TRY(hd_renderer_submit(renderer, tables, &radiance, error));
    return hd_renderer_collect(renderer, frame, error);
}

const HdDevice *hd_renderer_device(const HdRenderer *renderer) {
    return &renderer->device;
}

const HdRenderOptions *hd_renderer_options(const HdRenderer *renderer) {
    return &renderer->options;
}

int hd_renderer_lanes(const HdRenderer *renderer) {
    return renderer->backend->functions->lanes(renderer->state);
}

void hd_renderer_describe(const HdRenderer *renderer, char *text, int capacity) {
    renderer->backend->functions->describe(renderer->state, text, capacity);
}

const char *hd_renderer_kernels_note(const HdRenderer *renderer) {
    const HdKernelCache *kernels = hd_renderer_kernels(renderer);
    return kernels != NULL ? kernels->note : "";
}

void hd_renderer_close(HdRenderer *renderer) {
    if (!renderer)
        return;
    hd_renderer_drop(renderer);
    renderer->backend->functions->close(renderer->state);
    free(renderer);
}
