/* SPDX-License-Identifier: MIT */
#include "verify/mesh_builder.h"

#include <stdlib.h>
#include <string.h>

#include "base/trigonometry.h"

static void *allocate(size_t count, size_t size) {
    void *memory = calloc(count > 0 ? count : 1, size);
    if (memory == NULL)
        abort();
    return memory;
}

void build_meshes(HdScene *scene, int meshes, int instances, int pictures) {
    scene->mesh_count = meshes;
    scene->meshes = allocate((size_t)meshes, sizeof *scene->meshes);
    scene->instance_count = instances;
    scene->instances = allocate((size_t)instances, sizeof *scene->instances);
    scene->picture_count = pictures;
    scene->pictures = allocate((size_t)pictures, sizeof *scene->pictures);
}

static void set_material(HdMesh *mesh, int index, const HdMaterial *material) {
    mesh->materials[index] =
        (HdMeshMaterial){.material = *material, .picture = -1, .passes_as = -1};
}

/* A grid of (rows + 1) x (columns + 1) points whose first and last column, and whose first and last
   row, are one each; only its texture coordinates keep them apart. */
typedef struct Globe {
    int rows, columns;
} Globe;

static int32_t vertex_at(const Globe *globe, int row, int column) {
    if (row == 0)
        return 0;
    if (row == globe->rows)
        return 1;
    return 2 + (row - 1) * globe->columns + column % globe->columns;
}

static HdVec3 point_at(const Globe *globe, int row, int column, double bump) {
    double polar_sine, polar_cosine, sine, cosine, wave, other_wave, unused;
    hd_sine_cosine(HD_PI * row / globe->rows, &polar_sine, &polar_cosine);
    hd_sine_cosine(2.0 * HD_PI * column / globe->columns, &sine, &cosine);
    hd_sine_cosine(10.0 * HD_PI * column / globe->columns, &wave, &unused);
    hd_sine_cosine(4.0 * HD_PI * row / globe->rows, &other_wave, &unused);
    double radius = 1.0 + bump * wave * other_wave * polar_sine * polar_sine;
    return hd_scale(hd_vec3(polar_sine * cosine, polar_sine * sine, polar_cosine), radius);
}

static void add_globe_triangle(HdMesh *mesh, const Globe *globe, const int row[3],
                               const int column[3]) {
    int number = mesh->triangle_count++;
    for (int i = 0; i < 3; i++) {
        int32_t vertex = vertex_at(globe, row[i], column[i]);
        mesh->corners[number][i] = vertex;
        if (mesh->corner_normals != NULL)
            mesh->corner_normals[number][i] = vertex;
        if (mesh->corner_uvs != NULL)
            mesh->corner_uvs[number][i] = row[i] * (globe->columns + 1) + column[i];
    }
}

static void fill_globe_uvs(HdMesh *mesh, const Globe *globe) {
    mesh->uv_count = (globe->rows + 1) * (globe->columns + 1);
    mesh->uvs = allocate((size_t)mesh->uv_count, sizeof *mesh->uvs);
    for (int i = 0; i < mesh->uv_count; i++) {
        int row = i / (globe->columns + 1);
        mesh->uvs[i][0] = 3.0 * (i % (globe->columns + 1)) / globe->columns - 1.0;
        mesh->uvs[i][1] = 1.5 * row / globe->rows;
    }
}

void build_sphere_mesh(HdMesh *mesh, int rows, double bump, bool smooth, bool mapped,
                       const HdMaterial *material) {
    const Globe globe = {rows, 2 * rows};
    size_t triangles = 2 * (size_t)globe.columns * (size_t)(rows - 1);
    mesh->vertex_count = 2 + (rows - 1) * globe.columns;
    mesh->vertices = allocate((size_t)mesh->vertex_count, sizeof *mesh->vertices);
    mesh->corners = allocate(triangles, sizeof *mesh->corners);
    for (int row = 0; row <= rows; row++)
        for (int column = 0; column < globe.columns; column++)
            mesh->vertices[vertex_at(&globe, row, column)] = point_at(&globe, row, column, bump);
    if (smooth) {
        mesh->normal_count = mesh->vertex_count;
        mesh->normals = allocate((size_t)mesh->normal_count, sizeof *mesh->normals);
        memcpy(mesh->normals, mesh->vertices, (size_t)mesh->normal_count * sizeof *mesh->normals);
        mesh->corner_normals = allocate(triangles, sizeof *mesh->corner_normals);
    }
    if (mapped) {
        fill_globe_uvs(mesh, &globe);
        mesh->corner_uvs = allocate(triangles, sizeof *mesh->corner_uvs);
    }
    for (int row = 0; row < rows; row++)
        for (int column = 0; column < globe.columns; column++) {
            int down[3] = {row, row + 1, row + 1}, right[3] = {column, column, column + 1};
            int back[3] = {row, row + 1, row}, left[3] = {column, column + 1, column + 1};
            if (row < rows - 1)
                add_globe_triangle(mesh, &globe, down, right);
            if (row > 0)
                add_globe_triangle(mesh, &globe, back, left);
        }
    mesh->material_count = 1;
    mesh->materials = allocate(1, sizeof *mesh->materials);
    set_material(mesh, 0, material);
}

void build_cube_mesh(HdMesh *mesh, const HdMaterial *first, const HdMaterial *second) {
    static const int32_t faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                        {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    mesh->vertex_count = 8;
    mesh->vertices = allocate(8, sizeof *mesh->vertices);
    for (int i = 0; i < 8; i++)
        mesh->vertices[i] = hd_vec3(i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0);
    mesh->triangle_count = 12;
    mesh->corners = allocate(12, sizeof *mesh->corners);
    mesh->material_of = allocate(12, sizeof *mesh->material_of);
    for (int i = 0; i < 12; i++) {
        const int32_t *face = faces[i / 2];
        mesh->corners[i][0] = face[0];
        mesh->corners[i][1] = face[1 + i % 2];
        mesh->corners[i][2] = face[2 + i % 2];
        mesh->material_of[i] = i < 4;
    }
    mesh->material_count = 2;
    mesh->materials = allocate(2, sizeof *mesh->materials);
    set_material(mesh, 0, first);
    set_material(mesh, 1, second);
}

void build_instance(HdScene *scene, int index, int mesh, HdVec3 position, HdVec3 rotation,
                    double scale) {
    scene->instances[index] = (HdInstance){.mesh = mesh,
                                           .position = position,
                                           .rotation_degrees = rotation,
                                           .scale = hd_vec3(scale, scale, scale)};
}

void finish_meshes(HdScene *scene) {
    HdError error;
    HdThreadPool *pool;
    if (hd_thread_pool_create(&pool, 1, &error) != HD_OK)
        abort();
    for (int i = 0; i < scene->mesh_count; i++)
        if (hd_mesh_build(&scene->meshes[i], pool, &error) != HD_OK)
            abort();
    hd_thread_pool_destroy(pool);
}
