/* SPDX-License-Identifier: MIT */
/* Displays that a GPU of this machine may be drawing. */
#ifndef HD_SYSTEM_DISPLAY_H
#define HD_SYSTEM_DISPLAY_H

#include <stdbool.h>

/* Where Linux tells of graphics cards and what is plugged into them. */
#define HD_DISPLAY_FOLDER "/sys/class/drm"

/* True where this session has a desktop (DISPLAY, WAYLAND_DISPLAY), or where a display is plugged
   in, as a file "status" of one of the connectors below `folder` tells. Which GPU draws it is not
   asked. */
bool hd_display_may_be_there(const char *folder);

#endif
