/* SPDX-License-Identifier: MIT */
/* The walk of a single lane through a mesh, whose nodes have two children. */
#ifndef HD_MESH_WALK_ONE_H
#define HD_MESH_WALK_ONE_H

#include "mesh_walk.h"

/* The rays of `m`, which all run that way. */
FN void walk_mesh(SCENE_PARAMETERS Findings *found, const MeshRays *rays, vmask m, const Way *way,
                  int root) {
    int stack[NODE_STACK(header)];
    vreal stack_near[NODE_STACK(header)];
    int waiting = 0, current = root;
    for (;;) {
        int next = -1, has_next = 0;
        if (current >= 0) {
            GLOBAL const MeshNode *node = mesh_nodes + current;
            vreal near0 = entry_of_child(node, &rays->slabs, way, 0);
            vreal near1 = entry_of_child(node, &rays->slabs, way, 1);
            vreal far0 = lesser(exit_of_child(node, &rays->slabs, way, 0), found->limit);
            vreal far1 = lesser(exit_of_child(node, &rays->slabs, way, 1), found->limit);
            vmask alive = m & found->alive;
            int meets0 = any_lane(alive & le(near0, far0));
            int meets1 = any_lane(alive & le(near1, far1));
            int last = way->backward >> node->axis & 1 ? 0 : 1; /* further along the rays */
            if (meets0 && meets1) {
                stack[waiting] = node->child[last];
                stack_near[waiting] = last ? near1 : near0;
                waiting++;
                next = node->child[!last];
                has_next = 1;
            } else if (meets0 || meets1) {
                next = node->child[meets1 ? 1 : 0];
                has_next = 1;
            }
        } else {
            try_leaf(SCENE_ARGUMENTS found, rays, m & found->alive, way, current);
        }
        while (!has_next && waiting > 0) {
            waiting--;
            next = stack[waiting];
            vmask alive = m & found->alive;
            has_next = any_lane(alive & le(stack_near[waiting], found->limit));
        }
        RECONVERGE();
        if (!has_next)
            return;
        current = next;
    }
}

FN void search_hierarchy(SCENE_PARAMETERS Findings *found, const MeshRays *rays, vmask m,
                         int root) {
    vmask left = m;
    while (any_lane(left)) {
        Way way;
        vmask same = same_way(&rays->slabs, rays->last, left, &way);
        left = left & ~same;
        walk_mesh(SCENE_ARGUMENTS found, rays, same, &way, root);
    }
}

#endif
