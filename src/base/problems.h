/* SPDX-License-Identifier: MIT */
/* Everything that is wrong with an input, gathered so that one message can tell all of it. */
#ifndef HD_BASE_PROBLEMS_H
#define HD_BASE_PROBLEMS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "base/error.h"

/* Start with all zeros. Lines beyond the room are counted, not kept. */
typedef struct HdProblems {
    int count;
    size_t used;
    char text[16384]; /* a line for each problem */
} HdProblems;

/* Adds one problem: a sentence without a full stop that names the place, the value and what was
   expected. It becomes one line: line breaks are escaped too (text.h). */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
void hd_problem(HdProblems *problems, const char *format, ...);

/* Whether so many were added that none of those to come will be told: where looking for more is
   dear, `count` alone may be raised. */
bool hd_problems_are_full(const HdProblems *problems);

/* HD_OK where nothing was found. Otherwise HD_BAD_INPUT and the first problem. */
HdStatus hd_problems_first(const HdProblems *problems, HdError *error);

/* HD_OK where nothing was found. Otherwise HD_BAD_INPUT and "name: problem", or, for more than one,
   "name: 3 problems" followed by a line for each, indented. */
HdStatus hd_problems_status(const HdProblems *problems, const char *name, HdError *error);

/* Writes each as a line of its own, which begins with the two texts. */
void hd_problems_print(const HdProblems *problems, FILE *out, const char *name, const char *kind);

#endif
