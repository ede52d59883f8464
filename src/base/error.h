/* SPDX-License-Identifier: MIT */
/* What a library function tells its caller when it cannot do its work. */
#ifndef HD_BASE_ERROR_H
#define HD_BASE_ERROR_H

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

/* Puts `name` and a colon before the message of `error`, which is cut if it gets too long. */
void hd_error_prefix(HdError *error, const char *name);

#endif
