/* SPDX-License-Identifier: MIT */
/* The search of one mesh by a bundle of rays: for the closest hit, or for all that filters light.
   Rays that run the same way share a walk through the hierarchy. What is found does not depend on
   the way. */
#ifndef HD_MESH_SEARCH_H
#define HD_MESH_SEARCH_H

#include "mesh_walk.h"
#if HD_LANES > 1
#include "mesh_walk_wide.h"
#else
#include "mesh_walk_one.h"
#endif

/* Searches one mesh with the rays of `m`, whichever way it is laid out. */
FN void search_mesh(SCENE_PARAMETERS Findings *found, const MeshRays *rays, vmask m,
                    GLOBAL const Instance *instance) {
    if (instance->root >= 0)
        search_hierarchy(SCENE_ARGUMENTS found, rays, m, instance->root);
    else
        try_all(SCENE_ARGUMENTS found, rays, m, instance->first_triangle, instance->triangle_count);
}

#endif
