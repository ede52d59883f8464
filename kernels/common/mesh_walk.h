/* SPDX-License-Identifier: MIT */
/* What all walks through hierarchies share: which way rays run, leaves, and nodes of two children.
 */
#ifndef HD_MESH_WALK_H
#define HD_MESH_WALK_H

#include "mesh_hits.h"

/* Which way rays run: what bundles have in common that share a walk. */
typedef struct {
    int axis[3];           /* of the mesh, the one nearest to the rays last */
    int entry[3], exit[3]; /* of a box they enter by the lower (0) or the upper bound of each */
    int backward;          /* a bit for each axis of the mesh: they run against it */
} Way;

/* The lanes of `m` whose rays run the same way as the first one's. */
FN vmask same_way(const Slabs *slabs, LastAxis last, vmask m, Way *way) {
    int lane = first_lane(m);
    int x = (int)(lane_bits(last.x) >> lane & 1), y = (int)(lane_bits(last.y) >> lane & 1);
    m = m & (x ? last.x : ~last.x) & (y ? last.y : ~last.y);
    way->backward = 0;
    for (int i = 0; i < 3; i++) {
        vmask against = slabs->negative[i];
        int negative = (int)(lane_bits(against) >> lane & 1);
        m = m & (negative ? against : ~against);
        way->axis[i] = (i + (x ? 1 : y ? 2 : 0)) % 3;
        way->entry[i] = negative;
        way->exit[i] = !negative;
        way->backward |= negative << way->axis[i];
    }
    return m;
}

/* Tries `count` triangles, one at least, with rays that run one way. */
FN void try_triangles(SCENE_PARAMETERS Findings *found, const MeshRays *rays, vmask m,
                      const Way *way, int first, int count) {
    int i = first;
    do {
        TriangleLanes triangle =
            same_triangle(triangles, i, way->axis, rays->first_face, rays->first_skin);
        keep_crossing(SCENE_ARGUMENTS found, rays, &triangle, m);
        i++;
    } while (i < first + count);
}

/* ---- nodes of two children ---- */

FN vreal entry_of_child(GLOBAL const MeshNode *node, const Slabs *slabs, const Way *way,
                        int child) {
    real x = node->bounds[way->axis[0]][way->entry[0]][child];
    real y = node->bounds[way->axis[1]][way->entry[1]][child];
    real z = node->bounds[way->axis[2]][way->entry[2]][child];
    vreal near = multiply_add(splat(x), slabs->inverse.x, slabs->near.x);
    near = greater(near, multiply_add(splat(y), slabs->inverse.y, slabs->near.y));
    near = greater(near, multiply_add(splat(z), slabs->inverse.z, slabs->near.z));
    return greater(near, splat(R(0.0)));
}

FN vreal exit_of_child(GLOBAL const MeshNode *node, const Slabs *slabs, const Way *way, int child) {
    real x = node->bounds[way->axis[0]][way->exit[0]][child];
    real y = node->bounds[way->axis[1]][way->exit[1]][child];
    real z = node->bounds[way->axis[2]][way->exit[2]][child];
    vreal far = multiply_add(splat(x), slabs->inverse.x, slabs->far.x);
    far = lesser(far, multiply_add(splat(y), slabs->inverse.y, slabs->far.y));
    return lesser(far, multiply_add(splat(z), slabs->inverse.z, slabs->far.z));
}

#endif
