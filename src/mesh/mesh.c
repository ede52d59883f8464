/* SPDX-License-Identifier: MIT */
#include "mesh/mesh.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

bool hd_mesh_allocate(HdMesh *mesh, size_t vertices, size_t triangles) {
    mesh->vertices = calloc(vertices, sizeof *mesh->vertices);
    mesh->corners = calloc(triangles, sizeof *mesh->corners);
    mesh->material_of = calloc(triangles, sizeof *mesh->material_of);
    mesh->group_of = calloc(triangles, sizeof *mesh->group_of);
    return mesh->vertices != NULL && mesh->corners != NULL && mesh->material_of != NULL &&
           mesh->group_of != NULL;
}

/* Whether the height over the longest side is within what coordinates of this size are rounded by:
   rounding may then have made any area that there is. */
static bool has_no_area(HdVec3 a, HdVec3 b, HdVec3 c) {
    const HdVec3 ab = hd_sub(b, a), ac = hd_sub(c, a), bc = hd_sub(c, b);
    const double longest = sqrt(fmax(hd_dot(ab, ab), fmax(hd_dot(ac, ac), hd_dot(bc, bc))));
    const double size = fmax(hd_largest(a), fmax(hd_largest(b), hd_largest(c)));
    return hd_length(hd_cross(ab, ac)) <= 4.0 * DBL_EPSILON * size * longest;
}

static bool is_degenerate(const HdMesh *mesh, int triangle) {
    const int32_t *corners = mesh->corners[triangle];
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0])
        return true;
    return has_no_area(mesh->vertices[corners[0]], mesh->vertices[corners[1]],
                       mesh->vertices[corners[2]]);
}

static void move_triangle(HdMesh *mesh, int from, int to) {
    memcpy(mesh->corners[to], mesh->corners[from], sizeof *mesh->corners);
    if (mesh->corner_normals != NULL)
        memcpy(mesh->corner_normals[to], mesh->corner_normals[from], sizeof *mesh->corner_normals);
    if (mesh->corner_uvs != NULL)
        memcpy(mesh->corner_uvs[to], mesh->corner_uvs[from], sizeof *mesh->corner_uvs);
    if (mesh->material_of != NULL)
        mesh->material_of[to] = mesh->material_of[from];
    if (mesh->group_of != NULL)
        mesh->group_of[to] = mesh->group_of[from];
}

/* The array with `count` elements, at least one; the old one where it cannot be had smaller. */
static void *shrink(void *array, int count, size_t size) {
    if (array == NULL)
        return NULL;
    void *smaller = realloc(array, (size_t)(count > 0 ? count : 1) * size);
    return smaller != NULL ? smaller : array;
}

static void shrink_triangles(HdMesh *mesh) {
    const int count = mesh->triangle_count;
    mesh->corners = shrink(mesh->corners, count, sizeof *mesh->corners);
    mesh->corner_normals = shrink(mesh->corner_normals, count, sizeof *mesh->corner_normals);
    mesh->corner_uvs = shrink(mesh->corner_uvs, count, sizeof *mesh->corner_uvs);
    mesh->material_of = shrink(mesh->material_of, count, sizeof *mesh->material_of);
    mesh->group_of = shrink(mesh->group_of, count, sizeof *mesh->group_of);
}

void hd_mesh_drop_degenerate(HdMesh *mesh) {
    int kept = 0;
    for (int i = 0; i < mesh->triangle_count; i++) {
        if (is_degenerate(mesh, i))
            continue;
        if (kept != i)
            move_triangle(mesh, i, kept);
        kept++;
    }
    if (kept == mesh->triangle_count)
        return;
    mesh->degenerate_count += mesh->triangle_count - kept;
    mesh->triangle_count = kept;
    shrink_triangles(mesh);
}

void hd_mesh_box(const HdMesh *mesh, HdVec3 *lower, HdVec3 *upper) {
    *lower = *upper = hd_vec3(0.0, 0.0, 0.0);
    if (mesh->triangle_count > 0)
        *lower = *upper = mesh->vertices[mesh->corners[0][0]];
    for (int i = 0; i < mesh->triangle_count; i++)
        for (int k = 0; k < 3; k++) {
            const HdVec3 at = mesh->vertices[mesh->corners[i][k]];
            *lower = hd_vec3(fmin(lower->x, at.x), fmin(lower->y, at.y), fmin(lower->z, at.z));
            *upper = hd_vec3(fmax(upper->x, at.x), fmax(upper->y, at.y), fmax(upper->z, at.z));
        }
}

/* Relative costs of a node and a triangle, measured with bundles of 16 rays. */
static const HdHierarchyOptions tree_options = {.node_cost = 1.0f, .most_in_leaf = 8};

/* Bounds next to a number, never denormal, which many processors multiply a hundred times as
 * slowly. */
static float below(float number) {
    float next = nextafterf(number, -FLT_MAX);
    return fabsf(next) < FLT_MIN ? -FLT_MIN : next;
}

static float above(float number) {
    return -below(-number);
}

/* Kernels store a corner in float or in double: the box holds it either way. */
static void add_corner(HdBox *box, const double corner[3]) {
    for (int axis = 0; axis < 3; axis++) {
        float near = (float)corner[axis];
        box->lower[axis] = fminf(box->lower[axis], below(near));
        box->upper[axis] = fmaxf(box->upper[axis], above(near));
    }
}

static HdBox box_of(const HdMesh *mesh, int triangle, HdVec3 middle, double scale) {
    HdBox box = {{FLT_MAX, FLT_MAX, FLT_MAX}, {-FLT_MAX, -FLT_MAX, -FLT_MAX}};
    for (int k = 0; k < 3; k++) {
        HdVec3 at = mesh->vertices[mesh->corners[triangle][k]];
        at = hd_scale(hd_sub(at, middle), scale);
        add_corner(&box, (const double[3]){at.x, at.y, at.z});
    }
    return box;
}

HdStatus hd_mesh_build(HdMesh *mesh, HdThreadPool *pool, HdError *error) {
    HdBox *boxes = calloc((size_t)mesh->triangle_count, sizeof *boxes);
    if (boxes == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: a mesh has %d triangles",
                       mesh->triangle_count);
    hd_mesh_box(mesh, &mesh->lower, &mesh->upper);
    HdVec3 middle = hd_mesh_middle(mesh);
    double scale = 1.0 / hd_mesh_half_side(mesh);
    for (int i = 0; i < mesh->triangle_count; i++)
        boxes[i] = box_of(mesh, i, middle, scale);
    HdStatus status =
        hd_hierarchy_build(&mesh->tree, boxes, mesh->triangle_count, &tree_options, pool, error);
    free(boxes);
    return status;
}

void hd_mesh_free(HdMesh *mesh) {
    for (int i = 0; mesh->materials != NULL && i < mesh->material_count; i++) {
        free(mesh->materials[i].name);
        free(mesh->materials[i].texture);
    }
    free(mesh->materials);
    free(mesh->vertices);
    free(mesh->normals);
    free(mesh->uvs);
    free(mesh->corners);
    free(mesh->corner_normals);
    free(mesh->corner_uvs);
    free(mesh->material_of);
    free(mesh->group_of);
    hd_hierarchy_free(&mesh->tree);
    *mesh = (HdMesh){0};
}
