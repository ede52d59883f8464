/* SPDX-License-Identifier: MIT */
/* From the text of a scene file to its scene. */
#ifndef HD_INPUT_LOAD_H
#define HD_INPUT_LOAD_H

#include <stddef.h>

#include "input/scene_file.h"

enum { HD_MAX_SCENE_BYTES = 32 << 20 };

/* Reads a scene from `size` bytes of JSON, fills in every default, and checks all of it. Messages
   begin with the name and tell every problem: with line and column where the text is not JSON or
   repeats a key, otherwise with the JSON path, as "solids[1].circumradius is -1, expected ...",
   behind "--set CHANGE: " where a change brought the value. On failure `file` is left empty. */
HdStatus hd_scene_file_parse(HdSceneFile *file, const char *text, size_t size,
                             const HdSceneSource *source, HdError *error);

/* The same from a file of at most HD_MAX_SCENE_BYTES, which gives the name and the folder. */
HdStatus hd_scene_file_read(HdSceneFile *file, const char *path, const HdSceneSource *source,
                            HdError *error);

#endif
