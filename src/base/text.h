/* SPDX-License-Identifier: MIT */
/* What messages are made of: text of others, numbers, and the name that somebody may have meant. */
#ifndef HD_BASE_TEXT_H
#define HD_BASE_TEXT_H

#include <stddef.h>

/* ---- text of others, fit to be shown ----
   Nothing in it steers a terminal, moves what stands around it, or is invisible for want of being
   UTF-8. */

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

enum { HD_NUMBER_SIZE = 32 };

/* As text with as few digits, 15 to 17, as it takes to read the same double back; 0's sign is kept.
 */
void hd_exact_number(double value, char out[HD_NUMBER_SIZE]);

/* The same for messages, which say 1e12 rather than 1000000000000. */
void hd_short_number(double value, char out[HD_NUMBER_SIZE]);

/* What a word for that many things ends in: "s", or nothing for one. */
const char *hd_plural(int count);

/* Appends what printf would print, after the separator unless the text is empty; cut to `size`
   bytes with the zero byte. */
__attribute__((format(printf, 4, 5))) void
hd_add_text(char *text, size_t size, const char *separator, const char *format, ...);

/* Keeps the nearest of the names that are offered one after the other. Start with the word alone.
 */
typedef struct HdNearest {
    const char *word;
    const char *name; /* NULL: nothing is near */
    int distance;
} HdNearest;

/* A name is near where at most a third of its letters, and at least one, would have to change. Of
   two that are equally near the first stays. */
void hd_nearest_offer(HdNearest *nearest, const char *name);

#endif
