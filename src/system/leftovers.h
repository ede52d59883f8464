/* SPDX-License-Identifier: MIT */
/* What must not outlive the program, even where a signal ends it at once: temporary files and
 * programs that it started. */
#ifndef HD_SYSTEM_LEFTOVERS_H
#define HD_SYSTEM_LEFTOVERS_H

#include <sys/types.h>

/* Remember a file that exists, and the leader of a process group. One that finds no room, or a name
   of HD_MAX_PATH bytes, is not remembered. */
void hd_leftovers_add_file(const char *path);
void hd_leftovers_add_group(pid_t leader);

/* Forget them again, which is no mistake where they are not known. */
void hd_leftovers_forget_file(const char *path);
void hd_leftovers_forget_group(pid_t leader);

/* Kills the groups and removes the files, each once. May be called by a signal's handler, at any
   moment and in any thread. */
void hd_leftovers_remove(void);

#endif
