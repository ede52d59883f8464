/* SPDX-License-Identifier: MIT */
/* File names: the home folder, missing folders, numbered sequences; and reading whole files. */
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

/* Copies `path` to `out`, with the home folder (HOME, else the user database) for a leading "~" or
   "~/". Leaves "~name" unchanged. */
HdStatus hd_path_expand_home(const char *path, char out[HD_MAX_PATH], HdError *error);

/* Returns whether both names denote the same file, however spelt or linked; neither need exist. */
bool hd_path_is_same(const char *first, const char *second);

/* Returns whether `path` ends in `ending`, such as ".png", in upper or lower case. */
bool hd_path_has_ending(const char *path, const char *ending);

/* Returns the length of the folder in `path`, slash included. */
size_t hd_folder_length(const char *path);

/* Finds the folder of the running program's file. Returns false if the system does not report
   it. */
bool hd_path_of_program(char out[HD_MAX_PATH]);

/* Calls `visit` with the name of each entry of a folder: "" for the current one, else with a final
   slash. Visits nothing if the folder cannot be read. */
void hd_path_visit(const char *folder, void (*visit)(void *context, const char *name),
                   void *context);

/* Creates every missing folder above the file `path` with mode `mode`, before the umask. */
HdStatus hd_path_make_parents(const char *path, unsigned mode, HdError *error);

/* Returns whether `path` holds a frame number: "%d", "%0Nd" with N from 1 to 9, or, in the file's
   own name, 1 to 9 "#" for as many digits. */
bool hd_pattern_has_number(const char *path);

/* Returns whether `path` holds "%d" or "%0Nd". */
bool hd_pattern_has_directive(const char *path);

/* Checks a pattern: exactly one frame number; "%%" is a percent sign, "%#" a "#". Rejects other
   directives and longer runs of "#". The pattern never reaches printf. */
HdStatus hd_pattern_check(const char *pattern, HdError *error);

/* Writes the name of a file without a frame number; "%%" and "%#" become their second character. */
HdStatus hd_pattern_format_single(const char *name, char out[HD_MAX_PATH], HdError *error);

/* Writes the name of one frame of a checked pattern. */
HdStatus hd_pattern_format(const char *pattern, int frame, char out[HD_MAX_PATH], HdError *error);

/* Opens a regular file for reading, without blocking on a named pipe; children do not inherit it.
   Returns NULL on failure, with `*reason`. `found` is 0 if nothing exists there. */
FILE *hd_file_open(const char *path, struct stat *found, const char **reason);

/* Reads `size` bytes, or up to the end of the file, across signals. Returns the bytes read, or -1
   and errno. */
ssize_t hd_read_fully(int descriptor, void *bytes, size_t size);

/* Reads a regular file of at most `max_bytes` bytes; never blocks on a pipe. The caller frees
   `*bytes`, which is NULL on failure only. Messages name the file by `what` and its path: "cannot
   read the scene a.json: ...". */
HdStatus hd_file_read(const char *path, const char *what, int64_t max_bytes, unsigned char **bytes,
                      size_t *size, HdError *error);

#endif
