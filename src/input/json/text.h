/* SPDX-License-Identifier: MIT */
/* What the parser of JSON does not do: limits (a small text may ask for much memory), hints for
   what people take for JSON, and telling lack of memory from wrong text. */
#ifndef HD_INPUT_JSON_TEXT_H
#define HD_INPUT_JSON_TEXT_H

#include <stdbool.h>
#include <stddef.h>

#include "base/error.h"

enum {
    HD_MAX_JSON_VALUES = 3000000, /* above what a scene can use; empty objects then take 700 MB */
    HD_MAX_JSON_DEPTH = 32        /* arrays and objects within each other; a scene has 7 */
};

/* Fails with HD_BAD_INPUT, the line and column of a place in the text, and what is wrong there. */
HdStatus hd_json_fail_at(const char *text, size_t position, const char *name, const char *what,
                         HdError *error);

/* Refuses, with line and column, text in which more values could be or that is nested deeper. What
   is no JSON may pass. */
HdStatus hd_json_check_limits(const char *text, size_t size, const char *name, HdError *error);

/* A short remedy for the mistake that ends at `position`, where a parser gave up; NULL where none
   is known. */
const char *hd_json_hint(const char *text, size_t position);

/* Begins to watch the allocations of jansson on all threads; again: forgets what failed before. */
void hd_json_memory_watch(void);

/* True where one failed since. */
bool hd_json_memory_failed(void);

#endif
