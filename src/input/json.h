/* SPDX-License-Identifier: MIT */
/* Complements the JSON parser: a limit of values, since a small text may need much memory; hints
   for common mistakes; detection of lack of memory; wording of values and places. */
#ifndef HD_INPUT_JSON_H
#define HD_INPUT_JSON_H

#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>

#include "base/error.h"

enum {
    HD_MAX_JSON_VALUES = 3000000, /* above what a scene can use; empty objects then take 700 MB */
    HD_WORDS_SIZE = 160,
    HD_JSON_PATH_SIZE = 512
};

/* Fails with HD_BAD_INPUT and a message with the position's line and column. */
HdStatus hd_json_fail_at(const char *text, size_t position, const char *name, const char *what,
                         HdError *error);

/* Fails, with line and column, if the text may have too many values: one per opening bracket and
   one per comma. */
HdStatus hd_json_check_count(const char *text, size_t size, const char *name, HdError *error);

/* Returns a short remedy for the mistake before `position`, where a parser stopped; NULL if none is
   known. */
const char *hd_json_hint(const char *text, size_t position);

/* Writes `text` in double quotes, escaped, and shortened if long. */
void hd_quoted(const char *text, char out[HD_WORDS_SIZE]);

/* Writes the keys of an object as messages list them: "\"glass\", \"frame\" and 3 more"; "" if it
   has none. */
enum { HD_KEYS_SIZE = 512 };
void hd_json_list_keys(const json_t *object, char out[HD_KEYS_SIZE]);

/* Describes a value, to follow "is": "-1", "a string, \"blue\"", "an array of 2 elements". */
void hd_json_words(const json_t *value, char out[HD_WORDS_SIZE]);

/* Extend a path by a key or an index, as in solids[1].rim and materials["blue glass"].colour; what
   does not fit is cut. Return the length to go back to. */
size_t hd_json_path_key(char path[HD_JSON_PATH_SIZE], const char *key);
size_t hd_json_path_index(char path[HD_JSON_PATH_SIZE], size_t index);

/* Starts watching jansson's allocations on all threads, or clears an earlier failure. */
void hd_json_memory_watch(void);

/* Returns whether an allocation has failed since. */
bool hd_json_memory_failed(void);

/* Returns a new JSON string. If the bytes are not UTF-8, each non-ASCII byte becomes a question
   mark. NULL if memory is short. */
json_t *hd_json_device_text(const char *bytes);

/* Does the same; JSON's null for NULL and "". */
json_t *hd_json_text_or_null(const char *bytes);

/* Returns JSON's null unless the count is positive. */
json_t *hd_json_count_or_null(int count);

/* Appends; consumes both references and returns the list. NULL if either is NULL or memory is
   short. */
json_t *hd_json_append(json_t *list, json_t *item);

/* Prints `root`, which it consumes, on standard output. NULL means that memory was short: the error
   names `what`. */
HdStatus hd_json_print(json_t *root, const char *what, HdError *error);

#endif
