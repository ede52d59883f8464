/* SPDX-License-Identifier: MIT */
#include "compiled_scene.h"

#include <stdlib.h>
#include <string.h>

#include "compile_tables.h"

static void free_tables(HdTable *table, int count) {
    for (int i = 0; i < count; i++)
        free(table[i].data);
}

void hd_scene_tables_free(HdSceneTables *tables) {
    free_tables(tables->table, tables->table_count);
    memset(tables, 0, sizeof *tables);
}

void hd_frame_tables_free(HdFrameTables *tables) {
    free_tables(tables->table, tables->table_count);
    memset(tables, 0, sizeof *tables);
}

HdStatus hd_compile_scene(HdSceneTables *tables, const HdScene *scene, HdPrecision precision,
                          int lanes, HdError *error) {
    memset(tables, 0, sizeof *tables);
    tables->precision = precision;
    tables->lanes = lanes;
    HdStatus status = precision == HD_PRECISION_FLOAT
                          ? hd_compile_scene_float(tables, scene, error)
                          : hd_compile_scene_double(tables, scene, error);
    if (status != HD_OK)
        hd_scene_tables_free(tables);
    return status;
}

HdStatus hd_compile_frame(HdFrameTables *tables, const HdScene *scene, const HdCamera *camera,
                          HdPrecision precision, HdError *error) {
    memset(tables, 0, sizeof *tables);
    tables->precision = precision;
    tables->width = scene->width;
    tables->height = scene->height;
    tables->samples_per_side = scene->samples_per_side;
    HdStatus status = precision == HD_PRECISION_FLOAT
                          ? hd_compile_frame_float(tables, scene, camera, error)
                          : hd_compile_frame_double(tables, scene, camera, error);
    if (status != HD_OK)
        hd_frame_tables_free(tables);
    return status;
}
