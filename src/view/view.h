/* SPDX-License-Identifier: MIT */
/* A live view of a scene, in a window or in a terminal. */
#ifndef HD_VIEW_VIEW_H
#define HD_VIEW_VIEW_H

#include "run/plan.h"

/* What is shown, and by what. What it points to must live on. */
typedef struct HdViewPlan {
    HdScenePlan scene; /* from a file, which is followed, or built in */
    HdDevicePlan devices;
} HdViewPlan;

/* Shows the scene until the user closes the window. HD_UNAVAILABLE where there is no display,
   HD_INTERRUPTED after a signal. Names of saved pictures and cameras go to standard output. */
HdStatus hd_view_in_window(const HdViewPlan *plan, HdError *error);

/* Shows the scene in the terminal that controls this program until the user ends it, and leaves the
   terminal as it was. HD_UNAVAILABLE where there is none, HD_INTERRUPTED after a signal. Names of
   saved pictures and cameras go to standard output; where that is the terminal, at the end. */
HdStatus hd_view_in_terminal(const HdViewPlan *plan, HdError *error);

#endif
