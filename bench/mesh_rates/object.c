/* SPDX-License-Identifier: MIT */
#define HD_DOUBLE 0
#include "object.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "certify/mesh_builder.h"
#include "input/check.h"
#include "kernels/host/shared.h"
#include "system/thread_pool.h"

const double hd_object_tangent = 0.6;
const double hd_object_filter[3] = {0.9, 0.6, 0.3};

static const double shell_radius = 4.0;

static HdMaterial material_of(double red, double green, double blue, double transmission) {
    return (HdMaterial){.colour = hd_vec3(red, green, blue),
                        .mirror_tint = hd_vec3(1.0, 1.0, 1.0),
                        .diffuse = 1.0,
                        .shininess = 1,
                        .transmission = transmission,
                        .index_of_refraction = 1.0};
}

/* Adds a mesh, larger by `scale`, whose outer side becomes the inner one; with a material of its
   own. */
static void take_in(HdMesh *mesh, const HdMesh *other, double scale) {
    for (int i = 0; i < other->vertex_count; i++)
        mesh->vertices[mesh->vertex_count + i] = hd_scale(other->vertices[i], scale);
    for (int i = 0; i < other->triangle_count; i++) {
        int32_t *corners = mesh->corners[mesh->triangle_count + i];
        for (int k = 0; k < 3; k++)
            corners[k] = other->corners[i][2 - k] + mesh->vertex_count;
        mesh->material_of[mesh->triangle_count + i] = mesh->material_count;
    }
    mesh->materials[mesh->material_count++] = other->materials[0];
    mesh->vertex_count += other->vertex_count;
    mesh->triangle_count += other->triangle_count;
}

/* Room for a second mesh as large. */
static bool make_room(HdMesh *mesh) {
    size_t vertices = 2 * (size_t)mesh->vertex_count, triangles = 2 * (size_t)mesh->triangle_count;
    HdVec3 *places = realloc(mesh->vertices, vertices * sizeof *places);
    mesh->vertices = places != NULL ? places : mesh->vertices;
    int32_t(*corners)[3] = realloc(mesh->corners, triangles * sizeof *corners);
    mesh->corners = corners != NULL ? corners : mesh->corners;
    HdMeshMaterial *materials = realloc(mesh->materials, 2 * sizeof *materials);
    mesh->materials = materials != NULL ? materials : mesh->materials;
    mesh->material_of = calloc(triangles, sizeof *mesh->material_of);
    return places != NULL && corners != NULL && materials != NULL && mesh->material_of != NULL;
}

static bool fill_mesh(HdMesh *mesh, int triangles) {
    const double *filter = hd_object_filter;
    HdMaterial glass = material_of(filter[0], filter[1], filter[2], 1.0);
    HdMaterial white = material_of(1.0, 1.0, 1.0, 0.0);
    HdMesh shell = {0};
    int rows = 2;
    while (8 * rows * rows <= triangles)
        rows++;
    build_sphere_mesh(mesh, rows, 0.2, false, false, &glass);
    build_sphere_mesh(&shell, rows, 0.0, false, false, &white);
    bool done = make_room(mesh);
    if (done)
        take_in(mesh, &shell, shell_radius);
    hd_mesh_free(&shell);
    return done;
}

static HdStatus build(HdMesh *mesh, HdError *error) {
    HdThreadPool *pool;
    HdStatus status = hd_thread_pool_create(&pool, 1, error);
    if (status != HD_OK)
        return status;
    status = hd_mesh_build(mesh, pool, error);
    hd_thread_pool_destroy(pool);
    return status;
}

/* Room for one mesh and one instance. */
static bool begin_scene(HdScene *scene, int triangles) {
    memset(scene, 0, sizeof *scene);
    scene->width = scene->height = 64;
    scene->samples_per_side = 1;
    scene->depth = 1;
    scene->exposure = 1.0;
    scene->frame_count = 1;
    scene->field_of_view_degrees = 60.0;
    scene->target.cylinder.z0 = -1.0; /* not at the eye; the camera is another */
    scene->meshes = calloc(1, sizeof *scene->meshes);
    scene->instances = calloc(1, sizeof *scene->instances);
    if (scene->meshes == NULL || scene->instances == NULL)
        return false;
    scene->mesh_count = scene->instance_count = 1;
    scene->instances[0].scale = hd_vec3(1.0, 1.0, 1.0);
    return fill_mesh(&scene->meshes[0], triangles);
}

/* The triangles as the kernels have them, and points relative to the centre. */
static bool take_geometry(HdObject *object, HdVec3 eye, HdVec3 light) {
    const Triangle *triangles = object->tables.table[HD_TABLE_triangles].data;
    const Header *header = object->tables.table[HD_TABLE_header].data;
    const Vector *offset =
        (const Vector *)object->frame.table[HD_TABLE_eye_offsets].data + header->floor_end;
    object->eye = hd_vec3((double)offset->x, (double)offset->y, (double)offset->z);
    object->centre = hd_sub(eye, object->eye);
    object->light = hd_sub(light, object->centre);
    object->triangle_count = object->scene.meshes[0].triangle_count;
    object->normals = malloc((size_t)object->triangle_count * sizeof *object->normals);
    if (object->normals == NULL)
        return false;
    for (int i = 0; i < object->triangle_count; i++) {
        const real *p[3] = {triangles[i].a, triangles[i].b, triangles[i].c};
        HdVec3 side[2];
        for (int k = 0; k < 2; k++)
            side[k] = hd_vec3((double)p[k + 1][0] - (double)p[0][0],
                              (double)p[k + 1][1] - (double)p[0][1],
                              (double)p[k + 1][2] - (double)p[0][2]);
        object->normals[i] = hd_normalize(hd_cross(side[0], side[1]));
    }
    return true;
}

bool hd_object_create(HdObject *object, int triangles, int lanes) {
    HdError error = {.message = "too little memory for the object"};
    const HdVec3 eye = hd_vec3(0.3, -2.7, 0.6), light = hd_vec3(1.5, -1.8, 2.2);
    HdCamera camera = {.eye = eye,
                       .forward = hd_vec3(0.0, 1.0, 0.0),
                       .right = hd_vec3(1.0, 0.0, 0.0),
                       .up = hd_vec3(0.0, 0.0, 1.0),
                       .tangent_of_half_fov = hd_object_tangent};
    memset(object, 0, sizeof *object);
    HdScene *scene = &object->scene;
    if (begin_scene(scene, triangles) && build(&scene->meshes[0], &error) == HD_OK &&
        hd_scene_validate(scene, &error) == HD_OK &&
        hd_compile_scene(&object->tables, scene, HD_PRECISION_FLOAT, lanes, &error) == HD_OK &&
        hd_compile_frame(&object->frame, scene, &camera, HD_PRECISION_FLOAT, &error) == HD_OK &&
        take_geometry(object, eye, light))
        return true;
    fprintf(stderr, "%s\n", error.message);
    hd_object_free(object);
    return false;
}

HdVec3 hd_object_corner(const HdObject *object, int triangle, int corner) {
    const Triangle *found =
        (const Triangle *)object->tables.table[HD_TABLE_triangles].data + triangle;
    const real *p = corner == 0 ? found->a : corner == 1 ? found->b : found->c;
    return hd_vec3((double)p[0], (double)p[1], (double)p[2]);
}

void hd_object_free(HdObject *object) {
    free(object->normals);
    hd_frame_tables_free(&object->frame);
    hd_scene_tables_free(&object->tables);
    hd_scene_free(&object->scene);
}
