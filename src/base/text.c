/* SPDX-License-Identifier: MIT */
#include "base/text.h"

#include <limits.h>
#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/minmax.h"

/* bytes of the longest of \u001b, \x9b and a UTF-8 character */
enum { MAX_PIECE_BYTES = 6 };

/* Returns the length in bytes of the first character of `text` and sets its code point; 0 if it is
   not UTF-8. */
static size_t read_character(const char *text, unsigned *number) {
    const unsigned char first = (unsigned char)text[0];
    const size_t size = first < 0x80 ? 1 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
    static const unsigned min_code_points[] = {0, 0, 0x80, 0x800, 0x10000};
    if ((first >= 0x80 && first < 0xc2) || first > 0xf4)
        return 0;
    *number = size == 1 ? first : first & (0xffu >> (size + 1));
    for (size_t i = 1; i < size; i++) {
        if (((unsigned char)text[i] & 0xc0) != 0x80)
            return 0;
        *number = *number << 6 | ((unsigned char)text[i] & 0x3f);
    }
    const bool is_surrogate = *number >= 0xd800 && *number < 0xe000;
    return *number < min_code_points[size] || *number > 0x10ffff || is_surrogate ? 0 : size;
}

static bool is_control(unsigned number) {
    return number < 0x20 || (number >= 0x7f && number < 0xa0) ||
           (number >= 0x2028 && number <= 0x202e) || (number >= 0x2066 && number <= 0x2069);
}

size_t hd_control_bytes(const char *text) {
    unsigned number;
    const size_t size = text[0] != '\0' ? read_character(text, &number) : 0;
    return size > 0 && is_control(number) ? size : 0;
}

/* Writes the escaped form of the next character; returns the bytes of `text` it stands for. */
static size_t escape_character(const char *text, const char *kept,
                               char piece[MAX_PIECE_BYTES + 1]) {
    unsigned number;
    const size_t size = read_character(text, &number);
    if (size == 0)
        snprintf(piece, MAX_PIECE_BYTES + 1, "\\x%02x", (unsigned)(unsigned char)*text);
    else if (is_control(number) && strchr(kept, *text) == NULL)
        snprintf(piece, MAX_PIECE_BYTES + 1, "\\u%04x", number & 0xffff);
    else
        snprintf(piece, MAX_PIECE_BYTES + 1, "%.*s", (int)size, text);
    return size > 0 ? size : 1;
}

static size_t escape(const char *text, const char *kept, char *out, size_t size) {
    size_t taken = 0, used = 0;
    while (text[taken] != '\0') {
        char piece[MAX_PIECE_BYTES + 1];
        const size_t bytes = escape_character(text + taken, kept, piece), length = strlen(piece);
        if (used + length >= size)
            break;
        memcpy(out + used, piece, length);
        used += length;
        taken += bytes;
    }
    out[used] = '\0';
    return taken;
}

size_t hd_escape(const char *text, char *out, size_t size) {
    return escape(text, "", out, size);
}

void hd_escape_lines(const char *text, char *out, size_t size) {
    escape(text, "\n\t", out, size);
}

void hd_exact_number(double value, char out[HD_NUMBER_SIZE]) {
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(out, HD_NUMBER_SIZE, "%.*g", digits, value);
        if (strtod(out, NULL) == value)
            break;
    }
    if (value == 0.0 && signbit(value)) /* printed as an integer, -0 would become 0 */
        snprintf(out, HD_NUMBER_SIZE, "-0.0");
}

void hd_short_number(double value, char out[HD_NUMBER_SIZE]) {
    snprintf(out, HD_NUMBER_SIZE, "%g", value);
    if (strtod(out, NULL) != value)
        hd_exact_number(value, out);
    char *exponent = strchr(out, 'e');
    if (exponent == NULL)
        return;
    char *digits = exponent + 1;
    if (*digits == '-')
        exponent++;
    while (*digits == '+' || *digits == '-' || *digits == '0')
        digits++;
    memmove(exponent + 1, digits, strlen(digits) + 1);
}

const char *hd_plural(int count) {
    return count == 1 ? "" : "s";
}

void hd_add_text(char *text, size_t size, const char *separator, const char *format, ...) {
    va_list arguments;
    size_t length = strlen(text);
    if (length > 0)
        length += (size_t)snprintf(text + length, size - length, "%s", separator);
    if (length >= size)
        return;
    va_start(arguments, format);
    vsnprintf(text + length, size - length, format, arguments);
    va_end(arguments);
}

enum { MAX_LETTERS = 31 };

/* Returns the edit distance of two words: letters inserted, deleted, replaced or swapped with a
   neighbour (R. A. Wagner and M. J. Fischer, The string-to-string correction problem, 1974). The
   table holds the distances of their prefixes. Longer words are far from all others. */
static int edit_distance(const char *a, const char *b) {
    size_t a_length = strlen(a), b_length = strlen(b);
    int table[MAX_LETTERS + 1][MAX_LETTERS + 1];
    if (a_length > MAX_LETTERS || b_length > MAX_LETTERS)
        return INT_MAX;
    for (size_t i = 0; i <= a_length; i++) {
        for (size_t j = 0; j <= b_length; j++) {
            if (i == 0 || j == 0) {
                table[i][j] = (int)(i + j);
                continue;
            }
            int replaced = table[i - 1][j - 1] + (a[i - 1] != b[j - 1]);
            table[i][j] = hd_min(replaced, hd_min(table[i - 1][j], table[i][j - 1]) + 1);
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                table[i][j] = hd_min(table[i][j], table[i - 2][j - 2] + 1);
        }
    }
    return table[a_length][b_length];
}

void hd_nearest_offer(HdNearest *nearest, const char *name) {
    int distance = edit_distance(nearest->word, name);
    if (distance <= hd_max((int)strlen(name) / 3, 1) &&
        (nearest->name == NULL || distance < nearest->distance)) {
        nearest->name = name;
        nearest->distance = distance;
    }
}
