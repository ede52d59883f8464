/* SPDX-License-Identifier: MIT */
#include "device/self_test_scenes.h"

#include <stdlib.h>
#include <string.h>

#include "mesh/mesh.h"

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

/* The points of a lattice of 3 x 3 x 3, all but its middle: each face has four squares. */
enum { POINTS = 26, MIDDLE = 13, FACES = 6, TRIANGLES = 48 };

/* Of the point with the coordinates 0, 1 or 2. */
static int32_t number_of(const int point[3]) {
    int number = point[0] + 3 * point[1] + 9 * point[2];
    return number < MIDDLE ? number : number - 1;
}

static HdVec3 place_of(const int point[3], bool is_ball) {
    static const double reach[4] = {0.0, 1.0, 0.75, 0.625};
    int away = 0;
    for (int axis = 0; axis < 3; axis++)
        away += point[axis] != 1;
    return hd_scale(hd_vec3(point[0] - 1, point[1] - 1, point[2] - 1), is_ball ? reach[away] : 1.0);
}

static HdStatus allocate_mesh(HdMesh *mesh, bool is_ball, HdError *error) {
    mesh->triangle_count = TRIANGLES;
    mesh->vertex_count = POINTS;
    mesh->material_count = is_ball ? 2 : 1;
    mesh->vertices = calloc(POINTS, sizeof *mesh->vertices);
    mesh->corners = calloc(TRIANGLES, sizeof *mesh->corners);
    mesh->materials = calloc((size_t)mesh->material_count, sizeof *mesh->materials);
    bool has_room = mesh->vertices != NULL && mesh->corners != NULL && mesh->materials != NULL;
    if (is_ball) {
        mesh->normal_count = mesh->uv_count = POINTS;
        mesh->normals = calloc(POINTS, sizeof *mesh->normals);
        mesh->uvs = calloc(POINTS, sizeof *mesh->uvs);
        mesh->corner_normals = calloc(TRIANGLES, sizeof *mesh->corner_normals);
        mesh->corner_uvs = calloc(TRIANGLES, sizeof *mesh->corner_uvs);
        mesh->material_of = calloc(TRIANGLES, sizeof *mesh->material_of);
        has_room = has_room && mesh->normals != NULL && mesh->uvs != NULL &&
                   mesh->corner_normals != NULL && mesh->corner_uvs != NULL &&
                   mesh->material_of != NULL;
    } else {
        mesh->group_of = calloc(TRIANGLES, sizeof *mesh->group_of);
        has_room = has_room && mesh->group_of != NULL;
    }
    return has_room
               ? HD_OK
               : hd_fail(error, HD_FAILED, "out of memory: no room for the test of the kernels");
}

static void place_points(HdMesh *mesh, bool is_ball) {
    for (int i = 0; i < POINTS; i++) {
        int number = i < MIDDLE ? i : i + 1;
        const int point[3] = {number % 3, number / 3 % 3, number / 9};
        HdVec3 place = place_of(point, is_ball);
        mesh->vertices[i] = place;
        if (!is_ball)
            continue;
        mesh->normals[i] = place;
        mesh->uvs[i][0] = 0.5 * place.x + 0.25 * place.z;
        mesh->uvs[i][1] = 0.75 * place.y - 0.125 * place.z;
    }
}

static void add_triangle(HdMesh *mesh, int number, const int32_t corners[3], int face) {
    for (int k = 0; k < 3; k++) {
        mesh->corners[number][k] = corners[k];
        if (mesh->normals != NULL)
            mesh->corner_normals[number][k] = mesh->corner_uvs[number][k] = corners[k];
    }
    if (mesh->material_of != NULL)
        mesh->material_of[number] = face / 2 == 2;
    if (mesh->group_of != NULL)
        mesh->group_of[number] = (uint8_t)(face + 1);
}

/* The square with the given lowest corner, on the lower or the upper face across an axis. */
static void add_square(HdMesh *mesh, int number, int face, int first, int second) {
    static const int steps[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    int axis = face / 2, upper = face % 2;
    int32_t around[4];
    for (int k = 0; k < 4; k++) {
        const int *step = steps[upper ? k : 3 - k]; /* counterclockwise as seen from outside */
        int point[3];
        point[axis] = 2 * upper;
        point[(axis + 1) % 3] = first + step[0];
        point[(axis + 2) % 3] = second + step[1];
        around[k] = number_of(point);
    }
    add_triangle(mesh, number, (const int32_t[3]){around[0], around[1], around[2]}, face);
    add_triangle(mesh, number + 1, (const int32_t[3]){around[0], around[2], around[3]}, face);
}

/* A closed mesh of 48 triangles, built, whose corners are exact numbers on every system: a ball
   with smooth normals, texture coordinates and the materials 0 and, above and below, 1; or a cube
   within
   +-1 whose faces are groups, of material 0. The materials are left zeroed. */
static HdStatus make_mesh(HdMesh *mesh, bool is_ball, HdError *error) {
    HdThreadPool *pool = NULL;
    *mesh = (HdMesh){0};
    HdStatus status = allocate_mesh(mesh, is_ball, error);
    if (status != HD_OK)
        return status;
    place_points(mesh, is_ball);
    for (int square = 0; square < 4 * FACES; square++)
        add_square(mesh, 2 * square, square / 4, square % 2, square / 2 % 2);
    status = hd_thread_pool_create(&pool, 1, error);
    if (status == HD_OK)
        status = hd_mesh_build(mesh, pool, error);
    hd_thread_pool_destroy(pool);
    return status;
}

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
        status = make_mesh(&scene->meshes[i], i == BALL, error);
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
