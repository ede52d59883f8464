/* SPDX-License-Identifier: MIT */
/* What is allowed in a scene and is seldom meant. */
#ifndef HD_INPUT_NOTES_H
#define HD_INPUT_NOTES_H

#include "input/scene_file.h"

/* Adds a sentence for each such thing in a valid scene to `notes`. */
void hd_scene_notes(const HdSceneFile *file, HdProblems *notes);

/* Adds a problem where the scene's output is one picture and its frames are many, or of a format
   that cannot have the output's style: a rendering may still choose one frame, or another output.
 */
void hd_scene_check_output(const HdSceneFile *file, HdProblems *problems);

#endif
