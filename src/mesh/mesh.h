/* SPDX-License-Identifier: MIT */
/* Triangles in local coordinates, from a file or a generator. */
#ifndef HD_MESH_MESH_H
#define HD_MESH_MESH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/error.h"
#include "base/vector.h"
#include "mesh/hierarchy.h"

/* Surface parameters: Phong's terms, mirrored and transmitted rays. On each side reflection +
   transmission <= 1. */
typedef struct HdMaterial {
    HdVec3 colour;      /* 0..1; tints diffuse and transmitted light */
    HdVec3 mirror_tint; /* 0..1; tints the mirror image */
    double ambient;
    double diffuse;
    double specular;
    int shininess; /* exponent, 1..HD_MAX_SHININESS */
    double reflection;
    double transmission;
    double inner_reflection; /* for rays that meet the face from inside; */
    double inner_transmission;
    bool has_inner_side;        /* otherwise both sides are alike */
    double index_of_refraction; /* inside the solid, 1 outside; 1: no refraction */
    bool lit_from_behind; /* lights behind the face shine through: diffuse * transmission of them */
} HdMaterial;

enum {
    HD_MAX_MESH_TRIANGLES = 100 * 1000 * 1000,
    HD_MAX_MESH_MATERIALS = 65536,
    HD_MAX_MESH_GROUPS = 31
};

/* Material of a mesh. `texture` is the owned path of a picture, which multiplies its colour; NULL:
   none. `passes_as` is the number of the material in the same mesh whose transmission and colour
   filter shadow rays; -1: its own. A material opaque to shadows blocks shadow rays, whatever it
   transmits to the eye. */
typedef struct HdMeshMaterial {
    char *name; /* owned; for messages and replacement by name */
    HdMaterial material;
    HdVec3 emission; /* emitted radiance */
    char *texture;
    char *mask;       /* likewise, of the picture that cuts holes where it is below a half */
    int picture;      /* number among the pictures of the scene; -1: none */
    int mask_picture; /* likewise */
    bool is_clamped;  /* the pictures continue their borders' texels instead of repeating */
    int passes_as;
    bool is_opaque_to_shadows;
} HdMeshMaterial;

/* Corners run counterclockwise as seen from the outer side. All arrays are owned. */
typedef struct HdMesh {
    int vertex_count, normal_count, uv_count, triangle_count, material_count;
    HdVec3 *vertices;
    HdVec3 *colours;              /* of vertices, 0..1, tint the materials'; NULL: none */
    HdVec3 *normals;              /* need not be unit, but those of corners are not 0; NULL: none */
    double (*uvs)[2];             /* (0, 0) is the texture's lower left corner; NULL: none */
    int32_t (*corners)[3];        /* vertices of each triangle */
    int32_t (*corner_normals)[3]; /* into normals, -1: flat; NULL with `normals` */
    int32_t (*corner_uvs)[3];     /* into uvs, -1: none; NULL with `uvs` */
    int32_t *material_of;         /* material of each triangle; NULL: all have number 0 */
    uint8_t *group_of; /* triangles of a group but 0 lie in one plane, and no ray that leaves one of
                          them meets another; NULL: all have group 0 */
    HdMeshMaterial *materials; /* at least one */
    int degenerate_count;      /* omitted triangles without an area */
    HdVec3 lower, upper;       /* bounding box of all triangles; set by hd_mesh_build */
    HdHierarchy tree;          /* over the triangles; without nodes until hd_mesh_build */
} HdMesh;

/* Allocates zeroed `vertices`, `corners`, `material_of` and `group_of` in a mesh without them.
   Returns false if out of memory; hd_mesh_free frees the rest. */
bool hd_mesh_allocate(HdMesh *mesh, size_t vertices, size_t triangles);

/* Appends a copy of the material. Returns false if out of memory, with nothing changed. */
bool hd_mesh_copy_material(HdMesh *mesh, int material);

/* Removes and counts triangles without an area: two equal corners, or all three on a line up to the
   rounding of their coordinates. Unused vertices stay. */
void hd_mesh_drop_degenerate(HdMesh *mesh);

/* Replaces the normals by unit averages of the triangles around each vertex, weighted by their
   angle there (Thuermer and Wuethrich 1998). Vertices with equal coordinates count as one. Two
   triangles are averaged at a vertex if they share an edge there and their normals differ by at
   most `crease_degrees` (0 to 180), or if a chain of such pairs around the vertex connects them.
   Triangles without an area, and corners whose average is 0, stay flat (-1). Among more than 16
   triangles at one edge not all pairs are compared. The same arguments give the same bits.
   HD_FAILED: out of memory; the mesh is then unchanged. */
HdStatus hd_mesh_smooth(HdMesh *mesh, double crease_degrees, HdError *error);

/* Divides each triangle of a mesh without normals and texture coordinates into `divisions` x
   `divisions` equal ones, which keep its material and group. Triangles that share an edge share its
   new vertices. HD_BAD_INPUT as hd_check_divisions; HD_FAILED: out of memory. On errors the mesh is
   unchanged. */
HdStatus hd_divide_triangles(HdMesh *mesh, int divisions, HdError *error);

/* Fails with HD_BAD_INPUT if `divisions` is less than 1, or `triangle_count` * `divisions` *
   `divisions` exceeds HD_MAX_MESH_TRIANGLES. */
HdStatus hd_check_divisions(int64_t triangle_count, int divisions, HdError *error);

/* Computes the box and builds the hierarchy of a finished mesh with at least one triangle. */
HdStatus hd_mesh_build(HdMesh *mesh, HdThreadPool *pool, HdError *error);

/* Builds a hierarchy over some triangles of a mesh with a box, in the coordinates of its own;
   `order` gets their numbers in the mesh. NULL: its first `count` triangles. */
HdStatus hd_mesh_build_tree(HdHierarchy *tree, const HdMesh *mesh, const int32_t *triangles,
                            int count, HdThreadPool *pool, HdError *error);

/* Returns the centre of the box of a built mesh, in local coordinates. */
static inline HdVec3 hd_mesh_centre(const HdMesh *mesh) {
    return hd_scale(hd_add(mesh->lower, mesh->upper), 0.5);
}

/* Returns half the longest side of that box. */
static inline double hd_mesh_half_side(const HdMesh *mesh) {
    HdVec3 sides = hd_sub(mesh->upper, mesh->lower);
    return 0.5 * fmax(sides.x, fmax(sides.y, sides.z));
}

/* Returns the largest product of `direction` with a corner of a built mesh, relative to the centre
   of its box and in units of half its longest side. */
double hd_mesh_reach(const HdMesh *mesh, HdVec3 direction);

/* Frees what the mesh owns and clears it. */
void hd_mesh_free(HdMesh *mesh);

/* Cutting concave polygons takes time quadratic in their corners. */
enum { HD_MAX_CONCAVE_CORNERS = 1024 };

/* Cuts a polygon of `count` corners, at least 3, into `count` - 2 triangles of the same
   orientation. Uses a fan from the first corner if it covers the polygon, else ear clipping in the
   axis plane that it faces most. A self-intersecting polygon gives as many triangles, unspecified.
   `triangles` receives corner numbers. Returns false if it is no fan and has more than
   HD_MAX_CONCAVE_CORNERS. */
bool hd_polygon_cut(const HdVec3 *corners, int count, int32_t (*triangles)[3]);

/* ---- Wavefront OBJ ---- */

/* Most bytes of a line with its continuations; comments may be longer. */
enum { HD_OBJ_MAX_LINE = 65000 };

/* Reads the file at `path` and the MTL files that it names, in the same folder or below. Cuts
   polygons into triangles. Rounds vertices to float, except those of a mesh that lies farther from
   the origin than twice its longest side. Converts materials by the table in
   docs/reference/files.md. `texture` begins with the folder of `path` or with "./"; it names a file
   unless none is found. Materials without triangles may remain. Drops and counts triangles without
   an area.

   Passes over what is wrong where the meaning of the rest is clear: `faults` gets a sentence for
   each kind, with the path and the first line. `notes` gets others, which begin with a path: unused
   statements, and materials that hide their mesh. Both may be one list.

   HD_BAD_INPUT, with the file and, if known, the line: it cannot be read, is no OBJ, or has no
   faces or none with an area. Also if a face names missing vertices, or one whose numbers are not
   finite or beyond HD_MAX_NUMBER. Also if reading takes more than `max_bytes` of memory, mesh
   included. HD_FAILED: the system is out of memory. After an error the mesh is empty. */
HdStatus hd_mesh_read_obj(HdMesh *mesh, const char *path, size_t max_bytes, HdProblems *faults,
                          HdProblems *notes, HdError *error);

#endif
