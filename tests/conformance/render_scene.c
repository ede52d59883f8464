/* SPDX-License-Identifier: MIT */
#include "render_scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "input/check.h"
#include "render/adaptive.h"

_Noreturn void fail(const char *what, const HdError *error) {
    fflush(stdout);
    fprintf(stderr, "%s: %s\n", what, error->message);
    exit(1);
}

int choose(const char *name, const char *const *names, int count) {
    for (int i = 0; i < count; i++)
        if (strcmp(name, names[i]) == 0)
            return i;
    return -1;
}

int find_devices(const HdBackend *backend, HdDevice devices[HD_MAX_DEVICES]) {
    HdError error;
    int count = 0;
    if (hd_backend_enumerate(backend, devices, HD_MAX_DEVICES, &count, &error) == HD_OK)
        return count;
    printf("skip            %s: %s\n", backend->name, error.message);
    return 0;
}

static int greater(int a, int b) {
    return a > b ? a : b;
}

void need_most(HdSceneTables *tables) {
    enum { PLANES = 32, DEPTH = 32, NODE_STACK = 32 };
    tables->plane_count = greater(tables->plane_count, PLANES);
    tables->depth = greater(tables->depth, DEPTH);
    tables->node_stack = greater(tables->node_stack, NODE_STACK);
    tables->refracts = tables->lit_from_behind = true;
}

static HdStatus render_frame(const Target *target, const HdScene *scene, const HdCamera *camera,
                             HdFrame *frame, HdError *error) {
    HdFrameTables view;
    HdStatus status = hd_compile_frame(&view, scene, camera, target->precision, error);
    if (status == HD_OK)
        status = hd_renderer_render(target->renderer, &view, frame, error);
    hd_frame_tables_free(&view);
    return status;
}

static HdStatus refine_frame(const Target *target, const HdScene *scene, const HdCamera *camera,
                             HdFrame *frame, HdError *error) {
    HdRefinement *refinement = NULL;
    HdStatus status = hd_refinement_create(&refinement, scene, target->renderer, target->precision,
                                           HD_CURVE_SRGB, error);
    if (status == HD_OK)
        status = hd_refinement_render(refinement, camera, frame, error);
    hd_refinement_free(refinement);
    return status;
}

HdFrame render_scene(const Target *target, const HdScene *scene, const HdCamera *camera,
                     const char *name) {
    HdRenderer *renderer = target->renderer;
    HdError error;
    HdFrame frame;
    HdSceneTables tables;
    if (hd_scene_validate(scene, &error) != HD_OK ||
        hd_compile_scene(&tables, scene, target->precision, hd_renderer_lanes(renderer), &error) !=
            HD_OK ||
        hd_frame_create(&frame, scene->width, scene->height, &error) != HD_OK)
        fail(name, &error);
    if (target->one_build)
        need_most(&tables);
    if (hd_renderer_upload(renderer, &tables, &error) != HD_OK ||
        (hd_scene_is_surveyed(scene) ? refine_frame : render_frame)(target, scene, camera, &frame,
                                                                    &error) != HD_OK)
        fail(name, &error);
    hd_scene_tables_free(&tables);
    return frame;
}
