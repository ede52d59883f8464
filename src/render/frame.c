/* SPDX-License-Identifier: MIT */
#include "render/frame.h"

#include <stdlib.h>
#include <string.h>

#include "base/minmax.h"
#include "kernels/host/shared.h"
#include "render/bound_pass.h"
#include "system/machine.h"
#include "system/thread_pool.h"
#include "tables/table.h"

/* More would wait for each other longer than they work. */
enum { MAX_THREADS = 16 };

/* What frames with an error bound need besides the renderer. */
typedef struct HdBounded {
    HdThreadPool *threads;
    HdBoundPasses passes; /* passes of the scene; their sums are the frame */
    int *pixels;          /* x | y << 16, in blocks of neighbours, which suit packets */
    HdBoundedMean *means;
    double *steps; /* steps of 1/255 that a pixel may miss, by the list */
} HdBounded;

static void free_bounded(HdBounded *bounded) {
    if (bounded == NULL)
        return;
    hd_thread_pool_destroy(bounded->threads);
    hd_bound_passes_free(&bounded->passes);
    free(bounded->pixels);
    free(bounded->means);
    free(bounded->steps);
    free(bounded);
}

static int pixel_count(const HdBounded *bounded) {
    return bounded->passes.scene->width * bounded->passes.scene->height;
}

static void list_pixels(const HdBounded *bounded) {
    enum { SIDE = HD_BLOCK_SIDE };
    const int width = bounded->passes.scene->width, height = bounded->passes.scene->height;
    int count = 0;
    for (int top = 0; top < height; top += SIDE)
        for (int left = 0; left < width; left += SIDE)
            for (int z = 0; z < SIDE * SIDE; z++) {
                int x = left + HD_Z_COLUMN(z), y = top + HD_Z_ROW(z);
                if (x < width && y < height) /* y has the sign bit too */
                    bounded->pixels[count++] = (int)((uint32_t)y << 16 | (uint32_t)x);
            }
}

/* The scene is on the renderer; both must live on. */
static HdStatus fill_bounded(HdBounded *bounded, const HdFrameMaker *maker, HdError *error) {
    const HdScene *scene = maker->scene;
    const size_t pixels = (size_t)scene->width * (size_t)scene->height;
    HD_TRY(
        hd_thread_pool_create(&bounded->threads, hd_min(hd_processor_count(), MAX_THREADS), error));
    bounded->passes = (HdBoundPasses){.scene = scene,
                                      .renderer = maker->renderer,
                                      .curve = maker->request.curve,
                                      .max_left_out = hd_max_left_out(scene),
                                      .threads = bounded->threads};
    bounded->pixels = calloc(pixels, sizeof *bounded->pixels);
    bounded->means = calloc(pixels, sizeof *bounded->means);
    bounded->steps = calloc(pixels, sizeof *bounded->steps);
    if (!(bounded->pixels && bounded->means && bounded->steps))
        return HD_NO_ROOM(error, "%zu pixels", pixels);
    list_pixels(bounded);
    return HD_OK;
}

static void fill_pixels(void *context, int first, int end) {
    const HdBounded *bounded = context;
    const HdFrame *frame = bounded->passes.sums;
    const size_t width = (size_t)bounded->passes.scene->width;
    for (int i = first; i < end; i++) {
        const HdBoundedMean *mean = &bounded->means[i];
        const uint32_t packed = (uint32_t)bounded->pixels[i];
        const size_t place = (size_t)(packed >> 16) * width + (packed & 0xffff);
        bounded->steps[i] = hd_missing_steps(bounded->passes.curve, (double)mean->bound,
                                             (double)hd_darkest(mean->rgb));
        memcpy(frame->rgb + 3 * place, mean->rgb, sizeof mean->rgb);
        if (frame->bounds != NULL)
            frame->bounds[place] = (float)bounded->steps[i];
    }
}

/* Sums the bounds in the list's order, so that they do not depend on the threads. */
static void fill_frame(HdBounded *bounded, HdFrame *frame) {
    const int pixels = pixel_count(bounded);
    double largest = 0.0, sum = 0.0;
    hd_chunks_run(bounded->threads, pixels, fill_pixels, bounded);
    for (int i = 0; i < pixels; i++) {
        largest = bounded->steps[i] > largest ? bounded->steps[i] : largest;
        sum += bounded->steps[i];
    }
    frame->has_bound = true;
    frame->largest_bound = largest;
    frame->mean_bound = sum / (double)pixels;
}

static HdStatus find_first_hits(const HdFrameMaker *maker, const HdCamera *camera, HdFrame *frame,
                                HdError *error) {
    HdFrameTables tables;
    HdStatus status =
        hd_compile_frame(&tables, maker->scene, camera,
                         hd_renderer_options(maker->renderer)->precision, NULL, error);
    tables.watched = (HdWatched){.watch = maker->watch}; /* without further weight */
    if (status == HD_OK)
        status = hd_renderer_first_hits(maker->renderer, &tables, frame, error);
    hd_frame_tables_free(&tables);
    return status;
}

static HdStatus render_bounded(const HdFrameMaker *maker, const HdCamera *camera, HdFrame *frame,
                               HdError *error) {
    HdBounded *bounded = maker->bounded;
    double start = hd_monotonic_seconds();
    frame->primary_rays = frame->mirrored_rays = frame->transmitted_rays = 0;
    frame->shadow_tests = frame->clamps = 0;
    bounded->passes.camera = camera;
    bounded->passes.sums = frame;
    const HdBoundPass all = {.pixels = bounded->pixels,
                             .count = pixel_count(bounded),
                             .means = bounded->means,
                             .watched = {maker->watch, HD_WATCH_FRAME}};
    HD_TRY(hd_bound_pass(&bounded->passes, &all, error));
    if (frame->first != NULL)
        HD_TRY(find_first_hits(maker, camera, frame, error));
    frame->is_encoded = false;
    fill_frame(bounded, frame);
    frame->trace_seconds = hd_monotonic_seconds() - start;
    return HD_OK;
}

/* ---- frames ---- */

HdStatus hd_frame_maker_open(HdFrameMaker *maker, HdError *error) {
    maker->bounded = NULL;
    if (!hd_scene_has_error_bound(maker->scene))
        return HD_OK;
    maker->bounded = calloc(1, sizeof *maker->bounded);
    if (maker->bounded == NULL)
        return HD_NO_ROOM(error, "a frame with an error bound");
    HdStatus status = fill_bounded(maker->bounded, maker, error);
    if (status != HD_OK)
        hd_frame_maker_close(maker);
    return status;
}

void hd_frame_maker_close(HdFrameMaker *maker) {
    free_bounded(maker->bounded);
    maker->bounded = NULL;
}

int hd_frame_max_in_flight(const HdFrameMaker *maker) {
    return maker->bounded != NULL ? 1 : HD_FRAMES_IN_FLIGHT;
}

HdStatus hd_frame_prepare(const HdFrameMaker *maker, const HdCamera *camera,
                          HdFrameInFlight *in_flight, HdError *error) {
    *in_flight = (HdFrameInFlight){.camera = *camera};
    if (maker->bounded != NULL)
        return HD_OK;
    HdStatus status =
        hd_compile_frame(&in_flight->tables, maker->scene, camera,
                         hd_renderer_options(maker->renderer)->precision, NULL, error);
    in_flight->tables.watched = (HdWatched){maker->watch, HD_WATCH_FRAME};
    return status;
}

HdStatus hd_frame_begin(const HdFrameMaker *maker, HdFrameInFlight *in_flight, HdError *error) {
    if (maker->bounded != NULL)
        return HD_OK;
    HdStatus status =
        hd_renderer_submit(maker->renderer, &in_flight->tables, &maker->request, error);
    if (status != HD_OK)
        hd_frame_tables_free(&in_flight->tables);
    return status;
}

HdStatus hd_frame_end(const HdFrameMaker *maker, HdFrameInFlight *in_flight, HdFrame *frame,
                      HdError *error) {
    if (maker->bounded != NULL)
        return render_bounded(maker, &in_flight->camera, frame, error);
    HdStatus status = hd_renderer_collect(maker->renderer, frame, error);
    if (status == HD_OK && frame->first != NULL)
        status = hd_renderer_first_hits(maker->renderer, &in_flight->tables, frame, error);
    hd_frame_tables_free(&in_flight->tables);
    return status;
}

HdStatus hd_frame_render(const HdFrameMaker *maker, const HdCamera *camera, HdFrame *frame,
                         HdError *error) {
    HdFrameMaker own = *maker;
    HdFrameInFlight in_flight;
    own.request.radiance = true;
    HdStatus status = hd_frame_maker_open(&own, error);
    if (status == HD_OK)
        status = hd_frame_prepare(&own, camera, &in_flight, error);
    if (status == HD_OK)
        status = hd_frame_begin(&own, &in_flight, error);
    if (status == HD_OK)
        status = hd_frame_end(&own, &in_flight, frame, error);
    hd_renderer_drop(own.renderer);
    hd_frame_maker_close(&own);
    return status;
}
