/* SPDX-License-Identifier: MIT */
/* Texts for messages: escaping of foreign text, numbers, and suggestions for misspelt names. */
#ifndef HD_BASE_TEXT_H
#define HD_BASE_TEXT_H

#include <stddef.h>

/* ---- escaped text: valid UTF-8 without control characters ---- */

/* Returns the length in bytes of the control character that `text` begins with, or 0. It is 1 below
   U+0020 and for U+007F, 2 for U+0080 to U+009F. It is 3 for characters of writing direction
   (U+202A to U+202E, U+2066 to U+2069) and line ends (U+2028, U+2029). */
size_t hd_control_bytes(const char *text);

/* Copies `text` with each control character as \u001b and each byte that is not UTF-8 as \x9b. Cuts
   the copy to `size` bytes, terminator included, never within a character. Returns the number of
   bytes of `text` consumed. Idempotent: escaped text is copied unchanged. */
size_t hd_escape(const char *text, char *out, size_t size);

/* As hd_escape, but keeps line breaks and tabs. */
void hd_escape_lines(const char *text, char *out, size_t size);

enum { HD_NUMBER_SIZE = 32 };

/* Formats a double with the fewest digits, 15 to 17, that read back equal. Keeps the sign of 0. */
void hd_exact_number(double value, char out[HD_NUMBER_SIZE]);

/* As hd_exact_number, shortened for messages: 1e12 instead of 1000000000000. */
void hd_short_number(double value, char out[HD_NUMBER_SIZE]);

/* Returns the plural ending for `count` things: "s", or "" for one. */
const char *hd_plural(int count);

/* Appends a formatted text, preceded by `separator` unless `text` is empty. Cuts the result to
   `size` bytes, terminator included. */
__attribute__((format(printf, 4, 5))) void
hd_add_text(char *text, size_t size, const char *separator, const char *format, ...);

/* The candidate nearest to a misspelt word. Initialise `word`, and zero the rest. */
typedef struct HdNearest {
    const char *word;
    const char *name; /* NULL: no candidate is near */
    int distance;
} HdNearest;

/* Offers a candidate. It is near if at most a third of its letters, and at least one, must change.
   Of equally near candidates the first stays. */
void hd_nearest_offer(HdNearest *nearest, const char *name);

#endif
