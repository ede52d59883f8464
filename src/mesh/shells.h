/* SPDX-License-Identifier: MIT */
/* The shells of a mesh: its triangles as far as corners at the same places join them. */
#ifndef HD_MESH_SHELLS_H
#define HD_MESH_SHELLS_H

#include "mesh/mesh.h"

typedef struct HdShell {
    int32_t first, count; /* part of HdShells.triangles */
    HdVec3 lower, upper;  /* box, in the mesh's coordinates */
    bool is_closed;       /* one triangle runs along each edge, and one along it back */
    double volume;        /* of a closed shell, where half the longest side of the mesh's box is 1;
                             negative if outer sides face inwards */
    HdHierarchy tree;     /* over its triangles; without nodes until hd_shell_build */
} HdShell;

typedef struct HdShells {
    int count;
    HdShell *shells;    /* owned; in the order of their first triangles */
    int32_t *shell_of;  /* owned; shell of each triangle */
    int32_t *triangles; /* owned; those of each shell, in ascending order */
    bool are_measured;  /* `is_closed` and `volume` are set */
} HdShells;

/* Finds the shells of a built mesh. HD_FAILED: out of memory; `shells` is then empty. */
HdStatus hd_shells_find(HdShells *shells, const HdMesh *mesh, HdError *error);

/* Measures the shells unless that is done. This takes longer than to find them. HD_FAILED: out of
   memory. */
HdStatus hd_shells_measure(HdShells *shells, const HdMesh *mesh, HdError *error);

/* Builds the tree of a shell unless that is done. Errors as of hd_hierarchy_build. */
HdStatus hd_shell_build(HdShells *shells, const HdMesh *mesh, int shell, HdThreadPool *pool,
                        HdError *error);

/* Returns the tree of a shell on which that was called. */
static inline const HdHierarchy *hd_shell_tree(const HdShells *shells, const HdMesh *mesh,
                                               int shell) {
    return shells->count == 1 ? &mesh->tree : &shells->shells[shell].tree;
}

void hd_shells_free(HdShells *shells);

/* Returns a corner of a built mesh relative to the centre of its box, in half the longest side. */
static inline HdVec3 hd_mesh_corner(const HdMesh *mesh, int32_t triangle, int corner) {
    const HdVec3 vertex = mesh->vertices[mesh->corners[triangle][corner]];
    return hd_scale(hd_sub(vertex, hd_mesh_centre(mesh)), 1.0 / hd_mesh_half_side(mesh));
}

#endif
