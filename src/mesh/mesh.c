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

/* Returns whether two corners coincide, or the height over the longest side is within the rounding
   of such coordinates. Rounding may then have made any area. */
static bool is_degenerate(const HdMesh *mesh, int triangle) {
    const int32_t *corners = mesh->corners[triangle];
    const HdVec3 a = mesh->vertices[corners[0]], b = mesh->vertices[corners[1]],
                 c = mesh->vertices[corners[2]];
    const HdVec3 ab = hd_sub(b, a), ac = hd_sub(c, a), bc = hd_sub(c, b);
    const double longest = sqrt(fmax(hd_dot(ab, ab), fmax(hd_dot(ac, ac), hd_dot(bc, bc))));
    const double size = fmax(hd_largest(a), fmax(hd_largest(b), hd_largest(c)));
    return hd_length(hd_cross(ab, ac)) <= 4.0 * DBL_EPSILON * size * longest;
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

void hd_mesh_drop_degenerate(HdMesh *mesh) {
    int kept = 0;
    for (int i = 0; i < mesh->triangle_count; i++) {
        if (is_degenerate(mesh, i))
            continue;
        if (kept != i)
            move_triangle(mesh, i, kept);
        kept++;
    }
    mesh->degenerate_count += mesh->triangle_count - kept;
    mesh->triangle_count = kept;
}

static void find_box(const HdMesh *mesh, HdVec3 *lower, HdVec3 *upper) {
    *lower = *upper = mesh->vertices[mesh->corners[0][0]];
    for (int i = 0; i < mesh->triangle_count; i++)
        for (int k = 0; k < 3; k++) {
            const HdVec3 at = mesh->vertices[mesh->corners[i][k]];
            *lower = hd_vec3(fmin(lower->x, at.x), fmin(lower->y, at.y), fmin(lower->z, at.z));
            *upper = hd_vec3(fmax(upper->x, at.x), fmax(upper->y, at.y), fmax(upper->z, at.z));
        }
}

/* Costs of a node relative to a triangle, measured with packets of 16 rays. */
static const HdHierarchyOptions tree_options = {.node_cost = 1.0f, .max_in_leaf = 8};

/* Returns the float below a number, never denormal: many processors multiply those a hundred times
   as slowly. */
static float below(float number) {
    float next = nextafterf(number, -FLT_MAX);
    return fabsf(next) < FLT_MIN ? -FLT_MIN : next;
}

/* Kernels store corners in float or double; the box contains either. */
static HdBox box_of(const HdMesh *mesh, int triangle, HdVec3 middle, double scale) {
    HdBox box = {{FLT_MAX, FLT_MAX, FLT_MAX}, {-FLT_MAX, -FLT_MAX, -FLT_MAX}};
    for (int k = 0; k < 3; k++) {
        const HdVec3 corner = mesh->vertices[mesh->corners[triangle][k]];
        const HdVec3 at = hd_scale(hd_sub(corner, middle), scale);
        const float near[3] = {(float)at.x, (float)at.y, (float)at.z};
        for (int axis = 0; axis < 3; axis++) {
            box.lower[axis] = fminf(box.lower[axis], below(near[axis]));
            box.upper[axis] = fmaxf(box.upper[axis], -below(-near[axis]));
        }
    }
    return box;
}

HdStatus hd_mesh_build(HdMesh *mesh, HdThreadPool *pool, HdError *error) {
    HdBox *boxes = calloc((size_t)mesh->triangle_count, sizeof *boxes);
    if (boxes == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: a mesh has %d triangles",
                       mesh->triangle_count);
    find_box(mesh, &mesh->lower, &mesh->upper);
    HdVec3 middle = hd_mesh_centre(mesh);
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
        free(mesh->materials[i].mask);
    }
    free(mesh->materials);
    free(mesh->vertices);
    free(mesh->colours);
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
