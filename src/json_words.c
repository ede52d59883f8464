/* SPDX-License-Identifier: MIT */
#include "json_words.h"

#include <stdbool.h>
#include <stdio.h>

#include "number_text.h"

/* \u001b */
enum { ESCAPE_LENGTH = 6 };

static bool continues_character(char c) {
    return ((unsigned char)c & 0xc0) == 0x80;
}

size_t hd_control_bytes(const char *text) {
    const unsigned char first = (unsigned char)text[0];
    if (first == 0xc2 && continues_character(text[1]) && (unsigned char)text[1] < 0xa0)
        return 2;
    return (first < 0x20 && first != '\0') || first == 0x7f ? 1 : 0;
}

/* Copies one byte, or a control character as an escape; returns what it takes of `text`. */
static size_t put_escaped(const char *text, char *out, size_t size, size_t *used) {
    const size_t control = hd_control_bytes(text);
    if (control == 0)
        out[(*used)++] = *text;
    else
        *used += (size_t)snprintf(out + *used, size - *used, "\\u%04x",
                                  (unsigned)(unsigned char)text[control - 1]);
    return control > 0 ? control : 1;
}

void hd_escape(const char *text, char *out, size_t size) {
    size_t used = 0;
    while (*text != '\0' && used + ESCAPE_LENGTH < size)
        text += put_escaped(text, out, size, &used);
    out[used] = '\0';
}

void hd_quoted(const char *text, char out[HD_WORDS_SIZE]) {
    static const size_t longest = 100;
    size_t used = 0;
    out[used++] = '"';
    while (*text != '\0' && (used < longest || continues_character(*text)) &&
           used <= longest + ESCAPE_LENGTH + 2) /* no UTF-8 goes on so long */
        text += put_escaped(text, out, HD_WORDS_SIZE, &used);
    snprintf(out + used, HD_WORDS_SIZE - used, "%s\"", *text != '\0' ? "..." : "");
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
