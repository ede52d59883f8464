/* SPDX-License-Identifier: MIT */
/* The view in a window of the desktop, by SDL 2. */
#ifndef HD_VIEW_WINDOW_H
#define HD_VIEW_WINDOW_H

#include "run/plan.h"

/* Shows the scene until the user closes the window. HD_UNAVAILABLE where there is no display,
   HD_INTERRUPTED after a signal. Names of saved pictures and cameras go to standard output. */
HdStatus hd_view_in_window(const HdViewPlan *plan, HdError *error);

#endif
