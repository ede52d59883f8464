/* SPDX-License-Identifier: MIT */
/* Overlapping stages of work: while one item is traced, other threads encode and write earlier
   ones. Several threads may make items, each at its own pace. */
#ifndef HD_OUTPUT_STAGES_H
#define HD_OUTPUT_STAGES_H

#include <stdbool.h>

#include "base/error.h"

enum { HD_MAX_STAGES = 16 };

typedef struct HdStage {
    /* Works on each item once, on a thread of the stage. */
    HdStatus (*work)(void *context, int item, HdError *error);
    /* Finishes deferred work of a stage of one thread: called when the next item is not available,
       and at the end. A failure counts as the last item's. NULL: no work is deferred. */
    HdStatus (*settle)(void *context, HdError *error);
    void *context;
    int threads;    /* number of threads, at least 1; a single one gets the items in order */
    unsigned after; /* a bit for each earlier stage that must finish the item first */
} HdStage;

typedef struct HdStages HdStages;

/* A maker of items. */
typedef struct HdClaimer {
    /* Returns whether it wants an item now; `left` items, 1 or more, can be claimed without
       waiting. NULL: always. Must not call functions of this header. */
    bool (*wants)(void *context, int left);
    void *context;
    int ahead; /* claims beyond the capacity; 0 if there are several claimers */
} HdClaimer;

/* Starts the threads of 1 to HD_MAX_STAGES stages for items 0 to item_count - 1. At most `capacity`
   items, 1 or more, are in flight. Items that `is_ready` need no claimer: they count as submitted.
   */
HdStatus hd_stages_start(HdStages **stages, const HdStage *list, int count, int item_count,
                         const bool *is_ready, int capacity, HdError *error);

/* Claims the lowest free item, which the caller must submit or release. Returns -1 if there is none
   for this claimer now; with `waits` it waits for one. None is left after a stop, or once all items
   before the first failed one are submitted. */
int hd_stages_claim(HdStages *stages, const HdClaimer *claimer, bool waits);

/* Waits until a claimed item has capacity: until all stages have finished the item `capacity`
   places before it. Returns false if the item is not wanted, as it or an earlier one failed or the
   stages were stopped. */
bool hd_stages_wait(HdStages *stages, int item);

/* Submits a claimed item that has capacity to the stages. */
void hd_stages_submit(HdStages *stages, int item);

/* Releases a claimed item for another claimer. */
void hd_stages_release(HdStages *stages, int item);

/* Makes waiting claimers ask again whether they want an item. */
void hd_stages_wake(HdStages *stages);

/* Records a failure of a claimed item, as if a stage had failed. */
void hd_stages_fail(HdStages *stages, int item, const HdError *error);

/* Stops claims; only submitted items are still wanted. */
void hd_stages_stop(HdStages *stages);

/* Waits until all stages have finished the items before the first that was not submitted; joins the
   threads and frees `stages`. After a failure those are the items before the first failed one, but
   later items may have been through some stages. Returns the error of the first failed item. */
HdStatus hd_stages_end(HdStages *stages, HdError *error);

#endif
