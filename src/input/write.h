/* SPDX-License-Identifier: MIT */
/* Writes scenes and their JSON Schema by the table of fields. */
#ifndef HD_INPUT_WRITE_H
#define HD_INPUT_WRITE_H

#include <stdint.h>
#include <stdio.h>

#include "input/fields.h"

/* Writes a valid scene as JSON that reads back as the same numbers; only a point light beyond 2^39
   may differ by a rounding. Materials are named "solid_1", "rim_1", "mesh_1", "floor". Fails with
   HD_BAD_INPUT if a path is not UTF-8. */
HdStatus hd_scene_file_print(FILE *out, const HdSceneFile *file, HdError *error);

/* Writes the JSON Schema (draft 2020-12) of the format. */
HdStatus hd_scene_schema_print(FILE *out, HdError *error);

/* Continues `hash` over the object as it would be written, with materials in place, without file
   names and output settings. Equal hashes mean equal values. */
uint64_t hd_object_hash(uint64_t hash, const HdObjectType *type, const void *owner);

#endif
