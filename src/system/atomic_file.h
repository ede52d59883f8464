/* SPDX-License-Identifier: MIT */
/* Files that get their name only when they are complete, and then survive a power failure. */
#ifndef HD_SYSTEM_ATOMIC_FILE_H
#define HD_SYSTEM_ATOMIC_FILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "base/error.h"
#include "system/path.h"

/* durability of a file once it has its name */
typedef enum HdDurability { HD_WITHOUT_SYNC, HD_DURABLE } HdDurability;

/* A locked file under its temporary name "NAME.tmp-PID-N" in the same folder; no other process uses
   it. It is removed when the program ends (interrupt.h). If the program is killed, the free lock
   shows that the file is stale. */
typedef struct HdAtomicFile {
    FILE *stream; /* stream to write to; NULL: closed */
    int lock;     /* descriptor when there is no stream; -1: renamed or removed */
    char path[HD_MAX_PATH];
    char temporary[HD_MAX_PATH];
} HdAtomicFile;

/* Creates the file and missing folders, but not a folder that existed earlier in the run. Refuses a
   `path` that names a folder or a device, because renaming would replace it. After a failure there
   is nothing to discard. */
HdStatus hd_atomic_file_open(HdAtomicFile *file, const char *path, HdError *error);

/* As hd_atomic_file_open, for a file that only this user may read and write. */
HdStatus hd_atomic_file_open_private(HdAtomicFile *file, const char *path, HdError *error);

/* As hd_atomic_file_open without a stream: another program writes to `temporary`, and may replace
   it. */
HdStatus hd_atomic_file_reserve(HdAtomicFile *file, const char *path, HdError *error);

/* Returns HD_FAILED, with the reason, if the temporary file or its folder was removed. */
HdStatus hd_atomic_file_check(const HdAtomicFile *file, HdError *error);

/* The three steps to the final name: close the stream, sync the bytes to the disk (optional),
   rename. If a step or an earlier write failed, the temporary file is removed. An existing file at
   `path` is then untouched. */
HdStatus hd_atomic_file_close(HdAtomicFile *file, HdError *error);
HdStatus hd_atomic_file_sync(HdAtomicFile *file, HdError *error);
HdStatus hd_atomic_file_publish(HdAtomicFile *file, HdError *error);

/* Performs all steps; HD_DURABLE also syncs the file and its folders. */
HdStatus hd_atomic_file_commit(HdAtomicFile *file, HdDurability durability, HdError *error);

/* Closes and removes the temporary file. Does nothing after the last step or a failed one. */
void hd_atomic_file_discard(HdAtomicFile *file);

/* Blocks until the bytes of an open file are on the disk; `path` is for messages. Returns HD_FAILED
   if the disk reports an error. Returns at once for a pipe and others that cannot be synced. */
HdStatus hd_sync_file(int descriptor, const char *path, HdError *error);

/* Blocks until the name of the file `path` is on the disk. Syncs its folder and those above it,
   which may be new, up to one that this run synced already. Skips folders that this user may not
   read, which somebody else created. */
HdStatus hd_sync_folder(const char *path, HdError *error);

/* Forgets the existing and synced folders at the start of another run. */
void hd_known_folders_forget(void);

/* bytes of the final name that a temporary name keeps at most, without the folder */
enum { HD_TEMPORARY_MAX_KEPT = 200 };

/* Returns how many bytes of `name`, without its folder, belong to the final name; 0 if it is not
   the name of a temporary file. */
size_t hd_temporary_name_length(const char *name);

/* Removes a file with a temporary name unless a process has locked it. Returns false if a later
   attempt may succeed: the writer in the name is gone, but a program that it started still holds
   the lock. That program ends when its input does. */
bool hd_temporary_remove_stale(const char *temporary);

#endif
