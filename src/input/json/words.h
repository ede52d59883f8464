/* SPDX-License-Identifier: MIT */
/* JSON values and their places as messages tell them. */
#ifndef HD_INPUT_JSON_WORDS_H
#define HD_INPUT_JSON_WORDS_H

#include <jansson.h>

enum { HD_WORDS_SIZE = 160, HD_JSON_PATH_SIZE = 512 };

/* `text` in double quotes, escaped, and cut where it is long. */
void hd_quoted(const char *text, char out[HD_WORDS_SIZE]);

/* What follows "is": "-1", "a string, \"blue\"", "an array of 2 elements". */
void hd_json_words(const json_t *value, char out[HD_WORDS_SIZE]);

/* Places are spelled solids[1].rim, materials["blue glass"].colour. These go on to a key, or to an
   element of an array; what does not fit is cut. They return the length to go back to. */
size_t hd_json_path_key(char path[HD_JSON_PATH_SIZE], const char *key);
size_t hd_json_path_index(char path[HD_JSON_PATH_SIZE], size_t index);

#endif
