/* SPDX-License-Identifier: MIT */
/* Triangles in a space of their own, as a file or a generator gives them. */
#ifndef HD_MESH_MESH_H
#define HD_MESH_MESH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/error.h"
#include "base/vector.h"
#include "mesh/hierarchy.h"
#include "mesh/material.h"

enum {
    HD_MAX_MESH_TRIANGLES = 100 * 1000 * 1000,
    HD_MAX_MESH_MATERIALS = 65536,
    HD_MAX_MESH_GROUPS = 31
};

/* What the triangles of one material look like. `texture` is the path of a picture, owned; NULL:
   none. Its colour is multiplied by the texture's. `passes_as` is the number of the material in the
   same mesh by whose transmission and colour shadow rays are let through; -1: its own. What is
   opaque to shadows lets none through, whatever its material lets pass to the eye. */
typedef struct HdMeshMaterial {
    char *name; /* owned; for messages and to be replaced by name */
    HdMaterial material;
    HdVec3 emission; /* radiance of the surface's own */
    char *texture;
    int picture; /* number among the pictures of the scene; -1: none */
    int passes_as;
    bool is_opaque_to_shadows;
} HdMeshMaterial;

/* Corners run counterclockwise as seen from the outer side. All arrays are owned. */
typedef struct HdMesh {
    int vertex_count, normal_count, uv_count, triangle_count, material_count;
    HdVec3 *vertices;
    HdVec3 *normals;       /* need not be unit, but those of corners are not 0; NULL: none */
    double (*uvs)[2];      /* (0, 0) is the texture's lower left corner; NULL: there are none */
    int32_t (*corners)[3]; /* of each triangle, into vertices */
    int32_t (*corner_normals)[3]; /* into normals, -1: flat; NULL with `normals` */
    int32_t (*corner_uvs)[3];     /* into uvs, -1: none; NULL with `uvs` */
    int32_t *material_of;         /* of each triangle, into materials; NULL: all have number 0 */
    uint8_t *group_of; /* triangles of a group but 0 lie in one plane, and no ray that leaves one of
                          them meets another; NULL: all have group 0 */
    HdMeshMaterial *materials; /* at least one */
    int degenerate_count;      /* triangles without an area that were left out */
    HdVec3 lower, upper;       /* the box about all triangles; set by hd_mesh_build */
    HdHierarchy tree;          /* over the triangles; without nodes until hd_mesh_build */
} HdMesh;

/* Makes `vertices`, `corners`, `material_of` and `group_of` with room for so many, and zeros, in a
   mesh that has none of them. False: out of memory; hd_mesh_free frees what was made. */
bool hd_mesh_allocate(HdMesh *mesh, size_t vertices, size_t triangles);

/* Leaves out triangles that have no area: two corners at one place, or all three on a line up to
   the rounding of their coordinates, and counts them. Vertices that no triangle names stay. */
void hd_mesh_drop_degenerate(HdMesh *mesh);

/* The average of the normals of the triangles about each vertex, weighted by their angle there
   (Thuermer and Wuethrich 1998), as the mesh's normals in place of those that it had. Vertices at
   one place count as one. Where two triangles with a common edge meet at more than `crease_degrees`
   (0..180) the surface keeps that edge; triangles that share a place alone do not count for each
   other. Triangles without an area stay flat. The bytes depend on the mesh alone. HD_FAILED where
   there is too little memory; the mesh is then as it was. */
HdStatus hd_mesh_smooth(HdMesh *mesh, double crease_degrees, HdError *error);

/* Corners of the box about all triangles; of a mesh without any, both are 0. */
void hd_mesh_box(const HdMesh *mesh, HdVec3 *lower, HdVec3 *upper);

/* Finds the box and builds the hierarchy over the triangles of a finished mesh, which has at least
   one. */
HdStatus hd_mesh_build(HdMesh *mesh, HdThreadPool *pool, HdError *error);

/* Of a built mesh's box: its middle, and half its longest side. */
static inline HdVec3 hd_mesh_middle(const HdMesh *mesh) {
    return hd_scale(hd_add(mesh->lower, mesh->upper), 0.5);
}
static inline double hd_mesh_half_side(const HdMesh *mesh) {
    HdVec3 sides = hd_sub(mesh->upper, mesh->lower);
    return 0.5 * fmax(sides.x, fmax(sides.y, sides.z));
}

/* Frees what the mesh owns and clears it. */
void hd_mesh_free(HdMesh *mesh);

#endif
