/* SPDX-License-Identifier: MIT */
/* Reports on the placed meshes of a loaded scene file: size, place, materials, and whether a frame
   sees them. */
#ifndef HD_CLI_MESH_REPORT_H
#define HD_CLI_MESH_REPORT_H

#include <jansson.h>
#include <stdio.h>

#include "input/scene_file.h"

/* Prints a line for each of the first few placed meshes, after `prefix`, and one that counts the
   others. */
void hd_mesh_report_print(FILE *out, const char *prefix, const HdSceneFile *file, int frame);

/* Returns an array with an object for each placed mesh; NULL if memory is short. */
json_t *hd_mesh_report_json(const HdSceneFile *file, int frame);

#endif
