/* SPDX-License-Identifier: MIT */
/* Writes scenes, and their JSON Schema, by the table of fields. */
#ifndef HD_INPUT_WRITE_H
#define HD_INPUT_WRITE_H

#include <stdint.h>
#include <stdio.h>

#include "input/fields.h"

/* Writes a scene, which must be valid, as JSON that reads back as the same scene, number for number
   (only a point light beyond 2^39 may come back a rounding off). Materials get names: "solid_1",
   "rim_1", "mesh_1", "floor". Fails with HD_BAD_INPUT where a path is not UTF-8. */
HdStatus hd_scene_file_print(FILE *out, const HdSceneFile *file, HdError *error);

/* Writes the JSON Schema (draft 2020-12) of the format. */
HdStatus hd_scene_schema_print(FILE *out, HdError *error);

/* Goes on from `hash` with what the object says, as it would be written: materials in their places,
   without names of files and what becomes of the frames. Where hashes agree, so do the values. */
uint64_t hd_object_hash(uint64_t hash, const HdObjectType *type, const void *owner);

#endif
