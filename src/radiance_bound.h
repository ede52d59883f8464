/* SPDX-License-Identifier: MIT */
/* What light there can be at most in a scene, before exposure and for each channel: the ground of
   every bound of what was left out. */
#ifndef HD_RADIANCE_BOUND_H
#define HD_RADIANCE_BOUND_H

#include "scene.h"

/* The intensities of all lights, added up: no point gets more light. */
HdVec3 hd_light_bound(const HdScene *scene);

/* No ray sees more radiance, however deep its tree of rays, up to HD_MAX_DEPTH. A surface that
   shows at most s by itself and sends on a share q of what its rays see shows at most s / (1 - q)
   if it sees its like without end, and s (HD_MAX_DEPTH + 1) where q = 1. */
HdVec3 hd_radiance_bound(const HdScene *scene);

/* How deep the tree of rays is, at most, until what is left of a ray of weight 1 is below `bound`,
   which is positive: up to HD_MAX_DEPTH. */
int hd_depth_for_bound(const HdScene *scene, double bound);

#endif
