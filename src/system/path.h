/* SPDX-License-Identifier: MIT */
/* Names of files: the home folder, missing folders, numbered sequences; and whole files in memory.
 */
#ifndef HD_SYSTEM_PATH_H
#define HD_SYSTEM_PATH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <sys/stat.h>
#include <sys/types.h>

#include "base/error.h"

enum { HD_MAX_PATH = 4096 };

/* Copies `path` to `out`, a leading "~" or "~/" replaced by the home folder (HOME, else the user
   database). "~name" is left as it is. */
HdStatus hd_path_expand_home(const char *path, char out[HD_MAX_PATH], HdError *error);

/* True where both names stand for the same file, by whatever spelling or link; neither need exist.
 */
bool hd_path_is_same(const char *first, const char *second);

/* True where `path` ends in `ending`, such as ".png", in upper or lower case. */
bool hd_path_has_ending(const char *path, const char *ending);

/* What of `path` is before the name, with the slash. */
size_t hd_folder_length(const char *path);

/* The folder that the running program's file is in. False where the system does not tell. */
bool hd_path_of_program(char out[HD_MAX_PATH]);

/* Calls `visit` with the name of each entry of a folder, which is empty for the current one or ends
   in a slash; not at all where it cannot be read. */
void hd_path_visit(const char *folder, void (*visit)(void *context, const char *name),
                   void *context);

/* Makes every missing folder above the file `path`, with these permissions, less what the umask
   takes. */
HdStatus hd_path_make_parents(const char *path, unsigned mode, HdError *error);

/* True where `path` holds a frame number: "%d", "%0Nd" with N from 1 to 9, or a run of 1 to 9 "#",
   which counts its digits. */
bool hd_pattern_has_number(const char *path);

/* Checks a pattern: exactly one frame number; "%%" stands for a percent sign; anything else after a
   percent sign is wrong, and so is a longer run of "#". The pattern never reaches printf. */
HdStatus hd_pattern_check(const char *pattern, HdError *error);

/* Writes the name of a file without a frame number, in which "%%" stands for a percent sign. */
HdStatus hd_pattern_format_single(const char *name, char out[HD_MAX_PATH], HdError *error);

/* Writes the name of one frame of a checked pattern. */
HdStatus hd_pattern_format(const char *pattern, int frame, char out[HD_MAX_PATH], HdError *error);

/* Opens a regular file for reading, without waiting at a named pipe; children do not get it.
   NULL: it cannot be read, and `*reason` says why. `found` is 0 unless something is there. */
FILE *hd_file_open(const char *path, struct stat *found, const char **reason);

/* Reads `size` bytes unless the file ends before, whatever signals come; returns how many these
   are, or -1 and errno. */
ssize_t hd_read_fully(int descriptor, void *bytes, size_t size);

/* Reads a regular file of at most `most` bytes; never waits for a pipe. `*bytes` is the caller's to
   free, and NULL on failure; of an empty file it is a place to free too. Messages call the file
   `what` and its path, as "cannot read the scene a.json: ...". */
HdStatus hd_file_read(const char *path, const char *what, int64_t most, unsigned char **bytes,
                      size_t *size, HdError *error);

#endif
