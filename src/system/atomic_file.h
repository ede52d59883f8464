/* SPDX-License-Identifier: MIT */
/* Files that appear under their name only once they are complete. */
#ifndef HD_SYSTEM_ATOMIC_FILE_H
#define HD_SYSTEM_ATOMIC_FILE_H

#include <stddef.h>
#include <stdio.h>

#include "base/error.h"
#include "system/path.h"

/* Permissions of a file, from its first instant on, less what the umask takes. */
enum { HD_MODE_USUAL = 0666, HD_MODE_PRIVATE = 0600 };

/* Makes missing folders, but not one that was there earlier in the run and is gone, and an empty
   file beside `path`, "NAME.tmp-PID-N", that no other process uses. It does not outlive the program
   (leftovers.h), unless that is killed; then the descriptor, by which the file is locked, tells
   that it may be removed. The caller closes the descriptor, once the file has its final name. A
   `path` that stands for a folder or a device is refused, because renaming would replace it. */
HdStatus hd_temporary_create(const char *path, unsigned mode, char temporary[HD_MAX_PATH],
                             int *descriptor, HdError *error);

/* HD_FAILED where somebody removed the temporary file, or its folder, which the message tells. */
HdStatus hd_temporary_check(const char *temporary, const char *path, HdError *error);

void hd_temporary_remove(const char *temporary);

/* Of a longer name than this, without its folder, a temporary file's name has only the begin. */
enum { HD_TEMPORARY_MOST_KEPT = 200 };

/* How much of `name`, without its folder, is what a temporary file keeps of the final name; 0: it
   is not the name of a temporary file. */
size_t hd_temporary_name_length(const char *name);

/* Removes a temporary file that no process has locked. Where its writer, the process in its name,
   is gone and something that it started has the lock, waits for that up to 10 s, or an interrupt.
   The name must be one of a temporary file. */
void hd_temporary_remove_stale(const char *temporary);

/* Renames the temporary file to its final name; removes it where that fails. */
HdStatus hd_temporary_publish(const char *temporary, const char *path, HdError *error);

/* Forgets the folders that were there earlier in the run: another run begins. */
void hd_known_folders_forget(void);

typedef struct HdAtomicFile {
    FILE *stream; /* for the caller to write to; NULL: closed */
    int lock;     /* a descriptor, once the stream is closed; -1: it has its name, or is gone */
    char path[HD_MAX_PATH];
    char temporary[HD_MAX_PATH];
} HdAtomicFile;

HdStatus hd_atomic_file_open(HdAtomicFile *file, const char *path, HdError *error);

/* The same for a file that only this user may read and write. */
HdStatus hd_atomic_file_open_private(HdAtomicFile *file, const char *path, HdError *error);

/* The three steps to the final name. After one that failed, a write that failed earlier included,
   the temporary file is gone and a file that was there before is untouched. Closing the stream
   comes first; syncing, which waits until the bytes are on the disk (durable.h), may be left out.
 */
HdStatus hd_atomic_file_close(HdAtomicFile *file, HdError *error);
HdStatus hd_atomic_file_sync(HdAtomicFile *file, HdError *error);
HdStatus hd_atomic_file_publish(HdAtomicFile *file, HdError *error);

/* Whether a file outlives a power cut once it has its name. */
typedef enum HdDurability { HD_FLEETING, HD_DURABLE } HdDurability;

/* All steps; HD_DURABLE: with the syncing of the file and of its folders. */
HdStatus hd_atomic_file_commit(HdAtomicFile *file, HdDurability durability, HdError *error);

/* Closes and removes the temporary file; after the last step, or one that failed, nothing is left
   to be done. */
void hd_atomic_file_discard(HdAtomicFile *file);

#endif
