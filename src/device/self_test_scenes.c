/* SPDX-License-Identifier: MIT */
#include "device/self_test_scenes.h"

#include <stdlib.h>
#include <string.h>

#include "device/self_test_mesh.h"

enum { SIDE = 16, SAMPLES = 2, DEPTH = 5, LIGHTS = 2, TEXTURE_WIDTH = 6, TEXTURE_HEIGHT = 5 };

static HdMaterial material(HdVec3 colour, double reflection, double transmission) {
    return (HdMaterial){.colour = colour,
                        .mirror_tint = hd_vec3(0.9, 0.95, 1.0),
                        .ambient = 0.02,
                        .diffuse = 0.4,
                        .specular = 0.3,
                        .shininess = 21,
                        .reflection = reflection,
                        .transmission = transmission,
                        .index_of_refraction = 1.0};
}

static HdPath fixed(HdVec3 point) {
    return (HdPath){.is_fixed = true, .point = point};
}

/* Lights of which one fades and one ends; the second lies within the cube. */
static HdStatus add_lights(HdScene *scene, HdError *error) {
    scene->lights = calloc(LIGHTS, sizeof *scene->lights);
    if (scene->lights == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room for the test of the kernels");
    scene->light_count = LIGHTS;
    scene->lights[0] = (HdLight){.position = hd_vec3(1.5, -2.5, 3.0),
                                 .intensity = hd_vec3(1.0, 0.9, 0.7),
                                 .falloff = {.distance = 4.0}};
    scene->lights[1] = (HdLight){.position = hd_vec3(0.125, -0.25, 0.25),
                                 .intensity = hd_vec3(0.3, 0.5, 0.9),
                                 .falloff = {.end = 6.0}};
    return HD_OK;
}

static HdStatus add_cube(HdScene *scene, bool refracts, bool lit_from_behind, HdError *error) {
    scene->solids = calloc(1, sizeof *scene->solids);
    if (scene->solids == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room for the test of the kernels");
    scene->solid_count = 1;
    HdSolid *cube = &scene->solids[0];
    *cube = (HdSolid){.kind = HD_HEXAHEDRON,
                      .circumradius = 1.25,
                      .rotation_degrees = hd_vec3(10.0, 20.0, 30.0),
                      .face = material(hd_vec3(0.8, 0.9, 0.6), 0.15, 0.7),
                      .rim_width = 0.1,
                      .rim = material(hd_vec3(0.3, 0.2, 0.1), 0.0, 0.0),
                      .lights = {.per_edge = 2,
                                 .colour_count = 2,
                                 .colours = {{1.0, 0.5, 0.25}, {0.25, 0.75, 1.0}},
                                 .intensity = 0.0625,
                                 .falloff = {.distance = 1.25},
                                 .disc_radius = 0.0625,
                                 .disc_radiance = 2.0}};
    cube->face.has_inner_side = true;
    cube->face.inner_reflection = 0.6;
    cube->face.inner_transmission = 0.35;
    cube->face.lit_from_behind = lit_from_behind;
    if (refracts)
        cube->face.index_of_refraction = 1.5;
    return HD_OK;
}

static HdStatus add_texture(HdTexture *texture, HdError *error) {
    texture->texels = calloc((size_t)TEXTURE_WIDTH * TEXTURE_HEIGHT * 3, sizeof(uint16_t));
    if (texture->texels == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room for the test of the kernels");
    texture->width = TEXTURE_WIDTH;
    texture->height = TEXTURE_HEIGHT;
    for (int i = 0; i < TEXTURE_WIDTH * TEXTURE_HEIGHT * 3; i++)
        texture->texels[i] = (uint16_t)(i * 40503 + 12345);
    return HD_OK;
}

static HdStatus add_floor(HdScene *scene, HdError *error) {
    static const HdVec3 corners[4] = {
        {-3.0, 3.0, -1.5}, {3.0, 3.0, -1.5}, {3.0, -3.0, -1.5}, {-3.0, -3.0, -1.5}};
    HdFloor *floor = &scene->floor;
    floor->present = true;
    memcpy(floor->corners, corners, sizeof corners);
    floor->material = material(hd_vec3(0.9, 0.8, 0.7), 0.2, 0.3);
    return add_texture(&floor->texture, error);
}

/* ---- meshes ---- */

enum { BALL, CUBE, MESHES, INSTANCES = 4 };

static void set_materials(HdScene *scene, bool refracts, bool lit_from_behind) {
    HdMeshMaterial *ball = scene->meshes[BALL].materials, *cube = scene->meshes[CUBE].materials;
    ball[0] = (HdMeshMaterial){
        .material = material(hd_vec3(0.8, 0.9, 0.6), 0.15, 0.7), .picture = -1, .passes_as = -1};
    ball[0].material.has_inner_side = true;
    ball[0].material.inner_reflection = 0.6;
    ball[0].material.inner_transmission = 0.35;
    ball[1] = (HdMeshMaterial){.material = material(hd_vec3(0.9, 0.7, 0.8), 0.1, 0.5),
                               .emission = hd_vec3(0.05, 0.1, 0.02),
                               .picture = 0,
                               .passes_as = 0};
    for (int i = 0; i < 2; i++) {
        ball[i].material.lit_from_behind = lit_from_behind;
        if (refracts)
            ball[i].material.index_of_refraction = 1.5;
    }
    cube[0] = (HdMeshMaterial){
        .material = material(hd_vec3(0.6, 0.3, 0.2), 0.5, 0.0), .picture = -1, .passes_as = -1};
}

/* So many that there is a hierarchy over them, none of them in another. */
static HdStatus place_meshes(HdScene *scene, HdError *error) {
    scene->instances = calloc(INSTANCES, sizeof *scene->instances);
    if (scene->instances == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room for the test of the kernels");
    scene->instance_count = INSTANCES;
    HdInstance *instances = scene->instances;
    instances[0] = (HdInstance){.mesh = BALL,
                                .position = hd_vec3(0.0, 0.0, 0.125),
                                .rotation_degrees = hd_vec3(10.0, 20.0, 30.0),
                                .scale = hd_vec3(1.0, 0.875, 0.75)};
    instances[1] = (HdInstance){.mesh = BALL,
                                .position = hd_vec3(1.0, 1.25, 0.5),
                                .scale = hd_vec3(0.5, 0.5, 0.5),
                                .has_material = true,
                                .material = material(hd_vec3(0.5, 0.75, 1.0), 0.25, 0.5)};
    instances[2] = (HdInstance){.mesh = CUBE,
                                .position = hd_vec3(-1.0, 0.75, -1.0),
                                .rotation_degrees = hd_vec3(0.0, 0.0, 25.0),
                                .scale = hd_vec3(0.375, 0.375, 0.375)};
    instances[3] = (HdInstance){.mesh = CUBE,
                                .position = hd_vec3(0.625, -1.0, -0.75),
                                .rotation_degrees = hd_vec3(15.0, 0.0, 40.0),
                                .scale = hd_vec3(0.375, 0.25, 0.125)};
    return HD_OK;
}

static HdStatus add_meshes(HdScene *scene, bool refracts, bool lit_from_behind, HdError *error) {
    scene->meshes = calloc(MESHES, sizeof *scene->meshes);
    scene->pictures = calloc(1, sizeof *scene->pictures);
    if (scene->meshes == NULL || scene->pictures == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room for the test of the kernels");
    scene->mesh_count = MESHES;
    scene->picture_count = 1;
    HdStatus status = add_texture(&scene->pictures[0].texture, error);
    for (int i = 0; i < MESHES && status == HD_OK; i++)
        status = hd_self_test_mesh(&scene->meshes[i], i == BALL, error);
    if (status != HD_OK)
        return status;
    set_materials(scene, refracts, lit_from_behind);
    return place_meshes(scene, error);
}

HdStatus hd_self_test_scene(HdScene *scene, HdSelfTestFrame frame, bool refracts,
                            bool lit_from_behind, HdError *error) {
    *scene = (HdScene){.frame_count = 1,
                       .eye = fixed(hd_vec3(2.0, -2.75, 1.25)),
                       .target = fixed(hd_vec3(0.0, 0.0, -0.25)),
                       .field_of_view_degrees = 50.0,
                       .width = SIDE,
                       .height = SIDE,
                       .samples_per_side = SAMPLES,
                       .depth = DEPTH,
                       .cutoff = 0.001,
                       .exposure = 1.25,
                       .background = hd_vec3(0.01, 0.02, 0.04)};
    HdStatus status = add_lights(scene, error);
    if (status == HD_OK)
        status = frame == HD_SELF_TEST_SOLID ? add_cube(scene, refracts, lit_from_behind, error)
                                             : add_floor(scene, error);
    if (status == HD_OK && frame == HD_SELF_TEST_MESH)
        status = add_meshes(scene, refracts, lit_from_behind, error);
    if (status != HD_OK)
        hd_scene_free(scene);
    return status;
}
