/* SPDX-License-Identifier: MIT */
/* Where scenes come from: files, standard input or the program, and what is laid over them. */
#ifndef HD_RUN_LOAD_SCENE_H
#define HD_RUN_LOAD_SCENE_H

#include "run/plan.h"

/* What messages call a scene: "-" is standard input, NULL the built-in one. */
const char *hd_scene_name(const char *path);

/* Reads the classic input `path`, or standard input, "-", as what its JSON would be: curves are
   linear everywhere, as they are in the classic mode. */
HdStatus hd_read_classic(HdSceneFile *file, const char *path, int variant, HdError *error);

/* Reads the scene file `path`, or standard input, "-", or the built-in scene, NULL; the name and
   the folder are those that suit it, but for that `source` has the folder "". */
HdStatus hd_read_scene(HdSceneFile *file, const char *path, const HdSceneSource *source,
                       HdError *error);

/* Lays the plan's numbers over a valid scene. Where they do not suit it, the message begins with
   what was given, as "--size 60000x60000: ". */
HdStatus hd_scene_apply_numbers(HdScene *scene, const HdScenePlan *plan, HdError *error);

/* Reads the planned scene with its texture and its meshes, and lays the plan over it: its numbers,
   solids or triangles, and how these are searched. `notes`, NULL or empty, gets what of the meshes'
   files is not used, where they were read. */
HdStatus hd_load_scene(HdSceneFile *file, const HdScenePlan *plan, HdProblems *notes,
                       HdError *error);

#endif
