/* SPDX-License-Identifier: MIT */
/* A folder that outlives the program, for what takes long to make: compiled kernels, measurements.
   Nothing in it is needed. An entry is trusted only if nobody but this user may write to it or to
   the folder and its checksum is right; whatever is wrong with the folder, the program goes on
   without. Entries are found by a key, a text of everything they depend on, which is stored whole
   and compared.

   The folder is the one that HEDRON_CACHE names; else $XDG_CACHE_HOME/hedron; else
   $HOME/.cache/hedron, where there is that home. HEDRON_CACHE=off switches it off. It is made with
   mode 0700, files in it with 0600. */
#ifndef HD_SYSTEM_CACHE_FOLDER_H
#define HD_SYSTEM_CACHE_FOLDER_H

#include <stddef.h>
#include <stdint.h>

#include "base/error.h"
#include "system/path.h"

enum {
    HD_CACHE_MAX_BYTES = 128 << 20,      /* of all entries; the longest unused go first */
    HD_CACHE_MAX_ENTRY_BYTES = 16 << 20, /* of one, key included */
    HD_CACHE_MAX_KIND = 31               /* characters of a kind */
};

/* The folder's name; it need not exist. HD_UNAVAILABLE and the reason where there is none. */
HdStatus hd_cache_folder(char folder[HD_MAX_PATH], HdError *error);

/* The entry of this kind ("cuda": lower-case letters) and key. `*bytes` is the caller's to free,
   and NULL on failure. HD_UNAVAILABLE where there is none or no folder; HD_FAILED where there is
   one that cannot be trusted: damaged, cut short, of another key or owner. The message says which,
   and to put the entry anew repairs it. */
HdStatus hd_cache_get(const char *kind, const char *key, unsigned char **bytes, size_t *size,
                      HdError *error);

/* Stores an entry, replacing an older one of the same key at once or not at all, and then removes
   the longest unused entries beyond HD_CACHE_MAX_BYTES. Several processes may do so at a time.
   HD_UNAVAILABLE without a folder, HD_FAILED where it cannot be written to. */
HdStatus hd_cache_put(const char *kind, const char *key, const void *bytes, size_t size,
                      HdError *error);

/* The same for a short text, which must fit into `capacity` with its NUL. */
HdStatus hd_cache_get_text(const char *kind, const char *key, char *text, size_t capacity,
                           HdError *error);
HdStatus hd_cache_put_text(const char *kind, const char *key, const char *text, HdError *error);

/* Removes the longest unused entries of a folder until all of them together have at most `most`
   bytes, and temporary files more than an hour old; nothing else. What cannot be removed stays. */
void hd_cache_limit(const char *folder, int64_t most);

#endif
