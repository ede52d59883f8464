/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "output/stages.h"

#include <limits.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "base/minmax.h"
#include "system/machine.h"
#include "system/thread_pool.h"

typedef struct Worker {
    HdStages *stages;
    int stage;
    pthread_t thread;
} Worker;

/* State of an item; ready ones are submitted from the start. */
typedef enum State { FREE, CLAIMED, SUBMITTED } State;

/* Bits for each stage of an item in flight. */
typedef struct Slot {
    unsigned claimed, done;
} Slot;

struct HdStages {
    pthread_mutex_t mutex;
    pthread_cond_t claims_changed; /* or another event that claimers wait for */
    pthread_cond_t work_made[HD_MAX_STAGES];
    HdStage list[HD_MAX_STAGES];
    int next[HD_MAX_STAGES]; /* first item that each stage has not claimed */
    int count;
    int capacity;
    Slot *slots;           /* slots by item modulo capacity */
    unsigned char *states; /* states by item */
    int item_count; /* number of items; at the end those before the first that was not submitted */
    int first_free; /* no item before it is free */
    int submitted_until; /* all items before it are submitted */
    int finished_until;  /* all stages have finished the items before it */
    int limit;           /* first item that failed; INT_MAX: none */
    bool stopped;
    bool ended; /* no more items come */
    HdStatus status;
    HdError error;
    Worker *workers;
    int worker_count;
};

static Slot *slot_of(const HdStages *stages, int item) {
    return &stages->slots[item % stages->capacity];
}

static bool is_submitted(const HdStages *stages, int item) {
    return item < stages->item_count && stages->states[item] == SUBMITTED;
}

/* Returns the end of the wanted items. */
static int wanted_end(const HdStages *stages) {
    return hd_min(stages->item_count, stages->limit);
}

static int first_not_submitted(HdStages *stages) {
    while (is_submitted(stages, stages->submitted_until))
        stages->submitted_until++;
    return stages->submitted_until;
}

/* Returns the stage's next item, or, with several threads, which keep no order, the first available
   one; -1 if none. */
static int find_work(const HdStages *stages, int stage) {
    const HdStage *what = &stages->list[stage];
    const int first = stages->next[stage];
    int end = hd_min(stages->finished_until + stages->capacity, wanted_end(stages));
    if (what->threads == 1)
        end = hd_min(end, first + 1);
    for (int item = first; item < end; item++) {
        const Slot *slot = slot_of(stages, item);
        if (is_submitted(stages, item) && (slot->claimed >> stage & 1) == 0 &&
            (slot->done & what->after) == what->after)
            return item;
    }
    return -1;
}

static void claim_work(HdStages *stages, int stage, int item) {
    int end = stages->finished_until + stages->capacity;
    slot_of(stages, item)->claimed |= 1u << stage;
    while (stages->next[stage] < end &&
           (slot_of(stages, stages->next[stage])->claimed >> stage & 1) != 0)
        stages->next[stage]++;
}

static void wake_all(HdStages *stages) {
    for (int i = 0; i < stages->count; i++)
        pthread_cond_broadcast(&stages->work_made[i]);
    pthread_cond_broadcast(&stages->claims_changed);
}

/* Keeps the failure of the earliest item, for an earlier one may still come. */
static void note_failure(HdStages *stages, int item, const HdError *error) {
    if (item >= stages->limit)
        return;
    stages->limit = item;
    stages->status = error->status;
    stages->error = *error;
    wake_all(stages);
}

static void wake_first_stages(HdStages *stages) {
    for (int i = 0; i < stages->count; i++)
        if (stages->list[i].after == 0)
            pthread_cond_broadcast(&stages->work_made[i]);
}

static void note_success(HdStages *stages, int stage, int item) {
    const unsigned all = (1u << stages->count) - 1;
    slot_of(stages, item)->done |= 1u << stage;
    for (int i = stage + 1; i < stages->count; i++)
        if ((stages->list[i].after >> stage & 1) != 0)
            pthread_cond_broadcast(&stages->work_made[i]);
    while (slot_of(stages, stages->finished_until)->done == all) {
        *slot_of(stages, stages->finished_until) = (Slot){0};
        stages->finished_until++;
        pthread_cond_broadcast(&stages->claims_changed);
        if (is_submitted(stages, stages->finished_until + stages->capacity - 1))
            wake_first_stages(stages);
    }
}

/* Works on the item or settles after it. Called with the mutex locked, which is unlocked meanwhile.
 */
static bool work(HdStages *stages, int number, int item, bool settles) {
    const HdStage *stage = &stages->list[number];
    HdError error;
    pthread_mutex_unlock(&stages->mutex);
    const HdStatus status =
        settles ? stage->settle(stage->context, &error) : stage->work(stage->context, item, &error);
    pthread_mutex_lock(&stages->mutex);
    if (status != HD_OK)
        note_failure(stages, item, &error);
    else if (!settles)
        note_success(stages, number, item);
    return status == HD_OK;
}

static void *worker_main(void *argument) {
    const Worker *worker = argument;
    HdStages *stages = worker->stages;
    const int stage = worker->stage;
    int unsettled = -1; /* last item that may be deferred; negative: none */
    pthread_mutex_lock(&stages->mutex);
    for (;;) {
        /* no work is left for the stage, now or later */
        const bool over =
            stages->next[stage] >= (stages->ended ? wanted_end(stages) : stages->limit);
        const int item = over ? -1 : find_work(stages, stage);
        if (item >= 0) {
            claim_work(stages, stage, item);
            unsettled = work(stages, stage, item, false) ? item : -1;
        } else if (unsettled >= 0 && stages->list[stage].settle != NULL) {
            work(stages, stage, unsettled, true);
            unsettled = -1;
        } else if (over) {
            break;
        } else {
            pthread_cond_wait(&stages->work_made[stage], &stages->mutex);
        }
    }
    pthread_mutex_unlock(&stages->mutex);
    return NULL;
}

static void destroy(HdStages *stages) {
    for (int i = 0; i < stages->count; i++)
        pthread_cond_destroy(&stages->work_made[i]);
    pthread_cond_destroy(&stages->claims_changed);
    pthread_mutex_destroy(&stages->mutex);
    free(stages->workers);
    free(stages->slots);
    free(stages->states);
    free(stages);
}

static HdStages *create(const HdStage *list, int count, int item_count, const bool *is_ready,
                        int capacity) {
    int threads = list[0].threads;
    for (int i = 1; i < count; i++)
        threads += list[i].threads;
    HdStages *stages = calloc(1, sizeof *stages);
    if (stages == NULL)
        return NULL;
    stages->slots = calloc((size_t)capacity, sizeof *stages->slots);
    stages->states = calloc((size_t)item_count + 1, sizeof *stages->states);
    stages->workers = calloc((size_t)threads, sizeof *stages->workers);
    stages->count = count;
    stages->item_count = item_count;
    for (int i = 0; i < item_count && stages->states != NULL; i++)
        stages->states[i] = is_ready[i] ? SUBMITTED : FREE;
    stages->capacity = capacity;
    stages->limit = INT_MAX;
    memcpy(stages->list, list, (size_t)count * sizeof *list);
    pthread_mutex_init(&stages->mutex, NULL);
    pthread_cond_init(&stages->claims_changed, NULL);
    for (int i = 0; i < count; i++)
        pthread_cond_init(&stages->work_made[i], NULL);
    if (stages->slots != NULL && stages->states != NULL && stages->workers != NULL)
        return stages;
    destroy(stages);
    return NULL;
}

static void join_all(HdStages *stages) {
    pthread_mutex_lock(&stages->mutex);
    stages->ended = true;
    stages->item_count = first_not_submitted(stages);
    wake_all(stages);
    pthread_mutex_unlock(&stages->mutex);
    for (int i = 0; i < stages->worker_count; i++)
        pthread_join(stages->workers[i].thread, NULL);
}

/* Returns the first free item, or the end if none is. */
static int find_free(HdStages *stages) {
    const int end = wanted_end(stages);
    while (stages->first_free < end && stages->states[stages->first_free] != FREE)
        stages->first_free++;
    return stages->first_free;
}

static bool can_claim(const HdStages *stages, const HdClaimer *claimer, int item) {
    const int end = wanted_end(stages);
    int left = 0; /* counted up to the capacity only */
    if (item >= end || item >= stages->finished_until + stages->capacity + claimer->ahead)
        return false;
    for (int i = item; i < end && left < stages->capacity; i++)
        left += stages->states[i] == FREE;
    return claimer->wants == NULL || claimer->wants(claimer->context, left);
}

int hd_stages_claim(HdStages *stages, const HdClaimer *claimer, bool waits) {
    int claimed = -1;
    pthread_mutex_lock(&stages->mutex);
    while (!stages->stopped && first_not_submitted(stages) < wanted_end(stages)) {
        int item = find_free(stages);
        if (can_claim(stages, claimer, item)) {
            stages->states[item] = CLAIMED;
            claimed = item;
            break;
        }
        if (!waits)
            break;
        pthread_cond_wait(&stages->claims_changed, &stages->mutex);
    }
    pthread_mutex_unlock(&stages->mutex);
    return claimed;
}

bool hd_stages_wait(HdStages *stages, int item) {
    pthread_mutex_lock(&stages->mutex);
    while (!stages->stopped && item < stages->limit &&
           item >= stages->finished_until + stages->capacity)
        pthread_cond_wait(&stages->claims_changed, &stages->mutex);
    bool is_wanted = !stages->stopped && item < stages->limit;
    pthread_mutex_unlock(&stages->mutex);
    return is_wanted;
}

void hd_stages_submit(HdStages *stages, int item) {
    pthread_mutex_lock(&stages->mutex);
    stages->states[item] = SUBMITTED;
    wake_first_stages(stages);
    pthread_cond_broadcast(&stages->claims_changed);
    pthread_mutex_unlock(&stages->mutex);
}

void hd_stages_release(HdStages *stages, int item) {
    pthread_mutex_lock(&stages->mutex);
    stages->states[item] = FREE;
    stages->first_free = hd_min(stages->first_free, item);
    pthread_cond_broadcast(&stages->claims_changed);
    pthread_mutex_unlock(&stages->mutex);
}

void hd_stages_wake(HdStages *stages) {
    pthread_mutex_lock(&stages->mutex);
    pthread_cond_broadcast(&stages->claims_changed);
    pthread_mutex_unlock(&stages->mutex);
}

void hd_stages_fail(HdStages *stages, int item, const HdError *error) {
    pthread_mutex_lock(&stages->mutex);
    note_failure(stages, item, error);
    pthread_mutex_unlock(&stages->mutex);
}

void hd_stages_stop(HdStages *stages) {
    pthread_mutex_lock(&stages->mutex);
    stages->stopped = true;
    pthread_cond_broadcast(&stages->claims_changed);
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

/* Returns 0, or an errno value. */
static int start_worker(HdStages *stages, int stage) {
    Worker *worker = &stages->workers[stages->worker_count];
    *worker = (Worker){.stages = stages, .stage = stage};
    const int reason = hd_start_thread(&worker->thread, worker_main, worker);
    stages->worker_count += reason == 0;
    return reason;
}

/* Adds threads; each stage has one already and can work with it. */
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

HdStatus hd_stages_start(HdStages **out, const HdStage *list, int count, int item_count,
                         const bool *is_ready, int capacity, HdError *error) {
    HdStages *stages = create(list, count, item_count, is_ready, capacity);
    int reason = 0;
    *out = NULL;
    if (stages == NULL)
        return HD_NO_ROOM(error, "the stages of a run");
    for (int i = 0; i < count && reason == 0; i++)
        reason = start_worker(stages, i);
    if (reason == 0) {
        start_more(stages);
        *out = stages;
        return HD_OK;
    }
    hd_fail(error, HD_FAILED,
            "cannot start thread %d of at least %d for the outputs: %s; --threads leaves more of "
            "them to the outputs",
            stages->worker_count + 1, count, strerror(reason));
    hd_stages_fail(stages, 0, error); /* not even ready items are wanted */
    return hd_stages_end(stages, error);
}
