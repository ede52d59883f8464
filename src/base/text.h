/* SPDX-License-Identifier: MIT */
/* Text of others, fit to be shown: nothing in it steers a terminal, moves what stands around it, or
   is invisible for want of being UTF-8. */
#ifndef HD_BASE_TEXT_H
#define HD_BASE_TEXT_H

#include <stddef.h>

/* How many bytes the control character takes that `text` begins with: 1 below U+0020 and for
   U+007F, 2 for U+0080 to U+009F in UTF-8, 3 for those that turn the direction of writing (U+202A
   to U+202E, U+2066 to U+2069) or end a line (U+2028, U+2029); 0: it begins with none. */
size_t hd_control_bytes(const char *text);

/* Copies `text` with each control character as \u001b and each byte that is not UTF-8 as \x9b; cut
   to `size` bytes with the zero byte, never within a character. Returns how many bytes of `text`
   that took. What it wrote it copies unchanged. */
size_t hd_escape(const char *text, char *out, size_t size);

/* The same, but line breaks and tabs stay. */
void hd_escape_lines(const char *text, char *out, size_t size);

#endif
