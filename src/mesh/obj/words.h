/* SPDX-License-Identifier: MIT */
/* Words of the lines of OBJ and MTL files. */
#ifndef HD_MESH_OBJ_WORDS_H
#define HD_MESH_OBJ_WORDS_H

#include <stdbool.h>
#include <stddef.h>

/* Some bytes of a text, up to but without `end`. */
typedef struct HdSpan {
    const char *begin, *end;
} HdSpan;

/* For "%.*s" in messages: no more bytes than a reader wants to see, and no character cut in two. */
int hd_span_shown(HdSpan span);

bool hd_span_is(HdSpan span, const char *text);

/* Takes the next word of a line; an empty one at the line's end. Words end at blanks and tabs. */
HdSpan hd_next_word(HdSpan *line);

/* The rest of a line without blanks and tabs around it. */
HdSpan hd_rest(HdSpan line);

/* What a word should have been to be a number: decimal, at most HD_MAX_NUMBER either way, not oddly
   long. NULL: it is one, and `*value` what it says, up to the rounding of a few operations; where
   the power of ten is below -19 or above 19, so that it is less than HD_MIN_LENGTH, 0. */
const char *hd_number_fault(HdSpan word, double *value);

/* What a name should have been: there, without control characters. NULL: it is. */
const char *hd_name_fault(HdSpan name);

/* What the name of a file should have been to stay in the folder that it counts from or below it.
   Backslashes count as slashes. NULL: it does. */
const char *hd_file_name_fault(HdSpan name);

/* Turns backslashes into slashes. */
void hd_fix_separators(char *name);

#endif
