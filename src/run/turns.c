/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "run/turns.h"

#include <math.h>

static bool awaits_gpu(const HdTurns *turns) {
    for (const HdTurn *turn = turns->list; turn < turns->list + turns->count; turn++)
        if (!turn->is_gone && !turn->is_cpu && turn->seconds <= 0.0)
            return true;
    return false;
}

/* When a tracer has finished so many frames more. */
static double end_of(const HdTurn *turn, int more, double now) {
    return fmax(turn->busy_until, now) + more * turn->seconds;
}

/* Who finishes another frame first, if each has taken as many as `taken` says: -1: nobody. */
static int first_to_finish(const HdTurn *list, const int *taken, int count, double now) {
    int first = -1;
    double least = 0.0;
    for (int i = 0; i < count; i++) {
        if (list[i].is_gone || list[i].seconds <= 0.0)
            continue;
        double end = end_of(&list[i], taken[i] + 1, now);
        if (first < 0 || end < least) {
            first = i;
            least = end;
        }
    }
    return first;
}

static bool is_turn_of(const HdTurns *turns, int number, int left, double now) {
    const HdTurn *own = &turns->list[number];
    int taken[HD_MOST_TRACERS] = {0};
    if (turns->count == 1)
        return true;
    if (own->is_cpu && awaits_gpu(turns))
        return false;
    if (own->seconds <= 0.0)
        return own->in_flight == 0;
    for (int i = 0; i < left; i++) {
        int first = first_to_finish(turns->list, taken, turns->count, now);
        if (first == number)
            return true;
        taken[first]++;
    }
    return false;
}

bool hd_turns_want(HdTurns *turns, int number, int left, double now) {
    pthread_mutex_lock(&turns->mutex);
    bool wanted = is_turn_of(turns, number, left, now);
    pthread_mutex_unlock(&turns->mutex);
    return wanted;
}

void hd_turns_estimate(HdTurns *turns, int number, double seconds) {
    pthread_mutex_lock(&turns->mutex);
    turns->list[number].seconds = seconds;
    pthread_mutex_unlock(&turns->mutex);
}

void hd_turns_leave(HdTurns *turns, int number) {
    pthread_mutex_lock(&turns->mutex);
    turns->list[number].is_gone = true;
    pthread_mutex_unlock(&turns->mutex);
}

void hd_turns_begun(HdTurns *turns, int number, double now) {
    HdTurn *turn = &turns->list[number];
    pthread_mutex_lock(&turns->mutex);
    turn->busy_until = end_of(turn, 1, now);
    turn->in_flight++;
    pthread_mutex_unlock(&turns->mutex);
}

void hd_turns_ended(HdTurns *turns, int number, double seconds, double now) {
    HdTurn *turn = &turns->list[number];
    pthread_mutex_lock(&turns->mutex);
    if (seconds > 0.0)
        turn->seconds = turn->seconds > 0.0 ? 0.5 * (turn->seconds + seconds) : seconds;
    turn->in_flight--;
    turn->busy_until = now + turn->in_flight * turn->seconds;
    pthread_mutex_unlock(&turns->mutex);
}
