/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "stages.h"

#include <limits.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "fallbacks.h"

typedef struct Worker {
    HdStages *stages;
    int stage;
    pthread_t thread;
} Worker;

struct HdStages {
    pthread_mutex_t mutex;
    pthread_cond_t room_made;
    pthread_cond_t work_made[HD_MAX_STAGES];
    HdStage list[HD_MAX_STAGES];
    int next[HD_MAX_STAGES]; /* the item that the stage takes next */
    int count;
    int room;
    unsigned *done; /* by item modulo room: the stages that are done with it */
    int given;      /* items so far */
    int gone;       /* items that went through all stages, and so did those before them */
    int limit;      /* the first item that failed; INT_MAX: none */
    bool ended;     /* no more items come */
    HdStatus status;
    HdError error;
    Worker *workers;
    int worker_count;
};

/* For a stage that has something left. */
static bool can_take(const HdStages *stages, int stage) {
    int item = stages->next[stage];
    unsigned after = stages->list[stage].after;
    return item < stages->given && (stages->done[item % stages->room] & after) == after;
}

/* Nothing is left for the stage, now or later. */
static bool is_over(const HdStages *stages, int stage) {
    int item = stages->next[stage];
    return item >= stages->limit || (stages->ended && item >= stages->given);
}

static void wake_all(HdStages *stages) {
    for (int i = 0; i < stages->count; i++)
        pthread_cond_broadcast(&stages->work_made[i]);
    pthread_cond_broadcast(&stages->room_made);
}

/* Of several failures that of the earliest item counts, for an earlier one may still come. */
static void note_failure(HdStages *stages, int item, HdStatus status, const HdError *error) {
    if (item >= stages->limit)
        return;
    stages->limit = item;
    stages->status = status;
    stages->error = *error;
    wake_all(stages);
}

static void note_success(HdStages *stages, int stage, int item) {
    const unsigned all = (1u << stages->count) - 1;
    stages->done[item % stages->room] |= 1u << stage;
    for (int i = stage + 1; i < stages->count; i++)
        if ((stages->list[i].after >> stage & 1) != 0)
            pthread_cond_broadcast(&stages->work_made[i]);
    while (stages->gone < stages->given && stages->done[stages->gone % stages->room] == all) {
        stages->gone++;
        pthread_cond_broadcast(&stages->room_made);
    }
}

static void *worker_main(void *argument) {
    const Worker *worker = argument;
    HdStages *stages = worker->stages;
    const HdStage *stage = &stages->list[worker->stage];
    HdError error;
    pthread_mutex_lock(&stages->mutex);
    while (!is_over(stages, worker->stage)) {
        if (!can_take(stages, worker->stage)) {
            pthread_cond_wait(&stages->work_made[worker->stage], &stages->mutex);
            continue;
        }
        int item = stages->next[worker->stage]++;
        pthread_mutex_unlock(&stages->mutex);
        HdStatus status = stage->work(stage->context, item, &error);
        pthread_mutex_lock(&stages->mutex);
        if (status == HD_OK)
            note_success(stages, worker->stage, item);
        else
            note_failure(stages, item, status, &error);
    }
    pthread_mutex_unlock(&stages->mutex);
    return NULL;
}

static HdStages *create(const HdStage *list, int count, int room) {
    int threads = list[0].threads;
    for (int i = 1; i < count; i++)
        threads += list[i].threads;
    HdStages *stages = calloc(1, sizeof *stages);
    if (stages == NULL)
        return NULL;
    stages->done = calloc((size_t)room, sizeof *stages->done);
    stages->workers = calloc((size_t)threads, sizeof *stages->workers);
    stages->count = count;
    stages->room = room;
    stages->limit = INT_MAX;
    memcpy(stages->list, list, (size_t)count * sizeof *list);
    pthread_mutex_init(&stages->mutex, NULL);
    pthread_cond_init(&stages->room_made, NULL);
    for (int i = 0; i < count; i++)
        pthread_cond_init(&stages->work_made[i], NULL);
    return stages;
}

static void destroy(HdStages *stages) {
    for (int i = 0; i < stages->count; i++)
        pthread_cond_destroy(&stages->work_made[i]);
    pthread_cond_destroy(&stages->room_made);
    pthread_mutex_destroy(&stages->mutex);
    free(stages->workers);
    free(stages->done);
    free(stages);
}

static void join_all(HdStages *stages) {
    pthread_mutex_lock(&stages->mutex);
    stages->ended = true;
    wake_all(stages);
    pthread_mutex_unlock(&stages->mutex);
    for (int i = 0; i < stages->worker_count; i++)
        pthread_join(stages->workers[i].thread, NULL);
}

/* Returns 0 or what went wrong, as errno would. */
static int start_worker(HdStages *stages, int stage) {
    Worker *worker = &stages->workers[stages->worker_count];
    *worker = (Worker){.stages = stages, .stage = stage};
    int reason = pthread_create(&worker->thread, NULL, worker_main, worker);
    if (reason == 0)
        stages->worker_count++;
    return reason;
}

/* Every stage has one thread already, and could do with it. */
static void start_more(HdStages *stages) {
    int reason = 0, wanted = 0;
    for (int i = 0; i < stages->count; i++) {
        wanted += stages->list[i].threads;
        for (int j = 1; j < stages->list[i].threads && reason == 0; j++)
            reason = start_worker(stages, i);
    }
    if (reason != 0)
        hd_fallback_note("the system refused threads for the outputs (%s): %d of %d do it",
                         strerror(reason), stages->worker_count, wanted);
}

HdStatus hd_stages_start(HdStages **out, const HdStage *list, int count, int room, HdError *error) {
    HdStages *stages = create(list, count, room);
    int reason = 0;
    *out = NULL;
    if (stages == NULL || stages->done == NULL || stages->workers == NULL) {
        if (stages != NULL)
            destroy(stages);
        return hd_fail(error, HD_FAILED, "out of memory: no room for the stages of a run");
    }
    for (int i = 0; i < count && reason == 0; i++)
        reason = start_worker(stages, i);
    if (reason == 0) {
        start_more(stages);
        *out = stages;
        return HD_OK;
    }
    int started = stages->worker_count;
    join_all(stages);
    destroy(stages);
    return hd_fail(
        error, HD_FAILED,
        "cannot start thread %d of at least %d for the outputs: %s; --threads leaves more of "
        "them to the outputs",
        started + 1, count, strerror(reason));
}

bool hd_stages_wait(HdStages *stages) {
    pthread_mutex_lock(&stages->mutex);
    while (stages->limit == INT_MAX && stages->given - stages->gone >= stages->room)
        pthread_cond_wait(&stages->room_made, &stages->mutex);
    bool good = stages->limit == INT_MAX;
    pthread_mutex_unlock(&stages->mutex);
    return good;
}

void hd_stages_give(HdStages *stages) {
    pthread_mutex_lock(&stages->mutex);
    stages->done[stages->given % stages->room] = 0;
    stages->given++;
    for (int i = 0; i < stages->count; i++)
        if (stages->list[i].after == 0)
            pthread_cond_broadcast(&stages->work_made[i]);
    pthread_mutex_unlock(&stages->mutex);
}

HdStatus hd_stages_end(HdStages *stages, HdError *error) {
    join_all(stages);
    HdStatus status = stages->status;
    if (status != HD_OK)
        *error = stages->error;
    destroy(stages);
    return status;
}
