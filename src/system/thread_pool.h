/* SPDX-License-Identifier: MIT */
/* A thread pool that processes numbered items. */
#ifndef HD_SYSTEM_THREAD_POOL_H
#define HD_SYSTEM_THREAD_POOL_H

#include <stdbool.h>

#include <pthread.h>

#include "base/error.h"

typedef struct HdThreadPool HdThreadPool;

/* Starts `threads` threads (at least 1), each in the default floating-point environment. If the
   system refuses some, the others do the work and a note reports it (machine.h). */
HdStatus hd_thread_pool_create(HdThreadPool **pool, int threads, HdError *error);

/* Returns the number of threads. */
int hd_thread_pool_size(const HdThreadPool *pool);

/* The work on an item; `thread` counts from 0, and no two concurrent calls have the same number. */
typedef void HdThreadWork(void *context, int thread, int item);

/* Calls work(context, t, i) once for each i = 0 .. count - 1 on the pool's threads, in no fixed
   order, and blocks until all returned. One caller at a time. Starts no further item once
   must_stop(context) is true (NULL: never). Returns false if some were not started. */
bool hd_thread_pool_run(HdThreadPool *pool, int count, HdThreadWork *work, void *context,
                        bool (*must_stop)(const void *context));

/* Stops the threads and frees the pool. NULL is allowed. */
void hd_thread_pool_destroy(HdThreadPool *pool);

/* Processes the items first .. end - 1; calls with other items may run concurrently. */
typedef void HdChunkWork(void *context, int first, int end);

/* Calls `work` for chunks that cover each of `count` items once. Runs on the pool's threads, or on
   the caller's if there are few items. Blocks until all returned. */
void hd_chunks_run(HdThreadPool *pool, int count, HdChunkWork *work, void *context);

/* Chooses among the items first .. end - 1: writes at most one number for each to `chosen`, in
   their order, and returns how many. */
typedef int HdChunkChoice(void *context, int first, int end, int *chosen);

/* Chooses among `count` items; the result equals that of one call for all of them. `chosen` has
   capacity for `count` numbers, and may alias what a choice reads of its own items. Returns how
   many were chosen. */
int hd_chunks_choose(HdThreadPool *pool, int count, HdChunkChoice *choose, void *context,
                     int *chosen);

/* ---- */

/* Starts a thread with a stack of 8 MiB, whatever the process's limit. Returns 0 or an errno. */
int hd_start_thread(pthread_t *thread, void *(*work)(void *), void *argument);

/* Ensures that the first thread's stack may grow as needed. HD_FAILED: the system's limit (ulimit
   -s) is too low and cannot be raised. */
HdStatus hd_check_stack(HdError *error);

#endif
