/* SPDX-License-Identifier: MIT */
/* The walk of a single lane through a mesh, whose nodes have two children. */
#ifndef HD_MESH_WALK_ONE_H
#define HD_MESH_WALK_ONE_H

#include "mesh_walk.h"

/* In place of nodes and leaves, of which none that holds anything has these numbers: nothing, and
   all triangles of a mesh without a hierarchy. */
enum { NO_NODE = -1, WHOLE_MESH = -2147483647 };

/* The ray of `m`. Down to a leaf, then its triangles: so threads of a warp do the same at a time
   (Aila and Laine 2009). */
FN void search_mesh(SCENE_PARAMETERS Findings *found, const MeshRays *rays, vmask m,
                    GLOBAL const Instance *instance) {
    int stack[NODE_STACK(header)];
    vreal stack_near[NODE_STACK(header)];
    int waiting = 0, current = instance->root >= 0 ? instance->root : WHOLE_MESH;
    Way way;
    m = same_way(&rays->slabs, rays->last, m, &way);
    do {
        do {
            if (current == NO_NODE) {
                waiting--;
                current =
                    any_lane(le(stack_near[waiting], found->limit)) ? stack[waiting] : NO_NODE;
            }
            if (current >= 0) {
                GLOBAL const MeshNode *node = mesh_nodes + current;
                vreal near0 = entry_of_child(node, &rays->slabs, &way, 0);
                vreal near1 = entry_of_child(node, &rays->slabs, &way, 1);
                vreal far0 = lesser(exit_of_child(node, &rays->slabs, &way, 0), found->limit);
                vreal far1 = lesser(exit_of_child(node, &rays->slabs, &way, 1), found->limit);
                vmask alive = m & found->alive;
                int meets0 = any_lane(alive & le(near0, far0));
                int meets1 = any_lane(alive & le(near1, far1));
                int last = way.backward >> node->axis & 1 ? 0 : 1; /* further along the rays */
                if (meets0 && meets1) {
                    stack[waiting] = node->child[last];
                    stack_near[waiting] = last ? near1 : near0;
                    waiting++;
                }
                int next = meets0 && meets1 ? !last : meets1;
                current = meets0 || meets1 ? node->child[next] : NO_NODE;
            }
        } while (current >= 0 || (current == NO_NODE && waiting > 0));
        int first = ~current >> HD_LEAF_ITEM_BITS, count = ~current & HD_LEAF_ITEM_MASK;
        if (current == WHOLE_MESH) {
            first = instance->first_triangle;
            count = instance->triangle_count;
        }
        if (current != NO_NODE)
            try_triangles(SCENE_ARGUMENTS found, rays, m & found->alive, &way, first, count);
        current = NO_NODE;
        waiting = any_lane(m & found->alive) ? waiting : 0;
    } while (waiting > 0);
}

#endif
