/* SPDX-License-Identifier: MIT */
#include "input/tokens.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"

typedef struct Token {
    char text[HD_MAX_PATH];
} Token;

static bool is_space(char c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
}
static bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

/* The start of a token, fit for a message. */
static const char *shown(const char *token, char out[44]) {
    const size_t taken = hd_escape(token, out, 41), length = strlen(out);
    snprintf(out + length, 4, "%s", token[taken] != '\0' ? "..." : "");
    return out;
}

#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
static void
refuse(HdTokenReader *reader, const char *what, const char *format, ...) {
    char text[160];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    reader->status = hd_fail(reader->error, HD_BAD_INPUT, "%s:%d: %s%s %s", reader->name,
                             reader->line, reader->where, what, text);
}

static void fail_token(HdTokenReader *reader, const char *what, const Token *token,
                       const char *expected) {
    char value[44];
    refuse(reader, what, "is '%s', expected %s", shown(token->text, value), expected);
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
                       Token *token) {
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
    else if (length >= sizeof token->text)
        refuse(reader, what, "has %zu characters, expected at most %d", length, HD_MAX_PATH - 1);
    else if (memchr(start, '\0', length) != NULL)
        refuse(reader, what, "holds a zero byte, expected %s", expected);
    if (reader->status != HD_OK)
        return false;
    memcpy(token->text, start, length);
    token->text[length] = '\0';
    return true;
}

static const char *skip_digits(const char *s) {
    while (is_digit(*s))
        s++;
    return s;
}

static const char *skip_sign(const char *s) {
    return *s == '+' || *s == '-' ? s + 1 : s;
}

/* Decimal notation only: strtod alone would take hexadecimal numbers, "nan" and "inf" too. */
static bool is_decimal(const char *s) {
    const char *start = skip_sign(s);
    const char *end = skip_digits(start);
    size_t digits = (size_t)(end - start);
    if (*end == '.') {
        start = end + 1;
        end = skip_digits(start);
        digits += (size_t)(end - start);
    }
    if (digits == 0)
        return false;
    if (*end == 'e' || *end == 'E') {
        start = skip_sign(end + 1);
        end = skip_digits(start);
        if (end == start)
            return false;
    }
    return *end == '\0';
}

static bool is_integer(const char *s) {
    const char *start = skip_sign(s);
    const char *end = skip_digits(start);
    return end != start && *end == '\0';
}

/* The number, or NaN after a failure. */
static double next_number(HdTokenReader *reader, const char *what) {
    static const char *const expected = "a number";
    Token token;
    if (!read_token(reader, what, expected, &token))
        return (double)NAN;
    if (!is_decimal(token.text)) {
        fail_token(reader, what, &token, expected);
        return (double)NAN;
    }
    const double number = strtod(token.text, NULL);
    if (isinf(number))
        fail_token(reader, what, &token, "a number within the range of double precision");
    return number;
}

void hd_read_number(HdTokenReader *reader, const char *what, double *value) {
    const double number = next_number(reader, what);
    if (reader->status == HD_OK)
        *value = number;
}

void hd_read_share(HdTokenReader *reader, const char *what, double *value) {
    const double number = next_number(reader, what);
    if (reader->status != HD_OK)
        return;
    if (number >= 0.0 && number <= 1.0)
        *value = number;
    else
        refuse(reader, what, "is %.15g, expected a number from 0 to 1", number);
}

void hd_read_int(HdTokenReader *reader, const char *what, int low, int high, int *value) {
    char expected[64];
    Token token;
    snprintf(expected, sizeof expected, "a whole number from %d to %d", low, high);
    if (!read_token(reader, what, expected, &token))
        return;
    errno = 0;
    const long number = is_integer(token.text) ? strtol(token.text, NULL, 10) : 0;
    if (errno != 0 || !is_integer(token.text) || number < low || number > high)
        fail_token(reader, what, &token, expected);
    else
        *value = (int)number;
}

void hd_read_path(HdTokenReader *reader, const char *what, char path[HD_MAX_PATH]) {
    Token token;
    if (read_token(reader, what, "a path", &token))
        memcpy(path, token.text, strlen(token.text) + 1);
}

void hd_read_end(HdTokenReader *reader) {
    static const char *const what = "what follows the last value";
    Token token;
    if (reader->status != HD_OK)
        return;
    skip_space(reader);
    if (reader->position < reader->size && read_token(reader, what, "the end of the input", &token))
        fail_token(reader, what, &token, "the end of the input");
}
