/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "progress.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "clock.h"

enum { BAR_WIDTH = 24, SECONDS_BETWEEN_LINES = 5, MAX_HOURS = 99999 };

HdProgressForm hd_progress_form(bool wants_lines) {
    if (isatty(STDERR_FILENO))
        return HD_PROGRESS_BAR;
    return wants_lines ? HD_PROGRESS_LINES : HD_PROGRESS_NONE;
}

HdProgress hd_progress_start(HdProgressForm form, int total) {
    double now = hd_monotonic_seconds();
    return (HdProgress){.form = form, .total = total, .start_seconds = now, .line_seconds = now};
}

void hd_progress_time(double seconds, char text[32]) {
    const double most = MAX_HOURS * 3600.0;
    long whole = (long)((seconds < most ? seconds : most) + 0.5);
    if (whole < 3600)
        snprintf(text, 32, "%ld:%02ld", whole / 60, whole % 60);
    else
        snprintf(text, 32, "%ld:%02ld:%02ld", whole / 3600, whole / 60 % 60, whole % 60);
}

void hd_progress_line(int done, int total, double elapsed_seconds, char text[128]) {
    char time[32];
    double rate = elapsed_seconds > 0.0 ? done / elapsed_seconds : 0.0;
    bool is_end = done == total;
    hd_progress_time(is_end ? elapsed_seconds : rate > 0.0 ? (total - done) / rate : 0.0, time);
    snprintf(text, 128, "%d/%d frames, %.2f frames/s, %s %s", done, total, rate, time,
             is_end ? "in all" : "left");
}

static void draw_bar(const HdProgress *progress, int done, const char *line) {
    char bar[BAR_WIDTH + 1];
    int filled = (int)((long long)done * BAR_WIDTH / progress->total);
    memset(bar, '.', BAR_WIDTH);
    memset(bar, '#', (size_t)filled);
    bar[BAR_WIDTH] = '\0';
    fprintf(stderr, "\r[%s] %s \033[K", bar, line);
    fflush(stderr);
}

void hd_progress_update(HdProgress *progress, int done) {
    char line[128];
    double now = hd_monotonic_seconds();
    if (progress->form == HD_PROGRESS_NONE)
        return;
    hd_progress_line(done, progress->total, now - progress->start_seconds, line);
    if (progress->form == HD_PROGRESS_BAR) {
        draw_bar(progress, done, line);
    } else if (done < progress->total && now - progress->line_seconds >= SECONDS_BETWEEN_LINES) {
        fprintf(stderr, "%s\n", line);
        progress->line_seconds = now;
    }
}

void hd_progress_end(const HdProgress *progress) {
    if (progress->form == HD_PROGRESS_BAR)
        fprintf(stderr, "\r\033[K");
}

void hd_progress_tell_end(const HdProgress *progress) {
    char line[128];
    if (progress->form != HD_PROGRESS_LINES)
        return;
    hd_progress_line(progress->total, progress->total,
                     hd_monotonic_seconds() - progress->start_seconds, line);
    fprintf(stderr, "%s\n", line);
}
