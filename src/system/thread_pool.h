/* SPDX-License-Identifier: MIT */
/* A small pool of threads that work off numbered items. */
#ifndef HD_SYSTEM_THREAD_POOL_H
#define HD_SYSTEM_THREAD_POOL_H

#include <stdbool.h>

#include <pthread.h>

#include "base/error.h"

typedef struct HdThreadPool HdThreadPool;

/* Starts `threads` threads (at least 1), each in the default floating-point environment. Where the
   system refuses some, those that it did not refuse do the work, and a note tells (machine.h). */
HdStatus hd_thread_pool_create(HdThreadPool **pool, int threads, HdError *error);

/* How many threads there are. */
int hd_thread_pool_size(const HdThreadPool *pool);

/* What a pool does; `thread` counts from 0, and no two calls with the same number run at once. */
typedef void HdThreadWork(void *context, int thread, int item);

/* Calls work(context, t, i) for i = 0 .. count - 1 on the pool's threads, each once, in no fixed
   order, and waits for all of them. One caller at a time. Once must_stop(context) is true no
   further item is begun; false where some were left out so. NULL: nothing stops it. */
bool hd_thread_pool_run(HdThreadPool *pool, int count, HdThreadWork *work, void *context,
                        bool (*must_stop)(const void *context));

/* Ends the threads. NULL is allowed. */
void hd_thread_pool_destroy(HdThreadPool *pool);

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

/* ---- */

/* Starts a thread with a stack of 8 MiB, whatever the limit of this process gives others. Returns 0
   or what went wrong, as errno would. */
int hd_start_thread(pthread_t *thread, void *(*work)(void *), void *argument);

/* Sees to it that the first thread's stack may grow as far as the program needs. HD_FAILED where
   the system's limit (ulimit -s) is below that and cannot be raised. */
HdStatus hd_check_stack(HdError *error);

#endif
