/* SPDX-License-Identifier: MIT */
/* A program that video.c starts, feeds and listens to. Waiting ends early when the program is
   interrupted (interrupt.h). */
#ifndef HD_SYSTEM_CHILD_H
#define HD_SYSTEM_CHILD_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/types.h>

#include "base/error.h"
#include "system/path.h"

enum { HD_CHILD_MAX_SAID = 4096 };

/* A program at work. It leads a process group of its own, so that Ctrl-C in the terminal reaches
   only us and we decide how the film ends. */
typedef struct HdChild {
    pid_t pid;     /* 0: none, or waited for */
    int input;     /* its standard input; -1: closed */
    int output;    /* its standard output and error; -1: closed */
    bool is_stuck; /* what was waited for did not come in time */
    size_t said_length;
    char said[HD_CHILD_MAX_SAID + 1]; /* the end of its output */
} HdChild;

/* Looks for a program in PATH. HD_UNAVAILABLE where there is none. */
HdStatus hd_child_find(const char *name, char out[HD_MAX_PATH], HdError *error);

/* Starts the program arguments[0] without a shell. It is killed when this program ends, however
   that comes about, where the system can do so (Linux). `lock` is a descriptor that it and what it
   starts keep open, so that a lock of the file lasts for as long as somebody may write to it; -1:
   none. HD_UNAVAILABLE where there is no such program. */
HdStatus hd_child_start(HdChild *child, const char *const arguments[], bool with_input, int lock,
                        HdError *error);

/* Sends everything; false where the child no longer reads, or is stuck: for so long it took nothing
   and said nothing. Output is taken in meanwhile, so that neither side waits for the other for
   ever. */
bool hd_child_send(HdChild *child, const uint8_t *bytes, size_t size, int timeout_ms);

/* Ends the input and waits for the child, which is killed when an interrupt comes or it is stuck:
   for so long it neither said anything nor ended. Describes in `how` how it ended; true for exit
   code 0. */
bool hd_child_end(HdChild *child, int timeout_ms, char how[64]);

/* Kills it if it runs, and closes its channels. */
void hd_child_stop(HdChild *child);

/* Its last words without line breaks at their end. */
const char *hd_child_said(HdChild *child);

#endif
