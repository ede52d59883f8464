/* SPDX-License-Identifier: MIT */
#include "input/json/words.h"

#include <stdio.h>

#include "base/text.h"

void hd_quoted(const char *text, char out[HD_WORDS_SIZE]) {
    char start[108];
    const size_t taken = hd_escape(text, start, sizeof start);
    snprintf(out, HD_WORDS_SIZE, "\"%s%s\"", start, text[taken] != '\0' ? "..." : "");
}

static void string_words(const json_t *value, char out[HD_WORDS_SIZE]) {
    char quoted[HD_WORDS_SIZE];
    hd_quoted(json_string_value(value), quoted);
    snprintf(out, HD_WORDS_SIZE, "a string, %.120s", quoted);
}

static void number_words(const json_t *value, char out[HD_WORDS_SIZE]) {
    char text[HD_NUMBER_SIZE];
    hd_short_number(json_number_value(value), text);
    snprintf(out, HD_WORDS_SIZE, "%s", text);
}

void hd_json_words(const json_t *value, char out[HD_WORDS_SIZE]) {
    const size_t count = json_array_size(value);
    if (json_is_string(value))
        string_words(value, out);
    else if (json_is_number(value))
        number_words(value, out);
    else if (json_is_array(value))
        snprintf(out, HD_WORDS_SIZE, "an array of %zu element%s", count, count == 1 ? "" : "s");
    else if (json_is_object(value))
        snprintf(out, HD_WORDS_SIZE, "an object");
    else
        snprintf(out, HD_WORDS_SIZE, "%s",
                 json_is_true(value)    ? "true"
                 : json_is_false(value) ? "false"
                                        : "null");
}
