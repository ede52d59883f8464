/* SPDX-License-Identifier: MIT */
#include "verify/render_scene.h"

#include "render/adaptive.h"
#include "tables/tables.h"

const HdSceneTables hd_golden_needs = {.plane_count = 32,
                                       .depth = 32,
                                       .node_stack = 32,
                                       .refracts = true,
                                       .lit_from_behind = true,
                                       .many_lights = true,
                                       .small_tables = true};

HdStatus hd_upload_scene(HdRenderer *renderer, const HdScene *scene, HdPrecision precision,
                         const HdSceneTables *like, HdError *error) {
    HdSceneTables tables;
    HdStatus status =
        hd_compile_scene(&tables, scene, precision, hd_renderer_lanes(renderer), error);
    if (status != HD_OK)
        return status;
    if (like != NULL)
        hd_scene_tables_raise(&tables, like);
    status = hd_renderer_upload(renderer, &tables, error);
    hd_scene_tables_free(&tables);
    return status;
}

static HdStatus trace_grid(HdRenderer *renderer, const HdScene *scene, const HdCamera *camera,
                           HdPrecision precision, HdFrame *frame, HdError *error) {
    HdFrameTables view;
    HdStatus status = hd_compile_frame(&view, scene, camera, precision, error);
    if (status == HD_OK)
        status = hd_renderer_render(renderer, &view, frame, error);
    if (status == HD_OK && frame->first != NULL)
        status = hd_renderer_first_hits(renderer, &view, frame, error);
    hd_frame_tables_free(&view);
    return status;
}

static HdStatus refine(HdRenderer *renderer, const HdScene *scene, const HdCamera *camera,
                       HdPrecision precision, HdFrame *frame, HdError *error) {
    HdRefinement *refinement = NULL;
    HdStatus status =
        hd_refinement_create(&refinement, scene, renderer, precision, HD_CURVE_SRGB, error);
    if (status == HD_OK)
        status = hd_refinement_render(refinement, camera, NULL, frame, error);
    hd_refinement_free(refinement);
    return status;
}

HdStatus hd_render_scene(HdRenderer *renderer, const HdScene *scene, const HdCamera *camera,
                         HdPrecision precision, const HdSceneTables *like, unsigned layers,
                         HdFrame *frame, HdError *error) {
    HdStatus status = hd_upload_scene(renderer, scene, precision, like, error);
    if (status == HD_OK)
        status = hd_frame_create(frame, scene->width, scene->height, error);
    if (status != HD_OK)
        return status;
    status = hd_frame_add_layers(frame, layers, error);
    if (status == HD_OK)
        status = (hd_scene_is_surveyed(scene) ? refine : trace_grid)(renderer, scene, camera,
                                                                     precision, frame, error);
    if (status != HD_OK)
        hd_frame_free(frame);
    return status;
}
