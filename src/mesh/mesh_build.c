/* SPDX-License-Identifier: MIT */
#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "mesh/mesh.h"

/* Relative costs of a node and a triangle, measured with bundles of 16 rays. */
static const HdHierarchyOptions options = {.node_cost = 1.0f, .most_in_leaf = 8};

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
        hd_hierarchy_build(&mesh->tree, boxes, mesh->triangle_count, &options, pool, error);
    free(boxes);
    return status;
}
