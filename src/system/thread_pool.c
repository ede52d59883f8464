/* SPDX-License-Identifier: MIT */
#define _GNU_SOURCE /* pthread_setattr_default_np */
#include "system/thread_pool.h"

#include <fenv.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

#include "base/minmax.h"
#include "system/machine.h"

typedef struct Thread {
    pthread_t thread;
    HdThreadPool *pool;
    int number;
} Thread;

struct HdThreadPool {
    Thread *threads;
    int thread_count;
    pthread_mutex_t mutex;
    pthread_cond_t work_given, work_done;
    unsigned generation; /* number of the run, so that a thread takes part in each once */
    int busy;
    bool ending;
    atomic_int next;
    int count;
    HdThreadWork *work;
    void *context;
    bool (*must_stop)(const void *context);
    atomic_bool stopped; /* some items were not started */
};

static void work_off(HdThreadPool *pool, int thread) {
    for (;;) {
        int item = atomic_fetch_add_explicit(&pool->next, 1, memory_order_relaxed);
        if (item >= pool->count)
            return;
        if (pool->must_stop != NULL && pool->must_stop(pool->context)) {
            atomic_store(&pool->stopped, true);
            return;
        }
        pool->work(pool->context, thread, item);
    }
}

static void *thread_main(void *argument) {
    const Thread *own = argument;
    HdThreadPool *pool = own->pool;
    unsigned seen = 0;
    /* Threads inherit the caller's mode, which may flush denormals to zero. */
    fesetenv(FE_DFL_ENV);
    pthread_mutex_lock(&pool->mutex);
    for (;;) {
        while (!pool->ending && pool->generation == seen)
            pthread_cond_wait(&pool->work_given, &pool->mutex);
        if (pool->ending)
            break;
        seen = pool->generation;
        pthread_mutex_unlock(&pool->mutex);
        work_off(pool, own->number);
        pthread_mutex_lock(&pool->mutex);
        if (--pool->busy == 0)
            pthread_cond_signal(&pool->work_done);
    }
    pthread_mutex_unlock(&pool->mutex);
    return NULL;
}

/* Kernels keep private arrays on the stack. At the limits of depth, planes and lanes they take more
   than 2 MB, the whole stack of a thread on some systems. */
enum { STACK_BYTES = 8 << 20 };

static int init_attributes(pthread_attr_t *attributes) {
    int code = pthread_attr_init(attributes);
    if (code == 0)
        code = pthread_attr_setstacksize(attributes, STACK_BYTES);
    return code;
}

int hd_start_thread(pthread_t *thread, void *(*work)(void *), void *argument) {
    pthread_attr_t attributes;
    int code = init_attributes(&attributes);
    if (code == 0)
        code = pthread_create(thread, &attributes, work, argument);
    pthread_attr_destroy(&attributes);
    return code;
}

/* the first thread's stack, mostly for drivers; it computes no pixels */
enum { MIN_STACK_BYTES = 1 << 20 };

/* Enlarges the stacks of drivers' threads, which follow the limit at the program's start. */
static void enlarge_other_stacks(void) {
#ifdef __GLIBC__
    pthread_attr_t attributes;
    if (init_attributes(&attributes) == 0)
        pthread_setattr_default_np(&attributes);
    pthread_attr_destroy(&attributes);
#endif
}

HdStatus hd_check_stack(HdError *error) {
    struct rlimit limit;
    if (getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur >= MIN_STACK_BYTES)
        return HD_OK;
    const rlim_t found = limit.rlim_cur;
    limit.rlim_cur = MIN_STACK_BYTES;
    if (limit.rlim_max < MIN_STACK_BYTES)
        limit.rlim_max = MIN_STACK_BYTES;
    if (setrlimit(RLIMIT_STACK, &limit) == 0) {
        enlarge_other_stacks();
        return HD_OK;
    }
    return hd_fail(error, HD_FAILED,
                   "the stack may have %llu KiB (ulimit -s), expected at least %d KiB",
                   (unsigned long long)found / 1024, MIN_STACK_BYTES / 1024);
}

static HdStatus start_threads(HdThreadPool *pool, int threads, HdError *error) {
    int code = 0;
    pool->threads = calloc((size_t)threads, sizeof *pool->threads);
    if (pool->threads == NULL)
        return HD_NO_ROOM(error, "%d threads", threads);
    for (int i = 0; i < threads && code == 0; i++) {
        pool->threads[i] = (Thread){.pool = pool, .number = i};
        code = hd_start_thread(&pool->threads[i].thread, thread_main, &pool->threads[i]);
        pool->thread_count += code == 0;
    }
    if (pool->thread_count == 0)
        return hd_fail(error, HD_FAILED, "cannot start one of %d threads: %s", threads,
                       strerror(code));
    if (code != 0)
        hd_fallback_note("the system refused threads for tracing (%s): %d of %d do it",
                         strerror(code), pool->thread_count, threads);
    return HD_OK;
}

HdStatus hd_thread_pool_create(HdThreadPool **out, int threads, HdError *error) {
    HdThreadPool *pool = calloc(1, sizeof *pool);
    if (pool == NULL)
        return HD_NO_ROOM(error, "a pool of threads");
    pthread_mutex_init(&pool->mutex, NULL);
    pthread_cond_init(&pool->work_given, NULL);
    pthread_cond_init(&pool->work_done, NULL);
    const HdStatus status = start_threads(pool, threads, error);
    if (status != HD_OK)
        hd_thread_pool_destroy(pool);
    else
        *out = pool;
    return status;
}

int hd_thread_pool_size(const HdThreadPool *pool) {
    return pool->thread_count;
}

bool hd_thread_pool_run(HdThreadPool *pool, int count, HdThreadWork *work, void *context,
                        bool (*must_stop)(const void *context)) {
    pthread_mutex_lock(&pool->mutex);
    pool->count = count;
    pool->work = work;
    pool->context = context;
    pool->must_stop = must_stop;
    atomic_store(&pool->stopped, false);
    atomic_store(&pool->next, 0);
    pool->busy = pool->thread_count;
    pool->generation++;
    pthread_cond_broadcast(&pool->work_given);
    while (pool->busy > 0)
        pthread_cond_wait(&pool->work_done, &pool->mutex);
    pthread_mutex_unlock(&pool->mutex);
    return !atomic_load(&pool->stopped);
}

void hd_thread_pool_destroy(HdThreadPool *pool) {
    if (pool == NULL)
        return;
    pthread_mutex_lock(&pool->mutex);
    pool->ending = true;
    pthread_cond_broadcast(&pool->work_given);
    pthread_mutex_unlock(&pool->mutex);
    for (int i = 0; i < pool->thread_count; i++)
        pthread_join(pool->threads[i].thread, NULL);
    pthread_cond_destroy(&pool->work_done);
    pthread_cond_destroy(&pool->work_given);
    pthread_mutex_destroy(&pool->mutex);
    free(pool->threads);
    free(pool);
}

/* ---- small items ---- */

/* MIN_ITEMS take some microseconds, as long as waking a thread. MAX_CHUNKS balance threads with
   uneven work. */
enum { MIN_ITEMS = 1024, MAX_CHUNKS = 256 };

typedef struct Job {
    int count, each; /* items in all and in a chunk */
    HdChunkWork *work;
    HdChunkChoice *choose;
    void *context;
    int *chosen;
    int found[MAX_CHUNKS]; /* items chosen in each chunk */
} Job;

static int end_of(const Job *job, int chunk) {
    return hd_min((chunk + 1) * job->each, job->count);
}

static void run_chunk(void *context, int thread, int chunk) {
    const Job *job = context;
    (void)thread;
    job->work(job->context, chunk * job->each, end_of(job, chunk));
}

static void choose_in_chunk(void *context, int thread, int chunk) {
    Job *job = context;
    int first = chunk * job->each;
    (void)thread;
    job->found[chunk] = job->choose(job->context, first, end_of(job, chunk), job->chosen + first);
}

/* Returns the number of chunks. */
static int run(HdThreadPool *pool, Job *job, HdThreadWork *work) {
    job->each = hd_max(job->count / MAX_CHUNKS + 1, MIN_ITEMS);
    const int chunks = (job->count + job->each - 1) / job->each;
    if (chunks == 1)
        work(job, 0, 0);
    else if (chunks > 1)
        hd_thread_pool_run(pool, chunks, work, job, NULL);
    return chunks;
}

void hd_chunks_run(HdThreadPool *pool, int count, HdChunkWork *work, void *context) {
    Job job = {.count = count, .work = work, .context = context};
    run(pool, &job, run_chunk);
}

int hd_chunks_choose(HdThreadPool *pool, int count, HdChunkChoice *choose, void *context,
                     int *chosen) {
    Job job = {.count = count, .choose = choose, .context = context, .chosen = chosen};
    int chunks = run(pool, &job, choose_in_chunk), sum = 0;
    for (int i = 0; i < chunks; i++) {
        if (sum < i * job.each)
            memmove(chosen + sum, chosen + i * job.each, sizeof *chosen * (size_t)job.found[i]);
        sum += job.found[i];
    }
    return sum;
}
