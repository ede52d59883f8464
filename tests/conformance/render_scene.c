/* SPDX-License-Identifier: MIT */
#include "render_scene.h"

#include <stdio.h>
#include <stdlib.h>

_Noreturn void fail(const char *what, const HdError *error) {
    fflush(stdout);
    fprintf(stderr, "%s: %s\n", what, error->message);
    exit(1);
}

HdFrame render_scene(HdRenderer *renderer, const HdScene *scene, const HdCamera *camera,
                     HdPrecision precision, const char *name) {
    HdError error;
    HdFrame frame;
    HdSceneTables tables;
    HdFrameTables view;
    if (hd_scene_validate(scene, &error) != HD_OK ||
        hd_compile_scene(&tables, scene, precision, hd_renderer_lanes(renderer), &error) != HD_OK ||
        hd_compile_frame(&view, scene, camera, precision, &error) != HD_OK ||
        hd_frame_create(&frame, scene->width, scene->height, &error) != HD_OK ||
        hd_renderer_upload(renderer, &tables, &error) != HD_OK ||
        hd_renderer_render(renderer, &view, &frame, &error) != HD_OK)
        fail(name, &error);
    hd_frame_tables_free(&view);
    hd_scene_tables_free(&tables);
    return frame;
}
