/* SPDX-License-Identifier: MIT */
/* One scene for several renderers: it is compiled once for all of the same lanes. */
#ifndef HD_RENDER_UPLOAD_H
#define HD_RENDER_UPLOAD_H

#include "device/renderer.h"
#include "scene/scene.h"

typedef struct HdSceneUpload HdSceneUpload;

/* The scene must live on; `renderer_count` renderers will get it. */
HdStatus hd_scene_upload_create(HdSceneUpload **upload, const HdScene *scene, HdPrecision precision,
                                int renderer_count, HdError *error);

/* Puts the scene on a renderer, once for each; from several threads at once if need be. `uploaded`
   is called then, for one renderer at a time. The tables are freed after the last one. */
HdStatus hd_scene_upload(HdSceneUpload *upload, HdRenderer *renderer,
                         void (*uploaded)(void *context, const HdSceneTables *tables),
                         void *context, HdError *error);

/* NULL is allowed. */
void hd_scene_upload_free(HdSceneUpload *upload);

#endif
