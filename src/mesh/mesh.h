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

/* What a surface does to light: Phong's terms and the two rays that go on. On each side reflection
 * + transmission <= 1. */
typedef struct HdMaterial {
    HdVec3 colour;      /* 0..1; tints diffuse light and what passes through */
    HdVec3 mirror_tint; /* 0..1; tints the mirror image */
    double ambient;
    double diffuse;
    double specular;
    int shininess; /* exponent, 1..HD_MAX_SHININESS */
    double reflection;
    double transmission;
    double inner_reflection; /* of rays that meet the face from inside the solid; */
    double inner_transmission;
    bool has_inner_side;        /* without it both sides reflect and transmit alike */
    double index_of_refraction; /* inside the solid, 1 outside; 1: rays go straight on */
    bool lit_from_behind; /* lights behind the face shine through: diffuse * transmission of them */
} HdMaterial;

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

/* Divides each triangle of a mesh without normals and texture coordinates into `divisions` x
   `divisions` equal ones, which keep its material and group. Triangles that share an edge share the
   new vertices on it. HD_BAD_INPUT: there would be more than HD_MAX_MESH_TRIANGLES; then, and when
   there is no memory, the mesh stays as it is. */
HdStatus hd_divide_triangles(HdMesh *mesh, int divisions, HdError *error);

/* Checks `divisions`, and that `triangle_count` triangles so divided are no more than
   HD_MAX_MESH_TRIANGLES. */
HdStatus hd_check_divisions(int64_t triangle_count, int divisions, HdError *error);

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

/* Concave polygons take time with the square of their corners. */
enum { HD_MAX_CONCAVE_CORNERS = 1024 };

/* Cuts a polygon of `count` corners, at least 3, into `count` - 2 triangles of the same sense: a
   fan of the first corner where that covers it, else ears in the plane of the axes that it faces
   most. What crosses itself is cut into as many triangles, somehow. `triangles` get numbers of
   corners. False: the polygon is no fan and has more than HD_MAX_CONCAVE_CORNERS. */
bool hd_polygon_cut(const HdVec3 *corners, int count, int32_t (*triangles)[3]);

/* ---- Wavefront OBJ ---- */

/* The most bytes of a line, continued ones together; comments may be longer. */
enum { HD_OBJ_MAX_LINE = 65000 };

/* Reads the file at `path`, with the MTL files it names, which lie beside it or below. Polygons
   become triangles. Materials become ours by the table in docs/reference/files.md: Kd colour (and
   what passes), Ks specular, Ns shininess, Ka ambient, Ke emission, d or Tf transmission, Ni index
   of refraction, illum 3 to 9 mirrors with the share Ks; map_Kd texture, whose path begins with the
   folder of `path`, or with "./"; nobody has looked whether it is there. Materials without
   triangles may be among them. What is not used is told in `notes`, in sentences that begin with a
   path: a library that is missing, wrong lines of libraries, maps of other kinds, values that had
   to be made legal. Triangles without an area are dropped and counted.

   A file that cannot be read, is no OBJ, has no faces or none with an area, names vertices that it
   does not have, has numbers that are not finite or beyond HD_MAX_NUMBER, or would take more than
   `max_bytes` of memory while it is read, the mesh included, is an error (HD_BAD_INPUT) that names
   the file and, where there is one, the line. HD_FAILED: the system has too little memory. After an
   error the mesh is empty. */
HdStatus hd_mesh_read_obj(HdMesh *mesh, const char *path, size_t max_bytes, HdProblems *notes,
                          HdError *error);

#endif
