/* SPDX-License-Identifier: MIT */
/* From what the user asked for to the devices that render together, which may be one. */
#ifndef HD_CHOICE_DEVICES_H
#define HD_CHOICE_DEVICES_H

#include "choice/candidates.h"

typedef struct HdDeviceTeam {
    HdTeamDevice list[HD_MOST_TRACERS]; /* open */
    int count;
    HdPrecision precision; /* that was asked for */
    char note[4096];       /* worth telling unasked; empty: nothing is */
    char why[8192];        /* why these devices, and why others were passed over */
} HdDeviceTeam;

/* Opens a device that can do what the wish's options ask: the best candidate (candidates.h), or,
   where nobody named one, the fastest (hd_candidates_open): among GPUs where one is preferred, else
   among GPUs and plain C. Where a GPU was preferred, no backend was named and there is none, a note
   says so in a sentence.

   Or opens several: a list as in "cuda:0,cuda:1,c:0", each part of which names one as a single
   device is named, or "all". All are those of every backend, or of the one that is named, that can
   do what the options ask; what cannot be opened is left out, and so are GPUs by OpenCL that the
   team has by CUDA, and CPUs of other backends than plain C unless their backend is named; the note
   tells of what is left out because it fails. Plain C beside GPUs leaves a core to each of them. A
   device of a list that cannot be opened is an error, and one that is named twice is HD_BAD_INPUT,
   as are several where the wish is for one. On failure nothing is open. */
HdStatus hd_open_devices(HdDeviceTeam *team, const HdDeviceWish *wish, HdError *error);

void hd_close_devices(HdDeviceTeam *team);

#endif
