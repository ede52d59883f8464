/* SPDX-License-Identifier: MIT */
#include "verify/trust.h"

#include "render/frame.h"
#include "tables/tables.h"

HdStatus hd_put_tables(HdRenderer *renderer, const HdSceneTables *tables, HdError *error) {
    return hd_renderer_upload(renderer, tables, error);
}

HdStatus hd_put_scene(HdRenderer *renderer, const HdScene *scene, const HdSceneTables *like,
                      HdError *error) {
    HdSceneTables tables;
    HdStatus status = hd_compile_scene(&tables, scene, hd_renderer_options(renderer)->precision,
                                       hd_renderer_lanes(renderer), error);
    if (status != HD_OK)
        return status;
    if (like != NULL)
        hd_scene_tables_raise(&tables, like);
    status = hd_put_tables(renderer, &tables, error);
    hd_scene_tables_free(&tables);
    return status;
}

HdStatus hd_put_and_render(HdRenderer *renderer, const HdScene *scene, const HdCamera *camera,
                           const HdSceneTables *like, unsigned layers, HdFrame *frame,
                           HdError *error) {
    const HdFrameMaker maker = {.renderer = renderer, .scene = scene, .wish.curve = HD_CURVE_SRGB};
    HdStatus status = hd_put_scene(renderer, scene, like, error);
    if (status == HD_OK)
        status = hd_frame_create(frame, scene->width, scene->height, error);
    if (status != HD_OK)
        return status;
    status = hd_frame_add_layers(frame, layers, error);
    if (status == HD_OK)
        status = hd_frame_render(&maker, camera, frame, error);
    if (status != HD_OK)
        hd_frame_free(frame);
    return status;
}
