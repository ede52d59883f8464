/* SPDX-License-Identifier: MIT */
/* Loads scenes from files, standard input or the program, and applies a plan's overrides. */
#ifndef HD_RUN_LOAD_SCENE_H
#define HD_RUN_LOAD_SCENE_H

#include "run/plan.h"

/* Returns the scene's name in messages: "-" is standard input, NULL the built-in one. */
const char *hd_scene_name(const char *path);

/* Reads the classic input `path`, or standard input, "-". All curves are linear, as in the classic
   mode. */
HdStatus hd_read_classic(HdSceneFile *file, const char *path, int variant, HdError *error);

/* Reads the scene file `path`, or standard input, "-", or the built-in scene, NULL. Supplies the
   name and, for a file, the folder; `source` must have the folder "". */
HdStatus hd_read_scene(HdSceneFile *file, const char *path, const HdSceneSource *source,
                       HdError *error);

/* Applies the plan's numbers to a valid scene. If they do not suit it, the message begins with the
   options as given: "--size 60000x60000: ". */
HdStatus hd_scene_apply_numbers(HdScene *scene, const HdScenePlan *plan, HdError *error);

/* Loads the planned scene, its texture and its meshes, and applies the plan: numbers, geometry, and
   the search of triangles. `notes`, NULL or empty, gets notes on unused contents of mesh files. */
HdStatus hd_load_scene(HdSceneFile *file, const HdScenePlan *plan, HdProblems *notes,
                       HdError *error);

#endif
