/* SPDX-License-Identifier: MIT */
#include "compiled.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "input/check.h"
#include "scene/triangulate.h"

enum { DISC_SIDES = 16, DEPTH = 1000 };

HdSolid hd_plain_solid(HdSolidKind kind, HdVec3 centre, double radius, HdVec3 degrees,
                       HdFaceKind faces) {
    HdSolid solid = {.kind = kind, .centre = centre, .circumradius = radius};
    HdVec3 white = hd_vec3(1.0, 1.0, 1.0);
    solid.rotation_degrees = degrees;
    solid.face = (HdMaterial){.colour = white,
                              .mirror_tint = white,
                              .shininess = 1,
                              .reflection = faces == HD_FACE_MIRROR ? 1.0 : 0.0,
                              .transmission = faces == HD_FACE_CLEAR ? 1.0 : 0.0,
                              .index_of_refraction = 1.0};
    solid.rim = solid.face;
    solid.lights.colour_count = 1;
    solid.lights.colours[0] = white;
    return solid;
}

bool hd_compiled_begin(HdCompiled *compiled, const HdSolid *solids, int count, int lights) {
    memset(compiled, 0, sizeof *compiled);
    HdScene *scene = &compiled->scene;
    scene->width = scene->height = 64;
    scene->samples_per_side = 1;
    scene->depth = DEPTH;
    scene->exposure = 1.0;
    scene->frame_count = 1;
    scene->field_of_view_degrees = 60.0;
    scene->target.cylinder.z0 = -1.0; /* not the eye: other frames have other cameras */
    scene->solids = calloc((size_t)count + 1, sizeof *scene->solids);
    scene->lights = calloc((size_t)lights + 1, sizeof *scene->lights);
    if (scene->solids == NULL || scene->lights == NULL) {
        fprintf(stderr, "out of memory\n");
        return false;
    }
    memcpy(scene->solids, solids, (size_t)count * sizeof *solids);
    scene->solid_count = count;
    scene->light_count = lights;
    for (int i = 0; i < lights; i++)
        scene->lights[i].intensity = hd_vec3(1.0, 1.0, 1.0);
    return true;
}

void hd_compiled_put_floor(HdCompiled *compiled, HdVec3 centre, double scale, double height,
                           double half_side) {
    static const double corner[4][2] = {{-1, 1}, {1, 1}, {1, -1}, {-1, -1}};
    HdScene *scene = &compiled->scene;
    scene->floor.present = true;
    for (int i = 0; i < 4; i++) {
        HdVec3 point = {half_side * corner[i][0], half_side * corner[i][1], height};
        scene->floor.corners[i] = hd_add(centre, hd_scale(point, scale));
    }
    scene->floor.material = scene->solids[0].face;
}

bool hd_compiled_finish(HdCompiled *compiled, HdPrecision precision, HdGeometry geometry) {
    HdError error = {.message = ""};
    HdScene *scene = &compiled->scene;
    HdStatus status = hd_scene_validate(scene, &error);
    if (status == HD_OK && geometry == HD_GEOMETRY_TRIANGLES)
        status = hd_scene_triangulate(scene, DISC_SIDES, 1, &error);
    if (status == HD_OK)
        status = hd_compile_scene(&compiled->tables, scene, precision, 1, &error);
    if (status != HD_OK)
        fprintf(stderr, "%s\n", error.message);
    return status == HD_OK;
}

bool hd_compiled_look(HdCompiled *compiled, HdVec3 eye) {
    HdError error = {.message = ""};
    const HdCamera camera = {.eye = eye,
                             .right = {1.0, 0.0, 0.0},
                             .up = {0.0, 0.0, 1.0},
                             .forward = {0.0, 1.0, 0.0},
                             .tangent_of_half_fov = 0.5};
    hd_frame_tables_free(&compiled->frame);
    HdStatus status = hd_compile_frame(&compiled->frame, &compiled->scene, &camera,
                                       compiled->tables.precision, NULL, &error);
    if (status != HD_OK)
        fprintf(stderr, "%s\n", error.message);
    return status == HD_OK;
}

void hd_compiled_free(HdCompiled *compiled) {
    hd_frame_tables_free(&compiled->frame);
    hd_scene_tables_free(&compiled->tables);
    hd_scene_free(&compiled->scene);
    memset(compiled, 0, sizeof *compiled);
}
