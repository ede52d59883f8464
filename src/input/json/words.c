/* SPDX-License-Identifier: MIT */
#include "input/json/words.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "base/text.h"

void hd_quoted(const char *text, char out[HD_WORDS_SIZE]) {
    char start[108];
    const size_t taken = hd_escape(text, start, sizeof start);
    snprintf(out, HD_WORDS_SIZE, "\"%s%s\"", start, text[taken] != '\0' ? "..." : "");
}

void hd_json_words(const json_t *value, char out[HD_WORDS_SIZE]) {
    const size_t count = json_array_size(value);
    char text[HD_WORDS_SIZE];
    if (json_is_string(value)) {
        hd_quoted(json_string_value(value), text);
        snprintf(out, HD_WORDS_SIZE, "a string, %.120s", text);
    } else if (json_is_number(value)) {
        hd_short_number(json_number_value(value), out);
    } else if (json_is_array(value)) {
        snprintf(out, HD_WORDS_SIZE, "an array of %zu element%s", count, count == 1 ? "" : "s");
    } else {
        snprintf(out, HD_WORDS_SIZE, "%s",
                 json_is_object(value)  ? "an object"
                 : json_is_true(value)  ? "true"
                 : json_is_false(value) ? "false"
                                        : "null");
    }
}

static bool is_plain(const char *key) {
    static const char letters[] =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
    const size_t length = strlen(key);
    return length > 0 && length <= 64 && strspn(key, letters) == length;
}

size_t hd_json_path_key(char path[HD_JSON_PATH_SIZE], const char *key) {
    char quoted[HD_WORDS_SIZE];
    const size_t length = strlen(path);
    const size_t room = HD_JSON_PATH_SIZE - length;
    if (is_plain(key)) {
        snprintf(path + length, room, "%s%s", length > 0 ? "." : "", key);
    } else {
        hd_quoted(key, quoted);
        snprintf(path + length, room, "[%s]", quoted);
    }
    return length;
}

size_t hd_json_path_index(char path[HD_JSON_PATH_SIZE], size_t index) {
    const size_t length = strlen(path);
    snprintf(path + length, HD_JSON_PATH_SIZE - length, "[%zu]", index);
    return length;
}
