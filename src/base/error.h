/* SPDX-License-Identifier: MIT */
/* What a library function tells its caller when it cannot do its work. */
#ifndef HD_BASE_ERROR_H
#define HD_BASE_ERROR_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* A status is also the program's exit code. */
typedef enum HdStatus {
    HD_OK = 0,
    HD_FAILED = 1,      /* the work failed: disk full, FFmpeg failed, out of memory */
    HD_BAD_INPUT = 2,   /* wrong usage or wrong input */
    HD_UNAVAILABLE = 3, /* a backend or device is missing or cannot do what was asked */
    HD_INTERRUPTED = 130
} HdStatus;

/* What failed last. The message is one sentence without a line break at its end; a compiler's log
   may follow on lines of its own. */
typedef struct HdError {
    HdStatus status;
    char message[32768];
} HdError;

/* Fills `error` and returns `status`, so that a caller can write `return hd_fail(...)`. A message
   that is too long is cut. What is no text in it, but for line breaks and tabs, is escaped
   (text.h): it may have come from a file. */
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
HdStatus
hd_fail(HdError *error, HdStatus status, const char *format, ...);

/* Leaves the calling function with the status of `call` unless that is HD_OK. For functions that
   have nothing to give up first. */
#define HD_TRY(call)                                                                               \
    do {                                                                                           \
        const HdStatus tried_ = (call);                                                            \
        if (tried_ != HD_OK)                                                                       \
            return tried_;                                                                         \
    } while (0)

/* Fails for want of memory for what follows: a literal format, as printf's, and its arguments. */
#define HD_NO_ROOM(error, ...) hd_fail(error, HD_FAILED, "out of memory: no room for " __VA_ARGS__)

/* Puts `name` and a colon before the message of `error`, which is cut if it gets too long. */
void hd_error_prefix(HdError *error, const char *name);

/* ---- everything that is wrong with an input, gathered so that one message can tell all of it ----
 */

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
