/* SPDX-License-Identifier: MIT */
/* Statuses and messages of failed calls, and lists of problems found in an input. */
#ifndef HD_BASE_ERROR_H
#define HD_BASE_ERROR_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* A status is also the program's exit code. */
typedef enum HdStatus {
    HD_OK = 0,
    HD_FAILED = 1,      /* the work failed: full disk, failed FFmpeg, too little memory */
    HD_BAD_INPUT = 2,   /* wrong usage or wrong input */
    HD_UNAVAILABLE = 3, /* a backend or device is missing or cannot do what was asked */
    HD_INTERRUPTED = 130
} HdStatus;

/* The last failure. `message` is one sentence without a final line break; a compiler's log may
   follow on further lines. */
typedef struct HdError {
    HdStatus status;
    char message[32768];
} HdError;

/* Fills `error` and returns `status`, so that a caller can write `return hd_fail(...)`. Cuts a
   message that is too long. Escapes control characters except line breaks and tabs, and bytes that
   are not UTF-8 (text.h): the text may come from a file. */
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
HdStatus
hd_fail(HdError *error, HdStatus status, const char *format, ...);

/* Returns from the calling function with the status of `call` unless that is HD_OK. For functions
   with nothing to release. */
#define HD_TRY(call)                                                                               \
    do {                                                                                           \
        const HdStatus tried_ = (call);                                                            \
        if (tried_ != HD_OK)                                                                       \
            return tried_;                                                                         \
    } while (0)

/* Fails because memory is short for the object that a literal printf format and its arguments
   describe. */
#define HD_NO_ROOM(error, ...) hd_fail(error, HD_FAILED, "out of memory: no room for " __VA_ARGS__)

/* Prefixes the message of `error` with `name` and a colon; cuts it if it gets too long. */
void hd_error_prefix(HdError *error, const char *name);

/* ---- the problems of an input, collected for one message ---- */

/* Zero-initialise. Lines beyond the capacity are counted, not kept. */
typedef struct HdProblems {
    int count;
    size_t used;
    char text[16384]; /* one line for each problem */
} HdProblems;

/* Adds one problem: a sentence without a full stop that names the place, the value and the expected
   value. It becomes one line: line breaks are escaped too (text.h). */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
void hd_problem(HdProblems *problems, const char *format, ...);

/* Returns whether further problems can no longer be listed. Callers may then only raise `count` if
   the search is expensive. */
bool hd_problems_are_full(const HdProblems *problems);

/* Returns HD_OK if there is no problem, otherwise HD_BAD_INPUT and the first problem. */
HdStatus hd_problems_first(const HdProblems *problems, HdError *error);

/* Returns HD_OK if there is no problem, otherwise HD_BAD_INPUT. The message is "name: problem" for
   one, and "name: 3 problems" with an indented line for each for several. */
HdStatus hd_problems_status(const HdProblems *problems, const char *name, HdError *error);

/* Writes each problem as one line that starts with `name` and `kind`. */
void hd_problems_print(const HdProblems *problems, FILE *out, const char *name, const char *kind);

/* ---- faults of a file that its reader passes over ---- */

enum { HD_MAX_FAULT_KINDS = 32 };

/* The first fault of each kind, and their number. Zero-initialise. */
typedef struct HdFaults {
    int kind_count;
    struct {
        const char *kind;
        size_t count;
        char first[1024];
    } kinds[HD_MAX_FAULT_KINDS];
} HdFaults;

/* Adds `count` faults of a kind, a text that lasts; the format describes the first one. */
#if defined(__GNUC__)
__attribute__((format(printf, 4, 5)))
#endif
void hd_fault(HdFaults *faults, const char *kind, size_t count, const char *format, ...);

/* Adds a problem for each kind, in the order of their first faults: "NAME: fault (3 times)". The
   name may be NULL. */
void hd_faults_report(const HdFaults *faults, const char *name, HdProblems *problems);

#endif
