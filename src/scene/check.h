/* SPDX-License-Identifier: MIT */
/* What the values of a scene must be to each other: the two shares of a side, a flat and convex
   floor, refracting solids that overlap nothing, an eye that is never at its target. */
#ifndef HD_SCENE_CHECK_H
#define HD_SCENE_CHECK_H

#include "base/error.h"
#include "scene/scene.h"

/* How messages name the parts of a scene: "solid 2", or as JSON does, "solids[1]". */
typedef enum HdNaming { HD_NAMING_PROSE, HD_NAMING_JSON } HdNaming;

/* What has values of its own, and the struct that they are in. */
typedef enum HdScenePart {
    HD_PART_CAMERA,      /* HdScene */
    HD_PART_PICTURE,     /* HdScene */
    HD_PART_LIGHT,       /* HdLight */
    HD_PART_SOLID,       /* HdSolid, but for its materials and lights */
    HD_PART_EDGE_LIGHTS, /* HdEdgeLights */
    HD_PART_FLOOR,       /* HdFloor, but for its material */
    HD_PART_INSTANCE,    /* HdInstance, likewise */
    HD_PART_MATERIAL,    /* HdMaterial */
    HD_PART_COATING      /* the same, of what cannot refract */
} HdScenePart;

/* Starts with what is asked for. A check that builds on other values is left out where these are
   wrong, so that each mistake is told once. */
typedef struct HdSceneChecker {
    HdProblems *problems;
    HdNaming naming;
    /* Checks each value of a part, in front of what they must be to each other; NULL: they are
       right, but for what the next ones tell. */
    void (*check_values)(struct HdSceneChecker *checker, HdScenePart part, const void *owner);
    bool is_view_wrong, is_floor_wrong, is_any_solid_wrong, is_solid_wrong[HD_MAX_SOLIDS];
    char place[520]; /* of the part that is checked, which begins its problems: "solid 2: " */
    int solid_count; /* 0 where the scene's is wrong */
} HdSceneChecker;

/* Adds a problem of the part that is checked: a format, without the place, and its arguments. */
#define hd_tell(checker, format, ...)                                                              \
    hd_problem((checker)->problems, "%s" format, (checker)->place, __VA_ARGS__)

/* Names the part of the scene that is checked from then on, in front of its problems; "": none. */
void hd_check_enter(HdSceneChecker *checker, const char *prose, const char *json);

void hd_check_int(HdSceneChecker *checker, const char *what, int value, int low, int high);

/* Checks a material alone. */
void hd_check_material(HdSceneChecker *checker, const HdMaterial *material, bool may_refract);

/* Checks the whole scene, or only its instances, whose meshes are built. */
void hd_check_scene(HdSceneChecker *checker, const HdScene *scene);
void hd_check_instances(HdSceneChecker *checker, const HdScene *scene);

#endif
