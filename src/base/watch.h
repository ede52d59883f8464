/* SPDX-License-Identifier: MIT */
/* Work that is watched: whoever does it counts it, on any thread; whoever watches looks, and may
   want it no more. */
#ifndef HD_BASE_WATCH_H
#define HD_BASE_WATCH_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* What a whole frame counts. */
#define HD_WATCH_FRAME ((uint64_t)1 << 32)

/* All zero at first. */
typedef struct HdWatch {
    _Atomic uint64_t done;   /* it never falls; what is done and lost again stays counted */
    atomic_bool is_unwanted; /* frames under way end as after a signal (system/interrupt.h) */
} HdWatch;

/* A piece of work, as its watch sees it. */
typedef struct HdWatched {
    HdWatch *watch;  /* NULL: nobody looks */
    uint64_t weight; /* at most HD_WATCH_FRAME */
} HdWatched;

/* Takes a share, up to 1, of the work that is left. */
static inline HdWatched hd_watched_take(HdWatched *left, double share) {
    const HdWatched taken = {left->watch, (uint64_t)((double)left->weight * share)};
    left->weight -= taken.weight;
    return taken;
}

/* Counts the items first .. end - 1 of `count` as done: each once, in any order. All together are
   worth what the work is. */
static inline void hd_watched_add(const HdWatched *watched, int first, int end, int count) {
    const uint64_t weight = watched->weight * (uint64_t)end / (uint64_t)count -
                            watched->weight * (uint64_t)first / (uint64_t)count;
    if (watched->watch != NULL)
        atomic_fetch_add_explicit(&watched->watch->done, weight, memory_order_relaxed);
}

static inline bool hd_watched_is_unwanted(const HdWatched *watched) {
    return watched->watch != NULL && atomic_load(&watched->watch->is_unwanted);
}

/* In frames. */
static inline double hd_watch_frames(const HdWatch *watch) {
    return (double)atomic_load_explicit(&watch->done, memory_order_relaxed) /
           (double)HD_WATCH_FRAME;
}

#endif
