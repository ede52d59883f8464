/* SPDX-License-Identifier: MIT */
/* Progress of work: workers count it on any thread; an observer reads it and may cancel. */
#ifndef HD_BASE_WATCH_H
#define HD_BASE_WATCH_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The count of a whole frame. */
#define HD_WATCH_FRAME ((uint64_t)1 << 32)

/* Zero-initialise. */
typedef struct HdWatch {
    _Atomic uint64_t done;    /* finished work; never falls, even if work is lost */
    atomic_bool is_cancelled; /* cancels frames in flight, as after a signal */
} HdWatch;

/* A piece of work and the watch that observes it. */
typedef struct HdWatched {
    HdWatch *watch;  /* NULL: not observed */
    uint64_t weight; /* at most HD_WATCH_FRAME */
} HdWatched;

/* Splits off a share, 0..1, of the remaining work. */
static inline HdWatched hd_watched_split(HdWatched *left, double share) {
    const HdWatched part = {left->watch, (uint64_t)((double)left->weight * share)};
    left->weight -= part.weight;
    return part;
}

/* Counts items first .. end - 1 of `count` as done, each once, in any order. All items together
   count the weight. */
static inline void hd_watched_add(const HdWatched *watched, int first, int end, int count) {
    const uint64_t weight = watched->weight * (uint64_t)end / (uint64_t)count -
                            watched->weight * (uint64_t)first / (uint64_t)count;
    if (watched->watch != NULL)
        atomic_fetch_add_explicit(&watched->watch->done, weight, memory_order_relaxed);
}

static inline bool hd_watched_is_cancelled(const HdWatched *watched) {
    return watched->watch != NULL && atomic_load(&watched->watch->is_cancelled);
}

/* Returns the finished work in frames. */
static inline double hd_watch_frames(const HdWatch *watch) {
    return (double)atomic_load_explicit(&watch->done, memory_order_relaxed) /
           (double)HD_WATCH_FRAME;
}

#endif
