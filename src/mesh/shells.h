/* SPDX-License-Identifier: MIT */
/* The shells of a mesh: its triangles as far as corners at the same places join them. */
#ifndef HD_MESH_SHELLS_H
#define HD_MESH_SHELLS_H

#include "mesh/mesh.h"

typedef struct HdShell {
    int32_t first;       /* its first triangle */
    HdVec3 lower, upper; /* box, in the mesh's coordinates */
    bool is_closed;      /* one triangle runs along each edge, and one along it back */
    double volume;       /* of a closed shell, where half the longest side of the mesh's box is 1;
                            negative if outer sides face inwards */
} HdShell;

typedef struct HdShells {
    int count;
    HdShell *shells;           /* owned; in the order of their first triangles */
    int32_t *shell_of;         /* owned; shell of each triangle */
    int32_t (*shell_below)[2]; /* owned; for the children of each node of the mesh's tree the shell
                                  of all their triangles, -1: several */
    bool are_measured;         /* `is_closed` and `volume` are set */
} HdShells;

/* Finds the shells of a built mesh. HD_FAILED: out of memory; `shells` is then empty. */
HdStatus hd_shells_find(HdShells *shells, const HdMesh *mesh, HdError *error);

/* Measures the shells unless that is done. This takes longer than to find them. HD_FAILED: out of
   memory. */
HdStatus hd_shells_measure(HdShells *shells, const HdMesh *mesh, HdError *error);

void hd_shells_free(HdShells *shells);

/* Returns a corner of a built mesh relative to the centre of its box, in half the longest side. */
static inline HdVec3 hd_mesh_corner(const HdMesh *mesh, int32_t triangle, int corner) {
    const HdVec3 vertex = mesh->vertices[mesh->corners[triangle][corner]];
    return hd_scale(hd_sub(vertex, hd_mesh_centre(mesh)), 1.0 / hd_mesh_half_side(mesh));
}

#endif
