/* SPDX-License-Identifier: MIT */
/* What light there can be at most in a scene, before exposure and for each channel: the ground of
   every bound of what was left out. */
#ifndef HD_SCENE_LIGHT_BOUND_H
#define HD_SCENE_LIGHT_BOUND_H

#include "scene/scene.h"

/* The intensities of all lights, added up: no point gets more light. */
HdVec3 hd_light_bound(const HdScene *scene);

/* No surface shows more by itself: lit by all lights, as near and as upright as can be. */
HdVec3 hd_surface_bound(const HdScene *scene);

/* No ray sees more radiance, however deep its tree of rays, up to HD_MAX_DEPTH. A surface that
   shows at most s by itself and sends on a share q of what its rays see shows at most s / (1 - q)
   where all that it sees does likewise, unless background or discs show more; and never more than
   these and s for each level. */
HdVec3 hd_radiance_bound(const HdScene *scene);

/* What is seen at most by rays that leave an object. */
typedef struct HdSeen {
    HdVec3 outside; /* of a solid: outwards; else of either side */
    HdVec3 inside;  /* of a solid: inwards; else the same */
} HdSeen;

/* Fills `seen` for each solid, then for the floor and for all meshes: solid_count + 2. A ray within
   a convex solid sees its inner side and what has points in common with it, one outside never that
   solid itself, and the inner sides of those only that have. Each round puts what is seen at most
   into what surfaces show at most, and so on, from hd_radiance_bound downwards: each is a bound. */
void hd_seen_bounds(const HdScene *scene, HdSeen *seen);

/* How deep a ray of weight 1 can go until what it can add is below `bound`, which is positive: up
   to HD_MAX_DEPTH. */
int hd_depth_for_bound(const HdScene *scene, double bound);

#endif
