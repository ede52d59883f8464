/* SPDX-License-Identifier: MIT */
/* How much JSON is taken to pieces: a small text may ask for much memory. */
#ifndef HD_INPUT_JSON_TEXT_H
#define HD_INPUT_JSON_TEXT_H

#include <stddef.h>

#include "base/error.h"

enum {
    HD_MAX_JSON_VALUES = 3000000, /* above what a scene can use; empty objects then take 700 MB */
    HD_MAX_JSON_DEPTH = 32        /* arrays and objects within each other; a scene has 7 */
};

/* Refuses, with line and column, text in which more values could be or that is nested deeper. What
   is no JSON may pass. */
HdStatus hd_json_check_limits(const char *text, size_t size, const char *name, HdError *error);

#endif
