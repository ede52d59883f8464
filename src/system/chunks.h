/* SPDX-License-Identifier: MIT */
/* Work on many numbered items that are too small to be handed to threads one by one. */
#ifndef HD_SYSTEM_CHUNKS_H
#define HD_SYSTEM_CHUNKS_H

#include "system/thread_pool.h"

/* Works on the items first .. end - 1; calls with other items may run at once. */
typedef void HdChunkWork(void *context, int first, int end);

/* Calls `work` until it was given each of `count` items once, on the pool's threads, or on the
   caller's where there are few, and waits. */
void hd_chunks_run(HdThreadPool *pool, int count, HdChunkWork *work, void *context);

/* Writes what it chooses of the items first .. end - 1 to `chosen`, at most one number for each
   item, in their order; returns how many these are. */
typedef int HdChunkChoice(void *context, int first, int end, int *chosen);

/* Chooses among `count` items as above, with the same outcome as one call for all of them. `chosen`
   has room for `count` numbers, and may be what a choice reads of its own items. Returns how many
   were chosen. */
int hd_chunks_choose(HdThreadPool *pool, int count, HdChunkChoice *choose, void *context,
                     int *chosen);

#endif
