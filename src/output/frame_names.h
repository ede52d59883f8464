/* SPDX-License-Identifier: MIT */
/* The names of an output's frames, known again in a folder: so that one look at a folder finds what
   is there of them, however many they are. */
#ifndef HD_OUTPUT_FRAME_NAMES_H
#define HD_OUTPUT_FRAME_NAMES_H

#include <stdbool.h>
#include <stddef.h>

#include "output/outputs.h"
#include "scene/frame_list.h"

typedef struct HdFrameNames {
    const HdFrameList *frames; /* ascending, each once */
    char folder[HD_MAX_PATH];  /* of the entries that bear the number; with its last slash; empty:
                                  the  current one */
    char prefix[HD_MAX_PATH];  /* of such an entry's name, up to the number */
    char suffix[HD_MAX_PATH];  /* of its name, after the number */
    char rest[HD_MAX_PATH]; /* of the path after the entry, from its slash on; empty: the entry is
                               the file */
    int digits;             /* of the number at least; 0: there is none, all frames are one file */
} HdFrameNames;

/* The error is that of hd_output_file. `frames` must live on and have a frame. */
HdStatus hd_frame_names_find(HdFrameNames *names, const HdOutput *output, const HdFrameList *frames,
                             HdError *error);

/* The place in the list of the frame whose entry has this name of `length` bytes; negative: none
   has. Of a name that `is_cut` only the begin is known, and it may be any of the frames with such a
   begin. */
int hd_frame_names_place(const HdFrameNames *names, const char *entry, size_t length, bool is_cut);

#endif
