/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "cli/progress.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "system/interrupt.h"
#include "system/machine.h"

enum { BAR_WIDTH = 24, SECONDS_BETWEEN_LINES = 5, MAX_HOURS = 99999, USUAL_COLUMNS = 80 };

HdProgressForm hd_progress_form(bool wants_lines) {
    const char *terminal = getenv("TERM");
    bool can_redraw = terminal != NULL && strcmp(terminal, "dumb") != 0;
    if (can_redraw && isatty(STDERR_FILENO))
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
    if (done == 0) {
        snprintf(text, 128, "0/%d frames", total);
        return;
    }
    hd_progress_time(is_end ? elapsed_seconds : rate > 0.0 ? (total - done) / rate : 0.0, time);
    snprintf(text, 128, "%d/%d frames, %.2f frames/s, %s %s", done, total, rate, time,
             is_end ? "in all" : "left");
}

void hd_progress_bar(int done, int total, const char *line, int columns, char text[160]) {
    char bar[BAR_WIDTH + 1];
    int filled = (int)((long long)done * BAR_WIDTH / total);
    bool has_room = BAR_WIDTH + 3 + (int)strlen(line) <= columns;
    memset(bar, '.', BAR_WIDTH);
    memset(bar, '#', (size_t)filled);
    bar[BAR_WIDTH] = '\0';
    if (has_room)
        snprintf(text, 160, "[%s] %s", bar, line);
    else
        snprintf(text, 160, "%.*s", columns, line);
}

static int terminal_columns(void) {
    struct winsize size;
    if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
        return size.ws_col;
    return USUAL_COLUMNS;
}

static void draw(const char *text) {
    fprintf(stderr, "\r%s\033[K", text);
    fflush(stderr);
}

void hd_progress_prepare(const HdProgress *progress, const char *what) {
    if (progress->form == HD_PROGRESS_BAR)
        draw(what);
}

void hd_progress_update(HdProgress *progress, int done) {
    char line[128], bar[160];
    double now = hd_monotonic_seconds();
    bool redraws = progress->form == HD_PROGRESS_BAR || progress->form == HD_PROGRESS_LINES;
    if (!redraws || !hd_wait_to_write(STDERR_FILENO))
        return;
    hd_progress_line(done, progress->total, now - progress->start_seconds, line);
    if (progress->form == HD_PROGRESS_BAR) {
        /* In the last column some terminals begin a new line. */
        hd_progress_bar(done, progress->total, line, terminal_columns() - 1, bar);
        draw(bar);
    } else if (done < progress->total && now - progress->line_seconds >= SECONDS_BETWEEN_LINES) {
        fprintf(stderr, "%s\n", line);
        progress->line_seconds = now;
    }
}

void hd_progress_tell_frame(const HdProgress *progress, int number, int done) {
    if (progress->form == HD_PROGRESS_FRAMES && hd_wait_to_write(STDERR_FILENO))
        fprintf(stderr, "hedron: frame %d stored, %d of %d\n", number, done, progress->total);
}

void hd_progress_end(const HdProgress *progress) {
    if (progress->form == HD_PROGRESS_BAR)
        fprintf(stderr, "\r\033[K");
}

void hd_progress_tell_end(const HdProgress *progress, uint64_t rays) {
    char line[128];
    double elapsed = hd_monotonic_seconds() - progress->start_seconds;
    if (progress->form != HD_PROGRESS_LINES)
        return;
    hd_progress_line(progress->total, progress->total, elapsed, line);
    fprintf(stderr, "%s, %.2f M rays/s\n", line,
            elapsed > 0.0 ? 1e-6 * (double)rays / elapsed : 0.0);
}
