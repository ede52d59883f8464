/* SPDX-License-Identifier: MIT */
/* A flag that SIGINT, SIGTERM and SIGHUP set and the work polls; and a registry of files and
   processes to remove when the program ends, even by a signal. */
#ifndef HD_SYSTEM_INTERRUPT_H
#define HD_SYSTEM_INTERRUPT_H

#include <stdbool.h>
#include <sys/types.h>

#include "base/error.h"

/* Catches the three signals, unless they are ignored. The first one sets the flag. Another one at
   least 0.5 s later ends the program at once, after cleanup. An earlier one is the same request,
   sent to the program and to its group. If the program still runs 1.5 s after the first one, it
   ends in the same way. A file beyond its size limit and a closed reader become write errors
   instead of fatal signals. Children can be waited for, whatever the parent process configured. */
void hd_interrupt_install(void);

/* Replaces the 1.5 s by the seconds in HEDRON_STOP_PATIENCE. HD_BAD_INPUT: that is no time. */
HdStatus hd_interrupt_read_timeout(HdError *error);

/* Returns the number of the first signal, or 0. */
int hd_interrupt_signal(void);

/* Blocks until a write of a few hundred bytes would not block, whether it would succeed or fail.
   Any thread may handle the signal. Returns false on an interrupt. */
bool hd_wait_to_write(int descriptor);

/* Sets the text that the first signal writes to standard error; NULL: nothing. It must stay
   valid. */
void hd_interrupt_announce(const char *text);

/* Register an existing file, and the leader of a process group. Ignored if the registry is full or
   the name has HD_MAX_PATH bytes. */
void hd_cleanup_add_file(const char *path);
void hd_cleanup_add_group(pid_t leader);

/* Remove an entry; unknown ones are ignored. */
void hd_cleanup_forget_file(const char *path);
void hd_cleanup_forget_group(pid_t leader);

/* Kills the groups and removes the files, each once. Safe in signal handlers and in any thread. */
void hd_cleanup_remove(void);

#endif
