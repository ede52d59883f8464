/* SPDX-License-Identifier: MIT */
/* What drivers say, as JSON. */
#ifndef HD_INPUT_JSON_JSON_DEVICE_TEXT_H
#define HD_INPUT_JSON_JSON_DEVICE_TEXT_H

#include <jansson.h>

/* A new JSON string. Where the bytes are no UTF-8, each that is not ASCII becomes a question mark.
   NULL where there is no memory. */
json_t *hd_json_device_text(const char *bytes);

#endif
