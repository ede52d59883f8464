/* SPDX-License-Identifier: MIT */
#include "scene_work.h"

#include "fuzz.h"
#include "scene/camera.h"
#include "tables/tables.h"

/* Compiling more takes the campaign's time. */
enum { MOST_SOLIDS = 8, MOST_LIGHTS = 2000 };

static void compile(const HdScene *scene, const HdCamera *camera, HdPrecision precision) {
    static HdError error;
    HdSceneTables tables;
    HdFrameTables frame;
    HdStatus status = hd_compile_scene(&tables, scene, precision, 1, &error);
    fuzz_expect(status == HD_OK, error.message);
    status = hd_compile_frame(&frame, scene, camera, precision, &error);
    fuzz_expect(status == HD_OK, error.message);
    hd_frame_tables_free(&frame);
    hd_scene_tables_free(&tables);
}

void fuzz_prepare_scene(const HdScene *scene) {
    static HdError error;
    HdCamera camera;
    int lights = scene->light_count;
    for (int i = 0; i < scene->solid_count; i++)
        lights += hd_edge_light_count(&scene->solids[i]);
    const HdStatus status = hd_camera_at(&camera, scene, scene->frame_count - 1, &error);
    fuzz_expect_input_status(status, &error);
    if (status != HD_OK || scene->solid_count > MOST_SOLIDS || lights > MOST_LIGHTS)
        return;
    compile(scene, &camera, HD_PRECISION_FLOAT);
    compile(scene, &camera, HD_PRECISION_DOUBLE);
}
