/* SPDX-License-Identifier: MIT */
/* Becoming the program that has the window. */
#ifndef HD_VIEW_START_WINDOW_H
#define HD_VIEW_START_WINDOW_H

#include "base/error.h"

/* A copy of the pointers, with a NULL at their end, for free() to free. NULL: no memory. */
char **hd_copy_arguments(char *const *arguments, int count);

/* Runs hedron-view with the program's own arguments instead of this program; it is looked for
   beside it, then in PATH. Returns only where that fails: HD_UNAVAILABLE where there is none. */
HdStatus hd_start_window(char **arguments, HdError *error);

#endif
