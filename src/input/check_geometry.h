/* SPDX-License-Identifier: MIT */
/* Checks of where the parts of a scene are to each other and to themselves. */
#ifndef HD_INPUT_CHECK_GEOMETRY_H
#define HD_INPUT_CHECK_GEOMETRY_H

#include "base/error.h"
#include "scene/scene.h"

/* How messages name the parts of a scene: "solid 2", or as JSON does, "solids[1]". */
typedef enum HdNaming { HD_NAMING_PROSE, HD_NAMING_JSON } HdNaming;

/* A check that builds on other values is left out where these are wrong, so that each mistake is
   told once. */
typedef struct HdSceneChecker {
    HdProblems *problems;
    HdNaming naming;
    char place[520]; /* of the part that is checked, which begins its problems: "solid 2: " */
    bool camera_is_sound;
    bool floor_is_sound; /* its shape and place are; also false where there is none */
    int solid_count;     /* 0 where the scene's is wrong */
    bool solid_is_sound[HD_MAX_SOLIDS]; /* its shape and place are */
} HdSceneChecker;

/* Adds a problem of the part that is checked: a format, without the place, and its arguments. */
#define hd_tell(checker, format, ...)                                                              \
    hd_problem((checker)->problems, "%s" format, (checker)->place, __VA_ARGS__)

/* Checks that the floor, whose place has been set, is convex and flat, with room inside. */
void hd_check_floor_shape(HdSceneChecker *checker, const HdVec3 corner[4]);

/* Tells the first frame that has no camera. */
void hd_check_flight(HdSceneChecker *checker, const HdScene *scene);

/* Checks that refracting solids overlap nothing, as far as the solids and the floor are sound. */
void hd_check_overlaps(HdSceneChecker *checker, const HdScene *scene);

#endif
