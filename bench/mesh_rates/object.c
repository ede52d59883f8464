/* SPDX-License-Identifier: MIT */
#define HD_DOUBLE 0
#include "object.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../kernels/common/scene_tables.h"
#include "thread_pool.h"
#include "trigonometry.h"

const double hd_object_filter[3] = {0.9, 0.6, 0.3};

static const double shell_radius = 4.0;

/* A globe of `rows` rings, added to a mesh that has room for it. */
typedef struct Globe {
    int rows, columns, first_vertex;
    double radius, bump;
    bool inward; /* its outer side is the inner one */
} Globe;

static int32_t vertex_at(const Globe *globe, int row, int column) {
    if (row == 0 || row == globe->rows)
        return globe->first_vertex + (row == 0 ? 0 : 1);
    return globe->first_vertex + 2 + (row - 1) * globe->columns + column % globe->columns;
}

static HdVec3 point_at(const Globe *globe, int row, int column) {
    double polar_sine, polar_cosine, sine, cosine, wave, other_wave, unused;
    hd_sine_cosine(HD_PI * row / globe->rows, &polar_sine, &polar_cosine);
    hd_sine_cosine(2.0 * HD_PI * column / globe->columns, &sine, &cosine);
    hd_sine_cosine(10.0 * HD_PI * column / globe->columns, &wave, &unused);
    hd_sine_cosine(4.0 * HD_PI * row / globe->rows, &other_wave, &unused);
    double radius =
        globe->radius * (1.0 + globe->bump * wave * other_wave * polar_sine * polar_sine);
    return hd_scale(hd_vec3(polar_sine * cosine, polar_sine * sine, polar_cosine), radius);
}

static void add_triangle(HdMesh *mesh, const Globe *globe, int32_t a, int32_t b, int32_t c) {
    int32_t *corners = mesh->corners[mesh->triangle_count];
    mesh->material_of[mesh->triangle_count++] = globe->inward;
    corners[0] = a;
    corners[1] = globe->inward ? c : b;
    corners[2] = globe->inward ? b : c;
}

static void add_globe(HdMesh *mesh, const Globe *globe) {
    for (int row = 0; row <= globe->rows; row++)
        for (int column = 0; column < globe->columns; column++) {
            int32_t here = vertex_at(globe, row, column);
            mesh->vertices[here] = point_at(globe, row, column);
            if (row == globe->rows)
                continue;
            int32_t below = vertex_at(globe, row + 1, column);
            int32_t beside = vertex_at(globe, row + 1, column + 1);
            if (row < globe->rows - 1)
                add_triangle(mesh, globe, here, below, beside);
            if (row > 0)
                add_triangle(mesh, globe, here, beside, vertex_at(globe, row, column + 1));
        }
    mesh->vertex_count += 2 + (globe->rows - 1) * globe->columns;
}

static bool fill_mesh(HdMesh *mesh, int triangles) {
    int rows = 2;
    while (8 * rows * rows <= triangles)
        rows++;
    const int columns = 2 * rows;
    size_t vertices = 2 * (2 + (size_t)(rows - 1) * (size_t)columns);
    size_t most = 4 * (size_t)columns * (size_t)rows;
    mesh->vertices = malloc(vertices * sizeof *mesh->vertices);
    mesh->corners = malloc(most * sizeof *mesh->corners);
    mesh->material_of = malloc(most * sizeof *mesh->material_of);
    mesh->materials = calloc(2, sizeof *mesh->materials);
    if (mesh->vertices == NULL || mesh->corners == NULL || mesh->material_of == NULL ||
        mesh->materials == NULL)
        return false;
    Globe globe = {.rows = rows, .columns = columns, .radius = 1.0, .bump = 0.2};
    add_globe(mesh, &globe);
    globe = (Globe){.rows = rows,
                    .columns = columns,
                    .first_vertex = mesh->vertex_count,
                    .radius = shell_radius,
                    .inward = true};
    add_globe(mesh, &globe);
    mesh->material_count = 2;
    for (int i = 0; i < 2; i++) {
        HdMeshMaterial *material = &mesh->materials[i];
        *material = (HdMeshMaterial){.picture = -1, .passes_as = -1};
        material->material = (HdMaterial){.colour = hd_vec3(1.0, 1.0, 1.0),
                                          .mirror_tint = hd_vec3(1.0, 1.0, 1.0),
                                          .diffuse = 1.0,
                                          .shininess = 1,
                                          .index_of_refraction = 1.0};
    }
    mesh->materials[0].material.transmission = 1.0;
    mesh->materials[0].material.colour =
        hd_vec3(hd_object_filter[0], hd_object_filter[1], hd_object_filter[2]);
    return true;
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
                       .tangent_of_half_fov = 0.6};
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

void hd_object_free(HdObject *object) {
    free(object->normals);
    hd_frame_tables_free(&object->frame);
    hd_scene_tables_free(&object->tables);
    hd_scene_free(&object->scene);
}
