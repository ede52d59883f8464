/* SPDX-License-Identifier: MIT */
#include "input/json/text.h"

#include <ctype.h>
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

/* The word, or what begins like a number, that ends there. */
static const char *hint_of_word(const char *text, size_t end) {
    static const char *const words[] = {"true", "false", "null", "none", "nil"};
    static const char *const numbers[] = {"nan", "inf", "infinity"};
    char word[16] = "";
    size_t start = end;
    while (start > 0 && (isalnum((unsigned char)text[start - 1]) || strchr("+-.", text[start - 1])))
        start--;
    for (size_t i = 0; i + 1 < sizeof word && start + i < end; i++)
        word[i] = (char)tolower((unsigned char)text[start + i]);
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
        if (strcmp(word, words[i]) == 0)
            return "JSON says true, false or null";
    bool is_number = word[0] != '\0' && strchr("+-.0123456789", word[0]) != NULL;
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++)
        is_number |= strcmp(word, numbers[i]) == 0;
    return is_number ? "a number in JSON looks like 0.5, -2 or 1e3, and none is NaN or infinite"
                     : NULL;
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
        return "JSON has no comments, but an object may have \"$comment\": \"...\"";
    if (last == '\'')
        return "use double quotes";
    return hint_of_word(text, position);
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
