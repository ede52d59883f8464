/* SPDX-License-Identifier: MIT */
/* Files that appear under their name only once they are complete, and then outlive a power cut. */
#ifndef HD_SYSTEM_ATOMIC_FILE_H
#define HD_SYSTEM_ATOMIC_FILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "base/error.h"
#include "system/path.h"

/* Whether a file outlives a power cut once it has its name. */
typedef enum HdDurability { HD_FLEETING, HD_DURABLE } HdDurability;

/* A file under its temporary name, "NAME.tmp-PID-N" in the same folder, that no other process uses:
   it is locked. It does not outlive the program (interrupt.h), unless that is killed; then its lock
   tells that it may be removed. */
typedef struct HdAtomicFile {
    FILE *stream; /* for the caller to write to; NULL: closed */
    int lock;     /* a descriptor while there is no stream; -1: it has its name, or is gone */
    char path[HD_MAX_PATH];
    char temporary[HD_MAX_PATH];
} HdAtomicFile;

/* Makes the file, and missing folders, but not one that was there earlier in the run and is gone. A
   `path` that stands for a folder or a device is refused, because renaming would replace it. On
   failure there is nothing to be discarded. */
HdStatus hd_atomic_file_open(HdAtomicFile *file, const char *path, HdError *error);

/* The same for a file that only this user may read and write. */
HdStatus hd_atomic_file_open_private(HdAtomicFile *file, const char *path, HdError *error);

/* The same without a stream: another program writes to `temporary`, and may replace that file. */
HdStatus hd_atomic_file_reserve(HdAtomicFile *file, const char *path, HdError *error);

/* HD_FAILED where somebody removed the temporary file, or its folder, which the message tells. */
HdStatus hd_atomic_file_check(const HdAtomicFile *file, HdError *error);

/* The three steps to the final name. After one that failed, a write that failed earlier included,
   the temporary file is gone and a file that was there before is untouched. Closing the stream
   comes first; syncing, which waits until the bytes are on the disk, may be left out. */
HdStatus hd_atomic_file_close(HdAtomicFile *file, HdError *error);
HdStatus hd_atomic_file_sync(HdAtomicFile *file, HdError *error);
HdStatus hd_atomic_file_publish(HdAtomicFile *file, HdError *error);

/* All steps; HD_DURABLE: with the syncing of the file and of its folders. */
HdStatus hd_atomic_file_commit(HdAtomicFile *file, HdDurability durability, HdError *error);

/* Closes and removes the temporary file; after the last step, or one that failed, nothing is left
   to be done. */
void hd_atomic_file_discard(HdAtomicFile *file);

/* Waits until the bytes of an open file are on the disk; `path` is for the message. HD_FAILED where
   the disk says no. What no disk is behind, such as a pipe, has nothing to wait for. */
HdStatus hd_sync_file(int descriptor, const char *path, HdError *error);

/* Waits until the name of the file `path` is on the disk: syncs its folder, and those above it up
   to one for which this run did so, for they may be new. A folder that may not be read was made by
   somebody else, and is left to the system. */
HdStatus hd_sync_folder(const char *path, HdError *error);

/* Forgets the folders that were there, and synced, earlier in the run: another run begins. */
void hd_known_folders_forget(void);

/* Of a longer name than this, without its folder, a temporary file's name has only the begin. */
enum { HD_TEMPORARY_MAX_KEPT = 200 };

/* How much of `name`, without its folder, is what a temporary file keeps of the final name; 0: it
   is not the name of a temporary file. */
size_t hd_temporary_name_length(const char *name);

/* Removes a temporary file, one by its name, that no process has locked. False where that may be
   tried again soon: its writer, the process in the name, is gone, and what that had started has the
   lock until it ends for want of input. */
bool hd_temporary_remove_stale(const char *temporary);

#endif
