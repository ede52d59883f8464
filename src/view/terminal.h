/* SPDX-License-Identifier: MIT */
/* The view in a terminal. */
#ifndef HD_VIEW_TERMINAL_H
#define HD_VIEW_TERMINAL_H

#include "run/plan.h"

/* Shows the scene in the terminal that controls this program until the user ends it, and leaves the
   terminal as it was. HD_UNAVAILABLE where there is none, HD_INTERRUPTED after a signal. Names of
   saved pictures and cameras go to standard output; where that is the terminal, at the end. */
HdStatus hd_view_in_terminal(const HdViewPlan *plan, HdError *error);

#endif
