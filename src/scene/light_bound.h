/* SPDX-License-Identifier: MIT */
/* Upper bounds of the light in a scene, per channel, before exposure. All truncation bounds build
   on them. */
#ifndef HD_SCENE_LIGHT_BOUND_H
#define HD_SCENE_LIGHT_BOUND_H

#include "scene/scene.h"

/* Returns a bound of what rays see that hit nothing. */
HdVec3 hd_background_bound(const HdScene *scene);

/* Returns the sum of all lights' intensities, which no point's light exceeds. */
HdVec3 hd_light_bound(const HdScene *scene);

/* Returns a bound of what a surface shows by itself: lit by all lights, unattenuated, at normal
   incidence. */
HdVec3 hd_surface_bound(const HdScene *scene);

/* Returns a bound of any ray's radiance, for ray depths up to HD_MAX_DEPTH. Let a surface show at
   most s by itself and send on a share q. It shows at most s / (1 - q) if all that it sees does
   likewise, or else at most what the background or discs show. These plus s for each ray depth are
   a second bound; the smaller one counts. */
HdVec3 hd_radiance_bound(const HdScene *scene);

/* Bounds of the radiance of rays that leave an object. */
typedef struct HdSeen {
    HdVec3 outside; /* bound of outward rays of a solid; else of all rays */
    HdVec3 inside;  /* bound of inward rays of a solid; else the same */
} HdSeen;

/* Fills `seen` for each solid, then for the floor and for all meshes: solid_count + 2 entries. A
   ray inside a convex solid sees its inner side and objects that have points in common with it. A
   ray outside never sees that solid, and inner sides only of solids that have points in common with
   it. Each round derives the shown bounds from the seen ones and back, from hd_radiance_bound
   downwards; every round's result is a bound. */
void hd_seen_bounds(const HdScene *scene, HdSeen *seen);

/* Returns the ray depth, up to HD_MAX_DEPTH, from which a ray of weight 1 adds less than `bound`,
   which is positive. */
int hd_depth_for_bound(const HdScene *scene, double bound);

#endif
