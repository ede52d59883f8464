/* SPDX-License-Identifier: MIT */
/* What a bundle of rays meets first. */
#ifndef HD_CLOSEST_HIT_H
#define HD_CLOSEST_HIT_H

#include "meshes.h"

/* The solid that all rays run in, if nothing else reaches into it; otherwise -1. */
FN int only_within(SCENE_PARAMETERS const Ray *ray, const Reference *reference) {
    if (reference->is_eye || !reference->same || any_lane(ray->alive & ~ray->inside))
        return -1;
    int object = lane_int(&ray->touched, 0);
    return object < header->floor_end && objects[object].apart ? object : -1;
}

/* For the floor, `entering` says that it is met from above its normal. Of a mesh the
   hit names the triangle, until surface_at makes a face of it. */
FN Hit closest_hit(SCENE_PARAMETERS const Ray *ray, Reference reference) {
    Hit hit;
    hit.t = splat(REAL_LARGE);
    hit.object = splat_int(-1);
    hit.face = splat_int(0);
    hit.entering = mask_none();
    int first = 0, end = header->floor_end;
    int within = only_within(SCENE_ARGUMENTS ray, &reference);
    if (within >= 0) {
        first = within;
        end = within + 1;
    }
    for (int object = first; object < end && object < header->solid_count; object++)
        hit_solid(SCENE_ARGUMENTS ray, reference, object, &hit);
    for (int object = header->solid_count; object < end; object++)
        hit_floor(SCENE_ARGUMENTS ray, reference, object, &hit);
    if (MESHES(header) && within < 0)
        closest_mesh_hit(SCENE_ARGUMENTS ray, &reference, &hit);
    return hit;
}

#endif
