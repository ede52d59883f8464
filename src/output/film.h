/* SPDX-License-Identifier: MIT */
/* Makes a film of a run's frames: in one go, or in segments that are joined at the end without
   encoding again. A GIF, whose segments are lossless, is encoded then. */
#ifndef HD_OUTPUT_FILM_H
#define HD_OUTPUT_FILM_H

#include <stdbool.h>
#include <stdint.h>

#include "output/outputs.h"
#include "output/video.h"
#include "scene/frame_list.h"

/* ---- segments of an unfinished film: complete films of at least a second, next to the film until
   they are joined, so that an interrupted run can resume ---- */

/* Least frames of a segment except the last; fewer take less time than starting FFmpeg. */
enum { HD_MIN_SEGMENT = 24 };

/* Infix between the film's name and a segment's. */
#define HD_SEGMENT_INFIX ".part-"

typedef struct HdSegments {
    char film[HD_MAX_PATH]; /* path; empty: the output is no film */
    int frame_count;        /* frames of the whole film */
    int length;             /* frames of each segment but the last, in whole seconds */
    int count;       /* number of segments; 1: the film is made in one go, without segments */
    uint64_t *names; /* owned; fingerprint of each segment */
    bool *is_whole;  /* owned; whether the complete file exists */
} HdSegments;

/* Divides the film of these frames into segments if the plan keeps them, and finds existing ones if
   it resumes. Free `segments` also after a failure. */
HdStatus hd_segments_find(HdSegments *segments, const HdOutputPlan *plan, const HdOutput *output,
                          const HdFrameList *frames, HdError *error);

/* Returns whether the frame at index `item` of the list is in a complete segment. */
bool hd_segments_have(const HdSegments *segments, int item);

/* Returns the number of frames in the segment. */
int hd_segment_frames(const HdSegments *segments, int index);

/* Writes the segment's path: "FILM.part-INDEX-NAME". */
HdStatus hd_segment_path(const HdSegments *segments, int index, char out[HD_MAX_PATH],
                         HdError *error);

/* Removes the segments of this film and of earlier films of that name. */
void hd_segments_remove(const HdSegments *segments);

void hd_segments_free(HdSegments *segments);

typedef struct HdFilm HdFilm;

/* Starts FFmpeg for the first missing frames. Keeps the pointers; updates `segments` as segments
   become complete. Fails with HD_UNAVAILABLE if FFmpeg is missing. */
HdStatus hd_film_open(HdFilm **film, HdSegments *segments, const HdOutputPlan *plan, int width,
                      int height, HdError *error);

/* Adds the frame at index `item` of the list, in order, except frames of segments that were
   complete at opening. For one thread. Blocks while FFmpeg is busy and while the previous segment
   is ending; after the last frame until all segments have their names. */
HdStatus hd_film_add(HdFilm *film, int item, const HdFrame *frame, HdError *error);

/* Completes and renames the film, and removes the segments. Frees `film` also on failure, which
   leaves only complete segments. */
HdStatus hd_film_close(HdFilm *film, HdError *error);

/* Stops FFmpeg, keeps complete segments (marked in `segments`), frees `film`. */
void hd_film_abort(HdFilm *film);

#endif
