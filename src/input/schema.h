/* SPDX-License-Identifier: MIT */
/* The JSON Schema of scene files, from the table of fields. */
#ifndef HD_INPUT_SCHEMA_H
#define HD_INPUT_SCHEMA_H

#include <stdio.h>

#include "base/error.h"

/* Writes the JSON Schema (draft 2020-12) of the format. */
HdStatus hd_scene_schema_print(FILE *out, HdError *error);

#endif
