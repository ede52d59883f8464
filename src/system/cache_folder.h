/* SPDX-License-Identifier: MIT */
/* A persistent folder for results that are slow to compute: compiled kernels, measurements. The
   program works without it, whatever is wrong with it. An entry is trusted only if its checksum is
   correct and nobody but this user may write to it or the folder. Its key, a text of everything the
   entry depends on, is stored whole and compared. The folder is HEDRON_CACHE, else
   $XDG_CACHE_HOME/hedron, else $HOME/.cache/hedron if the home folder exists. HEDRON_CACHE=off
   disables it. The folder has mode 0700, its files 0600. */
#ifndef HD_SYSTEM_CACHE_FOLDER_H
#define HD_SYSTEM_CACHE_FOLDER_H

#include <stddef.h>
#include <stdint.h>

#include "base/error.h"
#include "system/path.h"

enum {
    HD_CACHE_MAX_BYTES = 128 << 20,      /* all entries; least recently used ones are removed */
    HD_CACHE_MAX_ENTRY_BYTES = 16 << 20, /* one entry, key included */
    HD_CACHE_MAX_KIND = 31               /* characters of a kind */
};

/* Returns the folder's name; it need not exist. HD_UNAVAILABLE, with the reason: none is
   configured. */
HdStatus hd_cache_folder(char folder[HD_MAX_PATH], HdError *error);

/* Reads the entry of a kind ("cuda": lower-case letters) and key. The caller frees `*bytes`,
   which is NULL on failure. HD_UNAVAILABLE: no entry or no folder. HD_FAILED: the entry is
   damaged, cut short, of another key or owner. The message names the fault; storing the entry
   again repairs it. */
HdStatus hd_cache_get(const char *kind, const char *key, unsigned char **bytes, size_t *size,
                      HdError *error);

/* Stores an entry, replacing one of the same key atomically, then removes the least recently used
   entries beyond HD_CACHE_MAX_BYTES. Several processes may do so at once. HD_UNAVAILABLE: no
   folder; HD_FAILED: it is not writable. */
HdStatus hd_cache_put(const char *kind, const char *key, const void *bytes, size_t size,
                      HdError *error);

/* As above for a short text, which must fit into `capacity` with its terminator. */
HdStatus hd_cache_get_text(const char *kind, const char *key, char *text, size_t capacity,
                           HdError *error);
HdStatus hd_cache_put_text(const char *kind, const char *key, const char *text, HdError *error);

/* Removes the least recently used entries of a folder until all others take at most `max_bytes`.
   Also removes temporary files more than an hour old. Skips files that cannot be removed. */
void hd_cache_limit(const char *folder, int64_t max_bytes);

#endif
