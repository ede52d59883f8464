/* SPDX-License-Identifier: MIT */
/* Whole files in memory. */
#ifndef HD_SYSTEM_FILE_BYTES_H
#define HD_SYSTEM_FILE_BYTES_H

#include <stddef.h>
#include <stdint.h>
#include <sys/types.h>

#include "base/error.h"

/* Reads `size` bytes unless the file ends before, whatever signals come; returns how many these
   are, or -1 and errno. */
ssize_t hd_read_fully(int descriptor, void *bytes, size_t size);

/* Reads a regular file of at most `most` bytes; never waits for a pipe. `*bytes` is the caller's to
   free, and NULL on failure; of an empty file it is a place to free too. Messages call the file
   `what` and its path, as "cannot read the scene a.json: ...". */
HdStatus hd_file_read(const char *path, const char *what, int64_t most, unsigned char **bytes,
                      size_t *size, HdError *error);

#endif
