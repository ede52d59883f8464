/* SPDX-License-Identifier: MIT */
/* JSON values as messages tell them. */
#ifndef HD_INPUT_JSON_WORDS_H
#define HD_INPUT_JSON_WORDS_H

#include <jansson.h>

enum { HD_WORDS_SIZE = 160 };

/* `text` in double quotes, escaped, and cut where it is long. */
void hd_quoted(const char *text, char out[HD_WORDS_SIZE]);

/* What follows "is": "-1", "a string, \"blue\"", "an array of 2 elements". */
void hd_json_words(const json_t *value, char out[HD_WORDS_SIZE]);

#endif
