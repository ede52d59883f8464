/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "render/upload.h"

void hd_scene_upload_start(HdSceneUpload *upload, const HdScene *scene, HdPrecision precision,
                           int renderer_count) {
    *upload = (HdSceneUpload){.scene = scene, .precision = precision, .waiting = renderer_count};
    pthread_mutex_init(&upload->mutex, NULL);
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

HdStatus hd_scene_upload(HdSceneUpload *upload, HdRenderer *renderer, int number,
                         void (*uploaded)(void *context, int number, const HdSceneTables *tables),
                         void *context, HdError *error) {
    const HdSceneTables *tables;
    pthread_mutex_lock(&upload->mutex);
    HdStatus status = find_tables(upload, hd_renderer_lanes(renderer), &tables, error);
    pthread_mutex_unlock(&upload->mutex);
    if (status == HD_OK)
        status = hd_renderer_upload(renderer, tables, error);
    pthread_mutex_lock(&upload->mutex);
    if (status == HD_OK)
        uploaded(context, number, tables);
    if (--upload->waiting == 0)
        free_tables(upload);
    pthread_mutex_unlock(&upload->mutex);
    return status;
}

void hd_scene_upload_end(HdSceneUpload *upload) {
    free_tables(upload);
    pthread_mutex_destroy(&upload->mutex);
}
