/* SPDX-License-Identifier: MIT */
/* Lists of frames such as "0-9,20,30-90:2". */
#ifndef HD_SCENE_FRAME_LIST_H
#define HD_SCENE_FRAME_LIST_H

#include <stdbool.h>

#include "base/error.h"

typedef struct HdFrameList {
    int count;
    int *frames; /* owned; ascending, without repetition */
} HdFrameList;

/* Parses numbers and ascending ranges, which may have a step, separated by commas, and merges
   overlaps. Frames are numbered from 0 to frame_count - 1; NULL stands for all of them. */
HdStatus hd_frame_list_parse(HdFrameList *list, const char *text, int frame_count, HdError *error);

/* Writes the frames whose mark is `wanted`, one mark for each of the list, as the parser takes
   them. False: there is no room for all of them, and the text ends in ",...". */
enum { HD_FRAMES_TEXT = 64 };
void hd_frame_list_write(const HdFrameList *list, const bool *marks, bool wanted,
                         char text[HD_FRAMES_TEXT]);

void hd_frame_list_free(HdFrameList *list);

#endif
