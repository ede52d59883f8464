/* SPDX-License-Identifier: MIT */
#include "frames_in_flight.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "image/picture.h"
#include "verify/golden.h"

enum { ROUNDS = 5, VIEWS = 2 };

static const char frame_name[] = "everything";
static const HdFrameRequest requests[ROUNDS] = {
    {.curve = HD_CURVE_SRGB}, {.radiance = true},         {.curve = HD_CURVE_LINEAR},
    {.curve = HD_CURVE_SRGB}, {.curve = HD_CURVE_LINEAR},
};

/* One scene with two cameras, so that no frame can be mistaken for its neighbour. */
typedef struct Views {
    HdFrameTables tables[VIEWS];
    HdFrame singles[VIEWS];
} Views;

static void open_views(Views *views, const Target *target) {
    HdScene scene;
    HdCamera camera;
    HdError error;
    if (hd_golden_build(hd_golden_find(frame_name), &scene, &camera, &error) != HD_OK)
        fail(frame_name, &error);
    for (int i = 0; i < VIEWS; i++) {
        views->singles[i] = render_scene(target, &scene, &camera, frame_name);
        if (hd_compile_frame(&views->tables[i], &scene, &camera, target->precision, NULL, &error) !=
            HD_OK)
            fail(frame_name, &error);
        if (hd_frame_add_rgba(&views->singles[i], &error) != HD_OK)
            fail(frame_name, &error);
        camera.right = hd_scale(camera.right, -1.0);
        camera.up = hd_scale(camera.up, -1.0);
    }
    hd_scene_free(&scene);
}

static void close_views(Views *views) {
    for (int i = 0; i < VIEWS; i++) {
        hd_frame_tables_free(&views->tables[i]);
        hd_frame_free(&views->singles[i]);
    }
}

/* Compares a frame that arrived as requested. */
static bool is_same(const Views *views, int round, HdFrame *frame) {
    const HdFrame *singles = &views->singles[round % VIEWS];
    size_t pixels = (size_t)frame->width * (size_t)frame->height;
    if (!frame->is_encoded)
        return hd_frame_hash(frame) == hd_frame_hash(singles);
    hd_frame_encode(singles, requests[round].curve);
    return !requests[round].radiance && memcmp(frame->rgba, singles->rgba, 4 * pixels) == 0 &&
           hd_frame_rays(frame) == hd_frame_rays(singles) &&
           frame->shadow_tests == singles->shadow_tests && frame->clamps == singles->clamps;
}

static bool collect(Views *views, HdRenderer *renderer, int round) {
    HdFrame frame;
    HdError error;
    if (hd_frame_create(&frame, views->singles[0].width, views->singles[0].height, &error) !=
            HD_OK ||
        hd_frame_add_rgba(&frame, &error) != HD_OK)
        fail(frame_name, &error);
    if (hd_renderer_collect(renderer, &frame, &error) != HD_OK)
        fail(frame_name, &error);
    bool same = is_same(views, round, &frame);
    hd_frame_free(&frame);
    return same;
}

/* Submits each frame before collecting its predecessor. The last one is dropped. */
void check_frames_in_flight(const Target *target, int *pictures, int *different) {
    Views views;
    HdError error;
    open_views(&views, target);
    for (int round = 0; round < ROUNDS; round++) {
        if (hd_renderer_submit(target->renderer, &views.tables[round % VIEWS], &requests[round],
                               &error) != HD_OK)
            fail(frame_name, &error);
        if (round == 0)
            continue;
        ++*pictures;
        if (collect(&views, target->renderer, round - 1))
            continue;
        ++*different;
        printf("DIFFERENT frame %d of those under way together, on %s\n", round - 1, target->label);
    }
    hd_renderer_drop(target->renderer);
    close_views(&views);
}
