/* SPDX-License-Identifier: MIT */
/* What commands print as JSON, with what drivers say in it. */
#ifndef HD_INPUT_JSON_JSON_DEVICE_TEXT_H
#define HD_INPUT_JSON_JSON_DEVICE_TEXT_H

#include <jansson.h>

#include "base/error.h"

/* A new JSON string. Where the bytes are no UTF-8, each that is not ASCII becomes a question mark.
   NULL where there is no memory. */
json_t *hd_json_device_text(const char *bytes);

/* The same; JSON's null for NULL and "". */
json_t *hd_json_text_or_null(const char *bytes);

/* JSON's null unless it is positive. */
json_t *hd_json_count_or_null(int count);

/* Appends, takes both and returns the list: NULL where either is, or there is no memory. */
json_t *hd_json_append(json_t *list, json_t *item);

/* Prints `root`, which it takes, on standard output. NULL stands for what could not be put together
   for want of memory: no room for `what`. */
HdStatus hd_json_print(json_t *root, const char *what, HdError *error);

#endif
