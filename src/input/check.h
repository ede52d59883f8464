/* SPDX-License-Identifier: MIT */
/* What the values of a scene must be: each alone, by the table of fields, and to each other: the
   two shares of a side, a flat and convex floor, refracting solids that overlap nothing, an eye
   that is never at its target. */
#ifndef HD_INPUT_CHECK_H
#define HD_INPUT_CHECK_H

#include "base/error.h"
#include "scene/scene.h"

/* How messages name the parts of a scene: "solid 2", or as JSON does, "solids[1]". */
typedef enum HdNaming { HD_NAMING_PROSE, HD_NAMING_JSON } HdNaming;

/* Starts with what is asked for. A check that builds on other values is left out where these are
   wrong, so that each mistake is told once. */
typedef struct HdSceneChecker {
    HdProblems *problems;
    HdNaming naming;
    bool is_view_wrong, is_floor_wrong, is_any_solid_wrong, is_solid_wrong[HD_MAX_SOLIDS];
    char place[520]; /* of the part that is checked, which begins its problems: "solid 2: " */
    int solid_count; /* 0 where the scene's is wrong */
} HdSceneChecker;

/* Checks a material alone, as the part that `place` names. */
void hd_check_material(HdSceneChecker *checker, const HdMaterial *material, bool may_refract);

/* Checks the whole scene, or only its instances, whose meshes are built. */
void hd_check_scene(HdSceneChecker *checker, const HdScene *scene);
void hd_check_instances(HdSceneChecker *checker, const HdScene *scene);

/* Checks the whole scene in prose; the error names the first value that is wrong. Library code may
   rely on a scene in which nothing was found. */
HdStatus hd_scene_validate(const HdScene *scene, HdError *error);

#endif
