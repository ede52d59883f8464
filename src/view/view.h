/* SPDX-License-Identifier: MIT */
/* A live view of a scene, in a window or in a terminal. */
#ifndef HD_VIEW_VIEW_H
#define HD_VIEW_VIEW_H

#include "device/renderer.h"
#include "input/scene_file.h"

/* What keys changed of the scene; negative: nothing. */
typedef struct HdSceneChanges {
    int depth, samples_per_side, sampling;
} HdSceneChanges;

/* What is shown, and by what. All that it points to must live on. */
typedef struct HdViewPlan {
    const char *path;             /* of the scene's file, which is followed; NULL: built in */
    const char *backend, *device; /* that are wished for; NULL: any */
    HdRenderOptions render;
    /* Reads the scene anew, and lays the changes over all else that is laid over it. */
    HdStatus (*read)(const void *context, const HdSceneChanges *changes, HdSceneFile *file,
                     HdError *error);
    const void *context;
} HdViewPlan;

/* Shows the scene until the user closes the window. HD_UNAVAILABLE where there is no display,
   HD_INTERRUPTED after a signal. Names of saved pictures and cameras go to standard output. */
HdStatus hd_view_in_window(const HdViewPlan *plan, HdError *error);

/* Shows the scene in the terminal that controls this program until the user ends it, and leaves the
   terminal as it was. HD_UNAVAILABLE where there is none, HD_INTERRUPTED after a signal. Names of
   saved pictures and cameras go to standard output; where that is the terminal, at the end. */
HdStatus hd_view_in_terminal(const HdViewPlan *plan, HdError *error);

#endif
