/* SPDX-License-Identifier: MIT */
/* Whether jansson ran out of memory, which it tells as if the text were wrong. */
#ifndef HD_INPUT_JSON_JSON_MEMORY_H
#define HD_INPUT_JSON_JSON_MEMORY_H

#include <stdbool.h>

/* Begins to watch its allocations on all threads; again: forgets what failed before. */
void hd_json_memory_watch(void);

/* True where one failed since. */
bool hd_json_memory_failed(void);

#endif
