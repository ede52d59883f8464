/* SPDX-License-Identifier: MIT */
/* What people take for JSON. */
#ifndef HD_INPUT_JSON_JSON_HINTS_H
#define HD_INPUT_JSON_JSON_HINTS_H

#include <stddef.h>

/* A short remedy for the mistake that ends at `position`, where a parser gave up; NULL where none
   is known. */
const char *hd_json_hint(const char *text, size_t position);

#endif
