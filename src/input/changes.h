/* SPDX-License-Identifier: MIT */
/* Changes that a command line makes to a scene file: "solids[1].circumradius=2". */
#ifndef HD_INPUT_CHANGES_H
#define HD_INPUT_CHANGES_H

#include <jansson.h>
#include <stdbool.h>

#include "input/scene_file.h"

/* How JSON is read here: an integer is a number like others, however long it is. */
#define HD_JSON_FLAGS (JSON_REJECT_DUPLICATES | JSON_DECODE_INT_AS_REAL)

/* What messages call a change. */
#define HD_CHANGE_OPTION "--set"

/* Puts the value in its place in the tree. The object or array that holds it must be there, but for
   the objects at the top that may be left out ("image"); an element of an array must be there
   itself. Whether the scene knows such a key is checked later, with the rest of the file. */
void hd_scene_change_apply(json_t *root, HdSceneChange change, HdProblems *problems);

/* Whether the value at `path`, spelled as in json/text.h, comes from the change. */
bool hd_scene_change_made(HdSceneChange change, const char *path);

/* How messages begin that are about a change: "--set image.width=0: ". */
void hd_scene_change_name(HdSceneChange change, char out[256]);

#endif
