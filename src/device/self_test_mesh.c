/* SPDX-License-Identifier: MIT */
#include "device/self_test_mesh.h"

#include <stdlib.h>

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

static HdStatus allocate(HdMesh *mesh, bool is_ball, HdError *error) {
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

HdStatus hd_self_test_mesh(HdMesh *mesh, bool is_ball, HdError *error) {
    HdThreadPool *pool = NULL;
    *mesh = (HdMesh){0};
    HdStatus status = allocate(mesh, is_ball, error);
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
