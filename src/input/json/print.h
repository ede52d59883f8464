/* SPDX-License-Identifier: MIT */
/* Prints JSON for people: an indent of 2, and three numbers that belong together on one line.
   Scenes and their schema go this way, since jansson, which prints what programs read (statistics,
   devices), would give every number of a vector a line of its own. */
#ifndef HD_INPUT_JSON_PRINT_H
#define HD_INPUT_JSON_PRINT_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "base/vector.h"

/* Start with the stream alone, or with the hash alone, which then goes on with the text. */
typedef struct HdJsonPrinter {
    FILE *out; /* NULL: nothing is printed */
    uint64_t hash;
    int depth;
    bool has_elements; /* the innermost object or array has */
    bool has_key;      /* the next value's key is written */
} HdJsonPrinter;

/* The key of the value that comes next. */
void hd_json_key(HdJsonPrinter *printer, const char *key);

/* '{' or '[', and '}' or ']'. */
void hd_json_open(HdJsonPrinter *printer, char bracket);
void hd_json_close(HdJsonPrinter *printer, char bracket);

/* JSON as it is. */
void hd_json_raw(HdJsonPrinter *printer, const char *json);

/* A string; `text` is UTF-8. */
void hd_json_string(HdJsonPrinter *printer, const char *text);
void hd_json_number(HdJsonPrinter *printer, double value);
void hd_json_vector(HdJsonPrinter *printer, HdVec3 value);

#endif
