/* SPDX-License-Identifier: MIT */
#include "json_words.h"

#include <stdbool.h>
#include <stdio.h>

#include "number_text.h"

static bool continues_character(char c) {
    return ((unsigned char)c & 0xc0) == 0x80;
}

void hd_quoted(const char *text, char out[HD_WORDS_SIZE]) {
    static const size_t longest = 100;
    size_t used = 0;
    out[used++] = '"';
    for (; *text != '\0' && (used < longest || continues_character(*text)); text++) {
        const unsigned char c = (unsigned char)*text;
        out[used++] = (char)(c < 0x20 || c == 0x7f ? '?' : c);
        if (used > longest + 8) /* no UTF-8 */
            break;
    }
    snprintf(out + used, HD_WORDS_SIZE - used, "%s\"", *text != '\0' ? "..." : "");
}

static void string_words(const json_t *value, char out[HD_WORDS_SIZE]) {
    char quoted[HD_WORDS_SIZE];
    hd_quoted(json_string_value(value), quoted);
    snprintf(out, HD_WORDS_SIZE, "a string, %.120s", quoted);
}

static void number_words(const json_t *value, char out[HD_WORDS_SIZE]) {
    char text[HD_NUMBER_SIZE];
    if (json_is_integer(value)) {
        snprintf(out, HD_WORDS_SIZE, "%" JSON_INTEGER_FORMAT, json_integer_value(value));
        return;
    }
    hd_short_number(json_real_value(value), text);
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
