/* SPDX-License-Identifier: MIT */
/* Validates scenes: each value alone, by the table of fields, and values against each other.
   Examples are the two shares of a side, a convex flat floor, refracting solids that overlap
   nothing, and an eye away from its target. */
#ifndef HD_INPUT_CHECK_H
#define HD_INPUT_CHECK_H

#include "base/error.h"
#include "scene/scene.h"

/* How messages name the parts of a scene: "solid 2", or as in JSON, "solids[1]". */
typedef enum HdNaming { HD_NAMING_PROSE, HD_NAMING_JSON } HdNaming;

/* A scene's check; starts with the caller's settings. If other values are wrong, checks that build
   on them are skipped, so that each mistake is reported once. */
typedef struct HdSceneChecker {
    HdProblems *problems;
    HdNaming naming;
    bool is_view_wrong, is_floor_wrong, is_any_solid_wrong, is_solid_wrong[HD_MAX_SOLIDS];
    char place[520]; /* prefix of the checked part's problems: "solid 2: " */
    int solid_count; /* 0 if the scene's is wrong */
} HdSceneChecker;

/* Checks a material alone, as the part named by `place`. */
void hd_check_material(HdSceneChecker *checker, const HdMaterial *material, bool may_refract);

/* Check the whole scene, or only its instances, whose meshes are built. */
void hd_check_scene(HdSceneChecker *checker, const HdScene *scene);
void hd_check_instances(HdSceneChecker *checker, const HdScene *scene);

/* Checks the whole scene in prose; the error names the first wrong value. Library code may rely on
   a scene that passes. */
HdStatus hd_scene_validate(const HdScene *scene, HdError *error);

#endif
