/* SPDX-License-Identifier: MIT */
/* From the tree of JSON to the scene. */
#ifndef HD_INPUT_READ_H
#define HD_INPUT_READ_H

#include <jansson.h>

#include "input/scene_file.h"

/* Fills `file`, which must be empty, and adds everything that is wrong to `problems`: what the
   table of fields refuses, and what the checks of the scene find in the rest. A value that is
   refused has its default instead. Fails only for lack of memory. */
HdStatus hd_scene_from_json(HdSceneFile *file, const json_t *root, const HdSceneSource *source,
                            HdProblems *problems, HdError *error);

#endif
