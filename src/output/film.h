/* SPDX-License-Identifier: MIT */
/* A film made of the frames of a run: in one go, or by segments that are joined at the end without
   encoding again (a GIF, whose segments lose nothing, is encoded then). */
#ifndef HD_OUTPUT_FILM_H
#define HD_OUTPUT_FILM_H

#include <stdbool.h>
#include <stdint.h>

#include "output/outputs.h"
#include "output/video.h"
#include "scene/frame_list.h"

/* ---- the segments of a film that is being made: films of a second or more, which stand whole
   beside it until they are joined, so that a run that was ended goes on behind them ---- */

/* The fewest frames of a segment, the last one excepted: starting FFmpeg takes longer. */
enum { HD_MIN_SEGMENT = 24 };

/* What is between the film's name and a segment's. */
#define HD_SEGMENT_INFIX ".part-"

typedef struct HdSegments {
    char film[HD_MAX_PATH]; /* its file; empty: the output is no film */
    int frame_count;        /* of the film */
    int length;             /* frames of each segment but the last: whole seconds */
    int count;              /* 1: the film is made in one go, and has no segments */
    uint64_t *names;        /* owned; what decides the bytes of each segment, as a number */
    bool *is_whole;         /* owned; it is there */
} HdSegments;

/* Cuts the film of these frames into segments, where the plan keeps them, and looks for those that
   are there, if it resumes. To be freed in any case. */
HdStatus hd_segments_find(HdSegments *segments, const HdOutputPlan *plan, const HdOutput *output,
                          const HdFrameList *frames, HdError *error);

/* Whether the frame at that place of the list is in a segment that is whole. */
bool hd_segments_have(const HdSegments *segments, int item);

/* How many frames the segment has. */
int hd_segment_frames(const HdSegments *segments, int index);

/* Its file: "FILM.part-INDEX-NAME". */
HdStatus hd_segment_path(const HdSegments *segments, int index, char out[HD_MAX_PATH],
                         HdError *error);

/* Removes the segments of this and of earlier films of that name. */
void hd_segments_remove(const HdSegments *segments);

void hd_segments_free(HdSegments *segments);

typedef struct HdFilm HdFilm;

/* Starts FFmpeg for the first frames that are missing. What is pointed to must live on; `segments`
   learns which become whole. HD_UNAVAILABLE where FFmpeg is missing. */
HdStatus hd_film_open(HdFilm **film, HdSegments *segments, const HdOutputPlan *plan, int width,
                      int height, HdError *error);

/* Takes the frame at that place of the list, in their order; not one of a segment that was whole
   when the film was opened. By one thread. Blocks while FFmpeg is busy, while the segment before
   this one is still being ended, and after the last frame until all of them have their names. */
HdStatus hd_film_add(HdFilm *film, int item, const HdFrame *frame, HdError *error);

/* Ends the film, which gets its name, and removes the segments. Frees `film` in every case; on
   failure only whole segments are left. */
HdStatus hd_film_close(HdFilm *film, HdError *error);

/* Stops FFmpeg, leaves whole segments, which `segments` knows then, frees `film`. */
void hd_film_abort(HdFilm *film);

#endif
