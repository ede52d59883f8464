/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "progress.h"

#include <stdio.h>
#include <unistd.h>

#include "clock.h"

enum { BAR_WIDTH = 30 };

HdProgress hd_progress_start(int total) {
    HdProgress progress = {
        .shown = isatty(STDERR_FILENO) != 0,
        .total = total,
        .start_seconds = hd_monotonic_seconds(),
    };
    return progress;
}

void hd_progress_update(const HdProgress *progress, int done) {
    if (!progress->shown || done < 1)
        return;
    char bar[BAR_WIDTH + 1];
    int filled = (int)((long long)done * BAR_WIDTH / progress->total);
    for (int i = 0; i < BAR_WIDTH; i++)
        bar[i] = i < filled ? '#' : '.';
    bar[BAR_WIDTH] = '\0';
    double elapsed = hd_monotonic_seconds() - progress->start_seconds;
    double rate = elapsed > 0.0 ? done / elapsed : 0.0;
    double left = rate > 0.0 ? (progress->total - done) / rate : 0.0;
    fprintf(stderr, "\r[%s] %d/%d frames, %.2f frames/s, %.0f s left \033[K", bar, done,
            progress->total, rate, left);
    fflush(stderr);
}

void hd_progress_end(const HdProgress *progress) {
    if (progress->shown)
        fprintf(stderr, "\r\033[K");
}
