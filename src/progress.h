/* SPDX-License-Identifier: MIT */
/* Progress on standard error, where that is a terminal. */
#ifndef HD_PROGRESS_H
#define HD_PROGRESS_H

#include <stdbool.h>

typedef struct HdProgress {
    bool shown;
    int total;
    double start_seconds;
} HdProgress;

HdProgress hd_progress_start(int total);

/* Redraws the line after `done` frames. */
void hd_progress_update(const HdProgress *progress, int done);

/* Takes the line away. */
void hd_progress_end(const HdProgress *progress);

#endif
