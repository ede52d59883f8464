/* SPDX-License-Identifier: MIT */
/* The paths of a scene's values, for those who type one. */
#ifndef HD_INPUT_SCENE_PATHS_H
#define HD_INPUT_SCENE_PATHS_H

/* Takes what may be typed next, whole, and what it is about, which may be "". */
typedef void HdOffer(const void *taker, const char *text, const char *about);

/* Offers how `typed`, which is the beginning of a change such as "camera.eye=[4,0,2]", may go on:
   to the next "." or "=", and behind that one to the words that the value may be. `scene` is the
   name of the scene's file; where it is NULL, or cannot be read, it is the built-in scene. */
void hd_offer_scene_paths(const char *scene, const char *typed, HdOffer *offer, const void *taker);

#endif
