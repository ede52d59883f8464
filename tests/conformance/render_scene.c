/* SPDX-License-Identifier: MIT */
#include "render_scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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
    if (backend->enumerate(devices, HD_MAX_DEVICES, &count, &error) == HD_OK)
        return count;
    printf("skip            %s: %s\n", backend->name, error.message);
    return 0;
}

static int greater(int a, int b) {
    return a > b ? a : b;
}

/* What the scenes of the suite need, taken together. */
static void need_most(HdSceneTables *tables) {
    enum { PLANES = 32, DEPTH = 32, NODE_STACK = 32 };
    tables->plane_count = greater(tables->plane_count, PLANES);
    tables->depth = greater(tables->depth, DEPTH);
    tables->node_stack = greater(tables->node_stack, NODE_STACK);
    tables->refracts = tables->lit_from_behind = true;
}

HdFrame render_scene(const Target *target, const HdScene *scene, const HdCamera *camera,
                     const char *name) {
    HdRenderer *renderer = target->renderer;
    HdError error;
    HdFrame frame;
    HdSceneTables tables;
    HdFrameTables view;
    if (hd_scene_validate(scene, &error) != HD_OK ||
        hd_compile_scene(&tables, scene, target->precision, hd_renderer_lanes(renderer), &error) !=
            HD_OK ||
        hd_compile_frame(&view, scene, camera, target->precision, &error) != HD_OK ||
        hd_frame_create(&frame, scene->width, scene->height, &error) != HD_OK)
        fail(name, &error);
    if (target->one_build)
        need_most(&tables);
    if (hd_renderer_upload(renderer, &tables, &error) != HD_OK ||
        hd_renderer_render(renderer, &view, &frame, &error) != HD_OK)
        fail(name, &error);
    hd_frame_tables_free(&view);
    hd_scene_tables_free(&tables);
    return frame;
}
