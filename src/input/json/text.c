/* SPDX-License-Identifier: MIT */
#include "input/json/text.h"

#include <jansson.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct Counter {
    int values, depth;
    bool is_in_string, is_escaped;
} Counter;

static void take_in_string(Counter *counter, char c) {
    if (counter->is_escaped)
        counter->is_escaped = false;
    else if (c == '\\')
        counter->is_escaped = true;
    else if (c == '"')
        counter->is_in_string = false;
}

/* What opens has a first value at most, and each comma stands before another one. */
static void take(Counter *counter, char c) {
    if (counter->is_in_string) {
        take_in_string(counter, c);
        return;
    }
    const bool opens = c == '[' || c == '{';
    counter->is_in_string = c == '"';
    counter->values += opens || c == ',';
    counter->depth += opens;
    counter->depth -= (c == ']' || c == '}') && counter->depth > 0;
}

HdStatus hd_json_fail_at(const char *text, size_t position, const char *name, const char *what,
                         HdError *error) {
    int line = 1, column = 1;
    for (size_t i = 0; i < position; i++) {
        column = text[i] == '\n' ? 1 : column + 1;
        line += text[i] == '\n';
    }
    return hd_fail(error, HD_BAD_INPUT, "%s:%d:%d: %s", name, line, column, what);
}

HdStatus hd_json_check_limits(const char *text, size_t size, const char *name, HdError *error) {
    Counter counter = {.values = 1};
    char what[96] = "";
    for (size_t i = 0; i < size; i++) {
        take(&counter, text[i]);
        if (counter.values > HD_MAX_JSON_VALUES)
            snprintf(what, sizeof what, "there are too many values, expected at most %d",
                     (int)HD_MAX_JSON_VALUES);
        else if (counter.depth > HD_MAX_JSON_DEPTH)
            snprintf(what, sizeof what,
                     "there are too many arrays and objects in each other, expected at most %d",
                     (int)HD_MAX_JSON_DEPTH);
        if (what[0] != '\0')
            return hd_json_fail_at(text, i, name, what, error);
    }
    return HD_OK;
}

static bool is_space(char c) {
    return c != '\0' && strchr(" \t\r\n", c) != NULL;
}

static bool has_comma_before(const char *text, size_t end) {
    while (end > 0 && is_space(text[end - 1]))
        end--;
    return end > 0 && text[end - 1] == ',';
}

const char *hd_json_hint(const char *text, size_t position) {
    if (position == 0)
        return NULL;
    const char last = text[position - 1];
    if (last == '}' && has_comma_before(text, position - 1))
        return "JSON has no comma before '}'";
    if (last == ']' && has_comma_before(text, position - 1))
        return "JSON has no comma before ']'";
    if (last == '/' || last == '#')
        return "JSON has no comments";
    if (last == '\'')
        return "use double quotes";
    return NULL;
}

static atomic_bool failed;

static void *allocate(size_t bytes) {
    void *memory = malloc(bytes);
    if (memory == NULL)
        atomic_store(&failed, true);
    return memory;
}

void hd_json_memory_watch(void) {
    atomic_store(&failed, false);
    json_set_alloc_funcs(allocate, free);
}

bool hd_json_memory_failed(void) {
    return atomic_load(&failed);
}
