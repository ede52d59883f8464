/* SPDX-License-Identifier: MIT */
/* A film made of the frames of a run: in one go, or by segments that are joined at the end without
   encoding again (a GIF, whose segments lose nothing, is encoded then). */
#ifndef HD_OUTPUT_FILM_H
#define HD_OUTPUT_FILM_H

#include "output/segments.h"
#include "output/video.h"

typedef struct HdFilm HdFilm;

/* Starts FFmpeg for the first frames that are missing. What is pointed to must live on; `segments`
   learns which become whole. HD_UNAVAILABLE where FFmpeg is missing. */
HdStatus hd_film_open(HdFilm **film, HdSegments *segments, int width, int height,
                      const HdOutputStyle *style, HdDurability durability, HdError *error);

/* Takes the frame at that place of the list, in their order; not one of a segment that was whole
   when the film was opened. Blocks while FFmpeg is busy, while the segment before
   this one is still being ended, and after the last frame until all of them have their names. By
   one thread, which lives that long: FFmpeg ends with the thread that started it. */
HdStatus hd_film_add(HdFilm *film, int item, const HdFrame *frame, HdError *error);

/* Ends the film, which gets its name, and removes the segments. Frees `film` in every case; on
   failure only whole segments are left. */
HdStatus hd_film_close(HdFilm *film, HdError *error);

/* Stops FFmpeg, leaves whole segments, which `segments` knows then, frees `film`. */
void hd_film_abort(HdFilm *film);

#endif
