/* SPDX-License-Identifier: MIT */
#include "base/text.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

/* The longest of \u001b, \x9b and a character of UTF-8. */
enum { LONGEST_PIECE = 6 };

static bool continues_character(char c) {
    return ((unsigned char)c & 0xc0) == 0x80;
}

/* The bytes of the character that `text` begins with, and its number; 0: that is no UTF-8. */
static size_t read_character(const char *text, unsigned *number) {
    const unsigned char first = (unsigned char)text[0];
    const size_t size = first < 0x80 ? 1 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
    static const unsigned least[] = {0, 0, 0x80, 0x800, 0x10000};
    if ((first >= 0x80 && first < 0xc2) || first > 0xf4)
        return 0;
    *number = size == 1 ? first : first & (0xffu >> (size + 1));
    for (size_t i = 1; i < size; i++) {
        if (!continues_character(text[i]))
            return 0;
        *number = *number << 6 | ((unsigned char)text[i] & 0x3f);
    }
    const bool is_surrogate = *number >= 0xd800 && *number < 0xe000;
    return *number < least[size] || *number > 0x10ffff || is_surrogate ? 0 : size;
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

/* Writes what stands for the next character and returns how many bytes of `text` that takes. */
static size_t make_piece(const char *text, const char *kept, char piece[LONGEST_PIECE + 1]) {
    unsigned number;
    const size_t size = read_character(text, &number);
    if (size == 0)
        snprintf(piece, LONGEST_PIECE + 1, "\\x%02x", (unsigned)(unsigned char)*text);
    else if (is_control(number) && strchr(kept, *text) == NULL)
        snprintf(piece, LONGEST_PIECE + 1, "\\u%04x", number & 0xffff);
    else
        snprintf(piece, LONGEST_PIECE + 1, "%.*s", (int)size, text);
    return size > 0 ? size : 1;
}

static size_t escape(const char *text, const char *kept, char *out, size_t size) {
    size_t taken = 0, used = 0;
    while (text[taken] != '\0') {
        char piece[LONGEST_PIECE + 1];
        const size_t bytes = make_piece(text + taken, kept, piece), length = strlen(piece);
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
