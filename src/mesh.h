/* SPDX-License-Identifier: MIT */
/* Triangles in a space of their own, as a file or a generator gives them. */
#ifndef HD_MESH_H
#define HD_MESH_H

#include <stdbool.h>
#include <stdint.h>

#include "error.h"
#include "scene_material.h"
#include "vec3.h"

enum {
    HD_MAX_MESH_TRIANGLES = 100 * 1000 * 1000,
    HD_MAX_MESH_MATERIALS = 65536,
    HD_MAX_MESH_GROUPS = 31
};

/* What the triangles of one material look like. `texture` is the path of a picture, owned; NULL:
   none. Its colour is multiplied by the texture's. `passes_as` is the number of the material in the
   same mesh by whose transmission and colour shadow rays are let through; -1: its own. */
typedef struct HdMeshMaterial {
    char *name; /* owned; for messages and to be replaced by name */
    HdMaterial material;
    HdVec3 emission; /* radiance of the surface's own */
    char *texture;
    int passes_as;
} HdMeshMaterial;

/* Corners run counterclockwise as seen from the outer side. All arrays are owned. */
typedef struct HdMesh {
    int vertex_count, normal_count, uv_count, triangle_count, material_count;
    HdVec3 *vertices;
    HdVec3 *normals;       /* need not be unit; NULL: there are none */
    double (*uvs)[2];      /* (0, 0) is the texture's lower left corner; NULL: there are none */
    int32_t (*corners)[3]; /* of each triangle, into vertices */
    int32_t (*corner_normals)[3]; /* into normals, -1: flat; NULL with `normals` */
    int32_t (*corner_uvs)[3];     /* into uvs, -1: none; NULL with `uvs` */
    int32_t *material_of;         /* of each triangle, into materials; NULL: all have number 0 */
    uint8_t *group_of; /* triangles of a group but 0 lie in one plane, and no ray that leaves one of
                          them meets another; NULL: all have group 0 */
    HdMeshMaterial *materials; /* at least one */
    int degenerate_count;      /* triangles without an area that were left out */
} HdMesh;

/* Leaves out triangles that have no area: two corners at one place, or all three on a line up to
   rounding, and counts them. */
void hd_mesh_drop_degenerate(HdMesh *mesh);

/* The average of the normals of the triangles about each vertex, weighted by their angle there
   (Thuermer and Wuethrich 1998), as the mesh's normals. Vertices at one place count as one. Where
   the triangles meet at more than `crease_degrees` the surface keeps its edge. */
HdStatus hd_mesh_smooth(HdMesh *mesh, double crease_degrees, HdError *error);

/* Corners of the box about all vertices; of a mesh without any, both are 0. */
void hd_mesh_box(const HdMesh *mesh, HdVec3 *lower, HdVec3 *upper);

/* Frees what the mesh owns and clears it. */
void hd_mesh_free(HdMesh *mesh);

#endif
