/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "render/upload.h"

#include <pthread.h>
#include <stdlib.h>

/* One for each count of lanes. */
#define COUNTED(lanes) +1
enum { KINDS = 0 HD_LANE_COUNTS(COUNTED) };

struct HdSceneUpload {
    const HdScene *scene;
    HdPrecision precision;
    pthread_mutex_t mutex; /* of what follows */
    HdSceneTables tables[KINDS];
    int count;
    int waiting; /* renderers that have not got the scene */
};

HdStatus hd_scene_upload_create(HdSceneUpload **out, const HdScene *scene, HdPrecision precision,
                                int renderer_count, HdError *error) {
    HdSceneUpload *upload = calloc(1, sizeof *upload);
    *out = upload;
    if (upload == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room for the scene's tables");
    upload->scene = scene;
    upload->precision = precision;
    upload->waiting = renderer_count;
    pthread_mutex_init(&upload->mutex, NULL);
    return HD_OK;
}

static HdStatus find_tables(HdSceneUpload *upload, int lanes, const HdSceneTables **found,
                            HdError *error) {
    for (int i = 0; i < upload->count; i++)
        if (upload->tables[i].lanes == lanes) {
            *found = &upload->tables[i];
            return HD_OK;
        }
    HdSceneTables *tables = &upload->tables[upload->count];
    HdStatus status = hd_compile_scene(tables, upload->scene, upload->precision, lanes, error);
    if (status == HD_OK)
        upload->count++;
    *found = tables;
    return status;
}

static void free_tables(HdSceneUpload *upload) {
    for (; upload->count > 0; upload->count--)
        hd_scene_tables_free(&upload->tables[upload->count - 1]);
}

HdStatus hd_scene_upload(HdSceneUpload *upload, HdRenderer *renderer,
                         void (*uploaded)(void *context, const HdSceneTables *tables),
                         void *context, HdError *error) {
    const HdSceneTables *tables;
    pthread_mutex_lock(&upload->mutex);
    HdStatus status = find_tables(upload, hd_renderer_lanes(renderer), &tables, error);
    pthread_mutex_unlock(&upload->mutex);
    if (status == HD_OK)
        status = hd_renderer_upload(renderer, tables, error);
    pthread_mutex_lock(&upload->mutex);
    if (status == HD_OK)
        uploaded(context, tables);
    if (--upload->waiting == 0)
        free_tables(upload);
    pthread_mutex_unlock(&upload->mutex);
    return status;
}

void hd_scene_upload_free(HdSceneUpload *upload) {
    if (upload == NULL)
        return;
    free_tables(upload);
    pthread_mutex_destroy(&upload->mutex);
    free(upload);
}
