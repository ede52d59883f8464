/* SPDX-License-Identifier: MIT */
/* What the parser of JSON does not do: a limit of values (a small text may ask for much memory),
   hints for what people take for JSON, telling lack of memory from wrong text, and the words for
   values and their places in messages. */
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

/* Fails with HD_BAD_INPUT, the line and column of a place in the text, and what is wrong there. */
HdStatus hd_json_fail_at(const char *text, size_t position, const char *name, const char *what,
                         HdError *error);

/* Refuses, with line and column, text in which more values could be: what opens an array or object
   has a first one at most, and each comma stands before another one. */
HdStatus hd_json_check_count(const char *text, size_t size, const char *name, HdError *error);

/* A short remedy for the mistake that ends at `position`, where a parser gave up; NULL where none
   is known. */
const char *hd_json_hint(const char *text, size_t position);

/* `text` in double quotes, escaped, and cut where it is long. */
void hd_quoted(const char *text, char out[HD_WORDS_SIZE]);

/* Writes the keys of an object as messages list them: "\"glass\", \"frame\" and 3 more"; "" if it
   has none. */
enum { HD_KEYS_SIZE = 512 };
void hd_json_list_keys(const json_t *object, char out[HD_KEYS_SIZE]);

/* What follows "is": "-1", "a string, \"blue\"", "an array of 2 elements". */
void hd_json_words(const json_t *value, char out[HD_WORDS_SIZE]);

/* Places are spelled solids[1].rim, materials["blue glass"].colour. These go on to a key, or to an
   element of an array; what does not fit is cut. They return the length to go back to. */
size_t hd_json_path_key(char path[HD_JSON_PATH_SIZE], const char *key);
size_t hd_json_path_index(char path[HD_JSON_PATH_SIZE], size_t index);

/* Begins to watch the allocations of jansson on all threads; again: forgets what failed before. */
void hd_json_memory_watch(void);

/* True where one failed since. */
bool hd_json_memory_failed(void);

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
