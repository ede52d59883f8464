/* SPDX-License-Identifier: MIT */
#include "input/json/json_hints.h"

#include <stdbool.h>
#include <string.h>

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
