/* SPDX-License-Identifier: MIT */
#include "system/chunks.h"

#include <string.h>

/* A chunk of so many items takes some microseconds at least, as long as it takes to wake a thread;
   so many chunks keep the threads even where some have more work. */
enum { LEAST_ITEMS = 1024, MOST_CHUNKS = 256 };

typedef struct Job {
    int count, each; /* items, and those of a chunk */
    HdChunkWork *work;
    HdChunkChoice *choose;
    void *context;
    int *chosen;
    int found[MOST_CHUNKS]; /* by chunk */
} Job;

static bool never(const void *context) {
    (void)context;
    return false;
}

static int chunk_items(int count) {
    int even = count / MOST_CHUNKS + 1;
    return even > LEAST_ITEMS ? even : LEAST_ITEMS;
}

static int end_of(const Job *job, int chunk) {
    int first = chunk * job->each;
    return job->count - first < job->each ? job->count : first + job->each;
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

static int run(HdThreadPool *pool, Job *job, HdThreadWork *work) {
    int chunks = (job->count + job->each - 1) / job->each;
    if (chunks == 1)
        work(job, 0, 0);
    else if (chunks > 1)
        hd_thread_pool_run(pool, chunks, work, job, never);
    return chunks;
}

void hd_chunks_run(HdThreadPool *pool, int count, HdChunkWork *work, void *context) {
    Job job = {.count = count, .each = chunk_items(count), .work = work, .context = context};
    run(pool, &job, run_chunk);
}

int hd_chunks_choose(HdThreadPool *pool, int count, HdChunkChoice *choose, void *context,
                     int *chosen) {
    Job job = {.count = count,
               .each = chunk_items(count),
               .choose = choose,
               .context = context,
               .chosen = chosen};
    int chunks = run(pool, &job, choose_in_chunk), sum = 0;
    for (int i = 0; i < chunks; i++) {
        if (sum < i * job.each)
            memmove(chosen + sum, chosen + i * job.each, sizeof *chosen * (size_t)job.found[i]);
        sum += job.found[i];
    }
    return sum;
}
