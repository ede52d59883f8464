/* SPDX-License-Identifier: MIT */
/* How a cache folder is kept small. */
#ifndef HD_SYSTEM_CACHE_LIMIT_H
#define HD_SYSTEM_CACHE_LIMIT_H

#include <stdint.h>

/* Entries' names end so; nothing else in the folder is touched, but for what writers left behind.
 */
#define HD_CACHE_ENDING ".entry"

/* Removes the longest unused entries until all of them together have at most `most` bytes, and
   temporary files more than an hour old. What cannot be removed stays. */
void hd_cache_limit(const char *folder, int64_t most);

#endif
