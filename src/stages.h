/* SPDX-License-Identifier: MIT */
/* Work in stages that overlap: while one item is traced, earlier ones are encoded and written by
   other threads. */
#ifndef HD_STAGES_H
#define HD_STAGES_H

#include <stdbool.h>

#include "error.h"

enum { HD_MAX_STAGES = 16 };

/* Items are numbered 0, 1, 2, ... in the order in which they are given. */
typedef struct HdStage {
    /* Called once for each item, on a thread of the stage. */
    HdStatus (*work)(void *context, int item, HdError *error);
    void *context;
    int threads;    /* at least 1; with 1 the items come in order and one at a time */
    unsigned after; /* a bit for each earlier stage of the list that must be done with the item */
} HdStage;

typedef struct HdStages HdStages;

/* Starts the threads of 1 to HD_MAX_STAGES stages. At most `room` items, 1 or more, are under way
   at a time. */
HdStatus hd_stages_start(HdStages **stages, const HdStage *list, int count, int room,
                         HdError *error);

/* Waits until another item may be given. All stages are then done with the item that was given
   `room` items before it. False after a failure: what was given since comes to nothing. */
bool hd_stages_wait(HdStages *stages);

/* Gives the next item to the stages; hd_stages_wait must have returned true for it. */
void hd_stages_give(HdStages *stages);

/* Waits until every item went through all stages, ends the threads and frees `stages`. After a
   failure those are the items before the first one that failed: as if the items had been worked on
   one after the other, but later ones may have been through some of the stages. The error is that
   of the first item that failed. */
HdStatus hd_stages_end(HdStages *stages, HdError *error);

#endif
