/* SPDX-License-Identifier: MIT */
/* Progress on standard error: a bar where that is a terminal, plain lines elsewhere; or a line for
   each frame, which programs read. */
#ifndef HD_CLI_PROGRESS_H
#define HD_CLI_PROGRESS_H

#include <stdbool.h>
#include <stdint.h>

typedef enum HdProgressForm {
    HD_PROGRESS_NONE,
    HD_PROGRESS_BAR,
    HD_PROGRESS_LINES, /* a line every few seconds */
    HD_PROGRESS_FRAMES /* a line for each frame, and nothing else */
} HdProgressForm;

typedef struct HdProgress {
    HdProgressForm form;
    int total;
    double start_seconds;
    double line_seconds; /* when the last plain line was written */
} HdProgress;

/* A bar on a terminal that can redraw a line. Elsewhere plain lines where they are wanted,
 * otherwise nothing. */
HdProgressForm hd_progress_form(bool wants_lines);

HdProgress hd_progress_start(HdProgressForm form, int total);

/* Before the first frame: shows what is being done, where there is a bar. */
void hd_progress_prepare(const HdProgress *progress, const char *what);

/* After `done` frames, 0 included: redraws the bar, or writes a line, if the last one is long
 * enough ago. */
void hd_progress_update(HdProgress *progress, int done);

/* After frame `number` is stored, the `done`-th of this run: "hedron: frame 17 stored, 3 of 40" on
   a line of its own, where there is a line for each frame. docs/farm.md promises its form. */
void hd_progress_tell_frame(const HdProgress *progress, int number, int done);

/* Takes the bar away, so that a message can be written. */
void hd_progress_end(const HdProgress *progress);

/* After all frames: a last plain line, with the rays of all of them for each second. */
void hd_progress_tell_end(const HdProgress *progress, uint64_t rays);

/* "[####....] line", no wider than `columns`: a line that leaves no room for the bar stands alone,
   and is cut where it is too long itself. */
void hd_progress_bar(int done, int total, const char *line, int columns, char text[160]);

/* "m:ss", or "h:mm:ss" from an hour on; rounded to the nearest second. */
void hd_progress_time(double seconds, char text[32]);

/* "12/120 frames, 1.41 frames/s, 1:16 left"; with all of them done, "..., 1:25 in all". */
void hd_progress_line(int done, int total, double elapsed_seconds, char text[128]);

#endif
