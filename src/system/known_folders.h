/* SPDX-License-Identifier: MIT */
/* The folders that this run has written to, so that one that goes away is missed instead of made
   anew without what was in it. */
#ifndef HD_SYSTEM_KNOWN_FOLDERS_H
#define HD_SYSTEM_KNOWN_FOLDERS_H

#include <stdbool.h>

/* Remembers the folder of the file `path`; of many only the last few. */
void hd_known_folders_add(const char *path);

/* True where the folder of the file `path` is remembered. */
bool hd_known_folders_has(const char *path);

/* Forgets all: another run begins. */
void hd_known_folders_forget(void);

#endif
