/* SPDX-License-Identifier: MIT */
/* A program that video.c starts, writes to and reads from. Waiting stops on an interrupt
   (interrupt.h). */
#ifndef HD_SYSTEM_CHILD_H
#define HD_SYSTEM_CHILD_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/types.h>

#include "base/error.h"
#include "system/path.h"

enum { HD_CHILD_MAX_TAIL = 4096 };

/* A running program. It leads its own process group: Ctrl-C in the terminal reaches hedron alone,
   which decides how the film ends. */
typedef struct HdChild {
    pid_t pid;     /* 0: none, or waited for */
    int input;     /* its standard input; -1: closed */
    int output;    /* its standard output and error; -1: closed */
    bool is_stuck; /* a wait timed out */
    size_t tail_length;
    char tail[HD_CHILD_MAX_TAIL + 1]; /* end of its output */
} HdChild;

/* Finds a program in PATH. HD_UNAVAILABLE: there is none. */
HdStatus hd_child_find(const char *name, char out[HD_MAX_PATH], HdError *error);

/* Starts the program arguments[0] without a shell. On Linux it is killed when this program ends,
   however it ends. `lock` is a descriptor that it and its children keep open, or -1. A lock on that
   file lasts while any of them may write to it. HD_UNAVAILABLE: there is no such program. */
HdStatus hd_child_start(HdChild *child, const char *const arguments[], bool with_input, int lock,
                        HdError *error);

/* Sends all bytes, and reads output meanwhile so that neither side blocks the other. Returns false
   if the child stopped reading, or is stuck: no input accepted and no output for `timeout_ms`. */
bool hd_child_send(HdChild *child, const uint8_t *bytes, size_t size, int timeout_ms);

/* Closes the input and waits for the child. Kills it on an interrupt, or if it neither wrote nor
   ended for `timeout_ms`. Describes its end in `how`; returns true for exit code 0. */
bool hd_child_end(HdChild *child, int timeout_ms, char how[64]);

/* Kills the child if it runs, and closes its channels. */
void hd_child_stop(HdChild *child);

/* Returns the end of its output without trailing line breaks. */
const char *hd_child_tail(HdChild *child);

#endif
