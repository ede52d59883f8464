/* SPDX-License-Identifier: MIT */
/* What a bundle of rays meets first. */
#ifndef HD_CLOSEST_HIT_H
#define HD_CLOSEST_HIT_H

#include "meshes.h"

/* For the floor, `entering` says that it is met from above its normal. Of a mesh the
   hit names the triangle, until surface_at makes a face of it. */
FN Hit closest_hit(SCENE_PARAMETERS const Ray *ray, Reference reference) {
    Hit hit;
    hit.t = splat(REAL_LARGE);
    hit.object = splat_int(-1);
    hit.face = splat_int(0);
    hit.entering = mask_none();
    for (int object = 0; object < header->solid_count; object++)
        hit_solid(SCENE_ARGUMENTS ray, reference, object, &hit);
    for (int object = header->solid_count; object < header->floor_end; object++)
        hit_floor(SCENE_ARGUMENTS ray, reference, object, &hit);
    if (MESHES(header))
        closest_mesh_hit(SCENE_ARGUMENTS ray, &reference, &hit);
    return hit;
}

#endif
