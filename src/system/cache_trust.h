/* SPDX-License-Identifier: MIT */
/* What of a cache folder may be believed: what nobody but this user can have written. */
#ifndef HD_SYSTEM_CACHE_TRUST_H
#define HD_SYSTEM_CACHE_TRUST_H

#include <stdbool.h>
#include <sys/stat.h>

#include "base/error.h"
#include "base/keyed_hash.h"

/* The file in the folder that has the user's key. */
#define HD_CACHE_KEY_NAME "key"

/* Why a file or folder is not this user's alone to write, in words that follow its name; NULL: it
   is. */
const char *hd_cache_find_fault(const struct stat *found);

/* HD_UNAVAILABLE where there is no such folder, HD_FAILED and the reason where others may write to
   it. */
HdStatus hd_cache_check_folder(const char *folder, HdError *error);

/* The random key of this user in the folder, with `may_make` made where there is none that can be
   used, which takes the trust from all entries. HD_FAILED and the reason where there is none. */
HdStatus hd_cache_key(const char *folder, bool may_make, unsigned char key[HD_HASH_KEY_BYTES],
                      HdError *error);

#endif
