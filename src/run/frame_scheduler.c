/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "run/frame_scheduler.h"

#include <math.h>

static bool awaits_gpu(const HdFrameScheduler *scheduler) {
    for (const HdScheduledWorker *worker = scheduler->list;
         worker < scheduler->list + scheduler->count; worker++)
        if (!worker->is_gone && !worker->is_cpu && worker->seconds <= 0.0)
            return true;
    return false;
}

/* Returns when the worker has finished `more` further frames. */
static double finish_time(const HdScheduledWorker *worker, int more, double now) {
    return fmax(worker->busy_until, now) + more * worker->seconds;
}

/* Returns the worker that finishes another frame first, if each has also claimed `claimed` ones;
   -1: none. */
static int first_to_finish(const HdScheduledWorker *list, const int *claimed, int count,
                           double now) {
    int first = -1;
    double least = 0.0;
    for (int i = 0; i < count; i++) {
        if (list[i].is_gone || list[i].seconds <= 0.0)
            continue;
        double end = finish_time(&list[i], claimed[i] + 1, now);
        if (first < 0 || end < least) {
            first = i;
            least = end;
        }
    }
    return first;
}

static bool should_claim(const HdFrameScheduler *scheduler, int number, int left, double now) {
    const HdScheduledWorker *own = &scheduler->list[number];
    int claimed[HD_MAX_WORKERS] = {0};
    if (scheduler->count == 1)
        return true;
    if (own->is_cpu && awaits_gpu(scheduler))
        return false;
    if (own->seconds <= 0.0)
        return own->count_in_flight == 0;
    for (int i = 0; i < left; i++) {
        int first = first_to_finish(scheduler->list, claimed, scheduler->count, now);
        if (first == number)
            return true;
        claimed[first]++;
    }
    return false;
}

bool hd_scheduler_wants(HdFrameScheduler *scheduler, int number, int left, double now) {
    pthread_mutex_lock(&scheduler->mutex);
    bool wanted = should_claim(scheduler, number, left, now);
    pthread_mutex_unlock(&scheduler->mutex);
    return wanted;
}

void hd_scheduler_estimate(HdFrameScheduler *scheduler, int number, double seconds) {
    pthread_mutex_lock(&scheduler->mutex);
    scheduler->list[number].seconds = seconds;
    pthread_mutex_unlock(&scheduler->mutex);
}

void hd_scheduler_leave(HdFrameScheduler *scheduler, int number) {
    pthread_mutex_lock(&scheduler->mutex);
    scheduler->list[number].is_gone = true;
    pthread_mutex_unlock(&scheduler->mutex);
}

void hd_scheduler_begun(HdFrameScheduler *scheduler, int number, double now) {
    HdScheduledWorker *worker = &scheduler->list[number];
    pthread_mutex_lock(&scheduler->mutex);
    worker->busy_until = finish_time(worker, 1, now);
    worker->count_in_flight++;
    pthread_mutex_unlock(&scheduler->mutex);
}

void hd_scheduler_ended(HdFrameScheduler *scheduler, int number, double seconds, double now) {
    HdScheduledWorker *worker = &scheduler->list[number];
    pthread_mutex_lock(&scheduler->mutex);
    if (seconds > 0.0)
        worker->seconds = worker->seconds > 0.0 ? 0.5 * (worker->seconds + seconds) : seconds;
    worker->count_in_flight--;
    worker->busy_until = now + worker->count_in_flight * worker->seconds;
    pthread_mutex_unlock(&scheduler->mutex);
}
