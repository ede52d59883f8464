/* SPDX-License-Identifier: MIT */
/* Work in stages that overlap: while one item is traced, earlier ones are encoded and written by
   other threads. Several threads may make the items, each at its own pace. */
#ifndef HD_OUTPUT_STAGES_H
#define HD_OUTPUT_STAGES_H

#include <stdbool.h>

#include "base/error.h"

enum { HD_MAX_STAGES = 16 };

typedef struct HdStage {
    /* Called once for each item, on a thread of the stage. */
    HdStatus (*work)(void *context, int item, HdError *error);
    /* For a stage of one thread that may put its work off: called after items once the next one is
       not there yet, and once there are no more. A failure counts as that of the last item. NULL:
       nothing is put off. */
    HdStatus (*settle)(void *context, HdError *error);
    void *context;
    int threads;    /* at least 1; with 1 the items come in order and one at a time */
    unsigned after; /* a bit for each earlier stage of the list that must be done with the item */
} HdStage;

typedef struct HdStages HdStages;

/* Who makes items. */
typedef struct HdClaimer {
    /* Whether it wants an item now; `left` items may be taken without waiting for others, 1 or
       more. NULL: always. Must not call functions of this header. */
    bool (*wants)(void *context, int left);
    void *context;
    int ahead; /* so many items more than there is room for; 0 if there are several takers */
} HdClaimer;

/* Starts the threads of 1 to HD_MAX_STAGES stages for the items 0 to item_count - 1. At most
   `capacity` items, 1 or more, are under way at a time. Nobody needs to make those that `is_ready`
   says: the stages take them as if they had been given. */
HdStatus hd_stages_start(HdStages **stages, const HdStage *list, int count, int item_count,
                         const bool *is_ready, int capacity, HdError *error);

/* Takes the first item that nobody has made or is making; the caller must give it, or give it back.
   Negative where there is none for this taker now; with `waits` it waits for one, and there is none
   once all items are given, those before one that failed, or the stages were stopped. */
int hd_stages_claim(HdStages *stages, const HdClaimer *claimer, bool waits);

/* Waits until there is room for an item that was taken: all stages are then done with the one
   `capacity` before it. False where the item is not wanted any more, since it or an earlier one
   failed, or the stages were stopped. */
bool hd_stages_wait(HdStages *stages, int item);

/* Gives an item to the stages that was taken and has room. */
void hd_stages_submit(HdStages *stages, int item);

/* Gives an item back that was taken, so that another taker makes it. */
void hd_stages_release(HdStages *stages, int item);

/* Takers that wait are asked again whether they want something. */
void hd_stages_wake(HdStages *stages);

/* As if a stage had failed with the item, which was taken. */
void hd_stages_fail(HdStages *stages, int item, const HdError *error);

/* No more items are wanted than were given. */
void hd_stages_stop(HdStages *stages);

/* Waits until the items that were given went through all stages, up to the first that was not
   given; ends the threads and frees `stages`. After a failure those are the items before the first
   one that failed: as if the items had been worked on one after the other, but later ones may have
   been through some of the stages. The error is that of the first item that failed. */
HdStatus hd_stages_end(HdStages *stages, HdError *error);

#endif
