/* SPDX-License-Identifier: MIT */
/* The program's signals: SIGINT, SIGTERM and SIGHUP become a question that the work asks. And what
   must not outlive the program, even where a signal ends it at once: temporary files and programs
   that it started. */
#ifndef HD_SYSTEM_INTERRUPT_H
#define HD_SYSTEM_INTERRUPT_H

#include <stdbool.h>
#include <sys/types.h>

#include "base/error.h"

/* Catches the three, unless they are ignored. The first one is remembered; another one half a
   second later or more ends the program at once, leaving nothing half-done behind (see below).
   What comes sooner is the same wish, sent twice: to the program and to its group. Where the
   program has not ended 1.5 s after the first one, whatever it waits for, it is ended in the same
   way. A file that grows past its limit and a reader that went away become errors of write instead
   of a death, and children can be waited for whatever the parent process had set. */
void hd_interrupt_install(void);

/* Other seconds than 1.5 where the environment has HEDRON_STOP_PATIENCE; HD_BAD_INPUT where that is
   no time. */
HdStatus hd_interrupt_read_timeout(HdError *error);

/* The number of the signal that came, or 0. */
int hd_interrupt_signal(void);

/* Waits, on whatever thread the signal comes, until a write of a few hundred bytes will not block,
   because there is room or because it will fail; false where an interrupt came first. */
bool hd_wait_to_write(int descriptor);

/* What the first signal writes to standard error at once; NULL: nothing. The text must live on. */
void hd_interrupt_announce(const char *text);

/* Remember a file that exists, and the leader of a process group. One that finds no room, or a name
   of HD_MAX_PATH bytes, is not remembered. */
void hd_cleanup_add_file(const char *path);
void hd_cleanup_add_group(pid_t leader);

/* Forget them again, which is no mistake where they are not known. */
void hd_cleanup_forget_file(const char *path);
void hd_cleanup_forget_group(pid_t leader);

/* Kills the groups and removes the files, each once. May be called by a signal's handler, at any
   moment and in any thread. */
void hd_cleanup_remove(void);

#endif
