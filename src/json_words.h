/* SPDX-License-Identifier: MIT */
/* JSON values as messages tell them. */
#ifndef HD_JSON_WORDS_H
#define HD_JSON_WORDS_H

#include <jansson.h>

enum { HD_WORDS_SIZE = 160 };

/* How many bytes the control character takes that `text` begins with: 1 below U+0020 and for
   U+007F, 2 for U+0080 to U+009F in UTF-8; 0: it begins with none. */
size_t hd_control_bytes(const char *text);

/* Copies `text`, control characters as \u001b, lest they steer a terminal; cut to `size` bytes with
   the zero byte. */
void hd_escape(const char *text, char *out, size_t size);

/* `text` in double quotes, escaped, and cut where it is long. */
void hd_quoted(const char *text, char out[HD_WORDS_SIZE]);

/* What follows "is": "-1", "a string, \"blue\"", "an array of 2 elements". */
void hd_json_words(const json_t *value, char out[HD_WORDS_SIZE]);

#endif
