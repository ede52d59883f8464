/* SPDX-License-Identifier: MIT */
/* Strings of a scene that name files. */
#ifndef HD_INPUT_SCENE_TEXTS_H
#define HD_INPUT_SCENE_TEXTS_H

#include "input/report.h"

/* Checks the string at the report's path: fewer than HD_MAX_PATH bytes, and no control characters,
   which no name of a file has by intent. False where it tells a problem. */
bool hd_check_file_name(HdSceneReport *report, const json_t *value);

/* Checks that the path of an output, which may be empty, has an ending that says what to write, and
   a number only where it may. */
void hd_check_output_path(HdSceneReport *report, const char *path);

/* Checks that the path of a texture, which may be empty, names no part that the program lacks.
   False where it tells a problem. */
bool hd_check_texture_path(HdSceneReport *report, const char *path);

#endif
