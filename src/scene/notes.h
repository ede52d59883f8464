/* SPDX-License-Identifier: MIT */
/* What is allowed in a scene and is seldom meant. */
#ifndef HD_SCENE_NOTES_H
#define HD_SCENE_NOTES_H

#include "base/error.h"
#include "scene/scene.h"

/* Adds a sentence for each such thing in a valid scene to `notes`. */
void hd_scene_notes(const HdScene *scene, HdProblems *notes);

#endif
