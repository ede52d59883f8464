/* SPDX-License-Identifier: MIT */
#include "base/tokens.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"

static bool is_space(char c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
}

/* The start of a token, fit for a message. */
static const char *shown(const char *token, char out[44]) {
    const size_t taken = hd_escape(token, out, 41), length = strlen(out);
    snprintf(out + length, 4, "%s", token[taken] != '\0' ? "..." : "");
    return out;
}

#define refuse(reader, what, format, ...)                                                          \
    ((reader)->status =                                                                            \
         hd_fail((reader)->error, HD_BAD_INPUT, "%s:%d: %s%s " format, (reader)->name,             \
                 (reader)->line, (reader)->where, what, __VA_ARGS__))

static void fail_token(HdTokenReader *reader, const char *what, const char *token,
                       const char *expected) {
    char value[44];
    refuse(reader, what, "is '%s', expected %s", reader->hides_tokens ? "..." : shown(token, value),
           expected);
}

static void skip_space(HdTokenReader *reader) {
    while (reader->position < reader->size && is_space(reader->text[reader->position])) {
        if (reader->text[reader->position] == '\n')
            reader->line++;
        reader->position++;
    }
}

/* False where there is none, which is an error, or where an error came before. */
static bool read_token(HdTokenReader *reader, const char *what, const char *expected,
                       char token[HD_MAX_TOKEN]) {
    if (reader->status != HD_OK)
        return false;
    skip_space(reader);
    const char *start = reader->text + reader->position;
    size_t length = 0;
    while (reader->position + length < reader->size && !is_space(start[length]))
        length++;
    reader->position += length;
    if (length == 0)
        refuse(reader, what, "is missing, expected %s", expected);
    else if (length >= HD_MAX_TOKEN)
        refuse(reader, what, "has %zu characters, expected at most %d", length, HD_MAX_TOKEN - 1);
    else if (memchr(start, '\0', length) != NULL)
        refuse(reader, what, "holds a zero byte, expected %s", expected);
    if (reader->status != HD_OK)
        return false;
    memcpy(token, start, length);
    token[length] = '\0';
    return true;
}

/* Decimal notation only: strtod alone would take hexadecimal numbers, "nan" and "inf" too. */
static bool is_decimal(const char *s, double *number) {
    char *end;
    *number = strtod(s, &end);
    return *end == '\0' && s[strspn(s, "0123456789+-.eE")] == '\0';
}

/* False where there is none, which is an error. */
static bool next_number(HdTokenReader *reader, const char *what, double *number) {
    static const char *const expected = "a number";
    char token[HD_MAX_TOKEN];
    if (!read_token(reader, what, expected, token))
        return false;
    if (!is_decimal(token, number))
        fail_token(reader, what, token, expected);
    else if (isinf(*number))
        fail_token(reader, what, token, "a number within the range of double precision");
    return reader->status == HD_OK;
}

void hd_read_number(HdTokenReader *reader, const char *what, double *value) {
    double number;
    if (next_number(reader, what, &number))
        *value = number;
}

void hd_read_share(HdTokenReader *reader, const char *what, double *value) {
    double number;
    if (!next_number(reader, what, &number))
        return;
    if (number >= 0.0 && number <= 1.0)
        *value = number;
    else
        refuse(reader, what, "is %.15g, expected a number from 0 to 1", number);
}

void hd_read_int(HdTokenReader *reader, const char *what, int low, int high, int *value) {
    char expected[64], *end;
    char token[HD_MAX_TOKEN];
    snprintf(expected, sizeof expected, "a whole number from %d to %d", low, high);
    if (!read_token(reader, what, expected, token))
        return;
    const long number = strtol(token, &end, 10); /* one too long is the largest or least */
    if (*end != '\0' || number < low || number > high)
        fail_token(reader, what, token, expected);
    else
        *value = (int)number;
}

void hd_read_path(HdTokenReader *reader, const char *what, char path[HD_MAX_TOKEN]) {
    read_token(reader, what, "a path", path);
}

void hd_read_end(HdTokenReader *reader) {
    static const char *const what = "what follows the last value";
    char token[HD_MAX_TOKEN];
    if (reader->status != HD_OK)
        return;
    skip_space(reader);
    if (reader->position < reader->size && read_token(reader, what, "the end of the input", token))
        fail_token(reader, what, token, "the end of the input");
}
