/* SPDX-License-Identifier: MIT */
/* Writes scenes by the table of fields. */
#ifndef HD_INPUT_WRITE_H
#define HD_INPUT_WRITE_H

#include <stdint.h>
#include <stdio.h>

#include "input/fields.h"
#include "input/json/print.h"

/* Writes a scene, which must be valid, as JSON that reads back as the same scene, number for number
   (only a point light beyond 2^39 may come back a rounding off). Materials get names: "solid_1",
   "rim_1", "mesh_1", "floor". Fails with HD_BAD_INPUT where a path is not UTF-8. */
HdStatus hd_scene_file_print(FILE *out, const HdSceneFile *file, HdError *error);

/* Prints the word of a choice. */
void hd_choice_print(HdJsonPrinter *printer, const char *word);

/* Prints what hd_field_set takes, as a file tells it; of a path its point. */
void hd_numbers_print(HdJsonPrinter *printer, const HdField *field, const double numbers[3]);

/* Goes on from `hash` with what the object says, as it would be written: materials in their places,
   without names of files and what becomes of the frames. Where hashes agree, so do the values. */
uint64_t hd_object_hash(uint64_t hash, const HdObjectType *type, const void *owner);

#endif
