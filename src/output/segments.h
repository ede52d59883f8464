/* SPDX-License-Identifier: MIT */
/* The segments of a film that is being made: films of a second or more, which stand whole beside it
   until they are joined, so that a run that was ended goes on behind them. */
#ifndef HD_OUTPUT_SEGMENTS_H
#define HD_OUTPUT_SEGMENTS_H

#include <stdbool.h>
#include <stdint.h>

#include "base/error.h"
#include "output/outputs.h"
#include "scene/frame_list.h"

/* The fewest frames of a segment, the last one excepted: starting FFmpeg takes longer. */
enum { HD_LEAST_SEGMENT = 24 };

typedef struct HdSegments {
    char film[HD_MAX_PATH]; /* its file; empty: the output is no film */
    int frame_count;        /* of the film */
    int length;             /* frames of each segment but the last: whole seconds */
    int count;              /* 1: the film is made in one go, and has no segments */
    uint64_t *names;        /* owned; what decides the bytes of each segment, as a number */
    bool *is_whole;         /* owned; it is there */
} HdSegments;

/* Cuts the film of these frames into segments, where the plan keeps them, and looks for those that
   are there, if it resumes. What a killed run was writing to is removed. To be freed in any case.
 */
HdStatus hd_segments_find(HdSegments *segments, const HdOutputPlan *plan, const HdOutput *output,
                          const HdFrameList *frames, HdError *error);

/* Whether the frame at that place of the list is in a segment that is whole. */
bool hd_segments_have(const HdSegments *segments, int item);

/* The place of its first frame, and how many it has. */
int hd_segment_begin(const HdSegments *segments, int index);
int hd_segment_frames(const HdSegments *segments, int index);

/* Its file: "FILM.part-INDEX-NAME". */
HdStatus hd_segment_path(const HdSegments *segments, int index, char out[HD_MAX_PATH],
                         HdError *error);

/* Removes the segments of this and of earlier films of that name. */
void hd_segments_remove(const HdSegments *segments);

void hd_segments_free(HdSegments *segments);

#endif
