/* SPDX-License-Identifier: MIT */
/* One scene for several renderers: it is compiled once for all of the same lanes. */
#ifndef HD_RENDER_UPLOAD_H
#define HD_RENDER_UPLOAD_H

#include <pthread.h>

#include "device/renderer.h"
#include "scene/scene.h"

/* One for each count of lanes. */
#define HD_UPLOAD_COUNTED(lanes) +1
enum { HD_UPLOAD_KINDS = 0 HD_LANE_COUNTS(HD_UPLOAD_COUNTED) };

typedef struct HdSceneUpload {
    const HdScene *scene;
    HdPrecision precision;
    pthread_mutex_t mutex; /* of what follows */
    HdSceneTables tables[HD_UPLOAD_KINDS];
    int count;
    int waiting; /* renderers that have not got the scene */
} HdSceneUpload;

/* The scene must live on; `renderer_count` renderers will get it. */
void hd_scene_upload_start(HdSceneUpload *upload, const HdScene *scene, HdPrecision precision,
                           int renderer_count);

/* Puts the scene on renderer `number`, once for each; from several threads at once if need be.
   `uploaded` is called then, for one renderer at a time. The tables are freed after the last one.
 */
HdStatus hd_scene_upload(HdSceneUpload *upload, HdRenderer *renderer, int number,
                         void (*uploaded)(void *context, int number, const HdSceneTables *tables),
                         void *context, HdError *error);

void hd_scene_upload_end(HdSceneUpload *upload);

#endif
