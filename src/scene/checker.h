/* SPDX-License-Identifier: MIT */
/* What the checks of a scene share; scene.h has the checks themselves. */
#ifndef HD_SCENE_CHECKER_H
#define HD_SCENE_CHECKER_H

#include "scene/scene.h"

/* A check that builds on other values is left out where these are wrong, so that each mistake is
   told once. */
typedef struct HdSceneChecker {
    HdProblems *problems;
    HdNaming naming;
    char place[520]; /* "solid 2: ", or nothing */
    bool camera_is_sound;
    bool floor_is_sound; /* its shape and place are; also false where there is none */
    int solid_count;     /* 0 where the scene's is wrong */
    bool solid_is_sound[HD_MAX_SOLIDS]; /* its shape and place are */
} HdSceneChecker;

/* Names the part of the scene that is checked from now on, in front of its problems; "": none. */
void hd_checker_enter(HdSceneChecker *checker, const char *prose, const char *json);

/* The same for an element of a list, counted from 0. */
void hd_checker_enter_item(HdSceneChecker *checker, const char *prose, const char *json, int index);

/* Back to the scene as a whole. */
void hd_checker_leave(HdSceneChecker *checker);

/* Checks that the floor, which has been entered, is convex and flat, with room inside. */
void hd_check_floor_shape(HdSceneChecker *checker, const HdVec3 corner[4]);

/* Tells the first frame that has no camera. */
void hd_check_flight(HdSceneChecker *checker, const HdScene *scene);

/* Checks that refracting solids overlap nothing, as far as the solids and the floor are sound. */
void hd_check_overlaps(HdSceneChecker *checker, const HdScene *scene);

#endif
