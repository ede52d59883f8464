/* SPDX-License-Identifier: MIT */
/* Whether a scene is one: its values by the table of fields, and what they must be to each other.
   What comes of JSON text has passed the table before; other scenes have not. */
#ifndef HD_INPUT_CHECK_H
#define HD_INPUT_CHECK_H

#include "base/error.h"
#include "input/check_geometry.h"

/* Checks every value and what values must be to each other: the two shares of a side, a flat and
   convex floor, refracting solids that overlap nothing, an eye that is never at its target. Adds
   all that is wrong to `problems`. Library code may rely on a scene in which nothing was found. */
void hd_scene_check(const HdScene *scene, HdNaming naming, HdProblems *problems);

/* Checks the instances alone, whose meshes are built, as a part of hd_scene_check. */
void hd_scene_check_instances(const HdScene *scene, HdNaming naming, HdProblems *problems);

/* Checks a material alone, which may be that of a solid's faces; `place` begins the messages. */
void hd_material_check(const HdMaterial *material, const char *place, HdProblems *problems);

/* The same as hd_scene_check, in prose; on failure the error names the first value that is wrong.
 */
HdStatus hd_scene_validate(const HdScene *scene, HdError *error);

#endif
