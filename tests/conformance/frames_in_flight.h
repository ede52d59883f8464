/* SPDX-License-Identifier: MIT */
/* Checks frames in flight together, and those that a device encodes by itself. */
#ifndef HD_CONFORMANCE_FRAMES_IN_FLIGHT_H
#define HD_CONFORMANCE_FRAMES_IN_FLIGHT_H

#include "render_scene.h"

/* Renders a picture as radiance and in 8 bits on each curve, several frames in flight, and compares
   each with the frame rendered alone. Prints differences on `label`; adds to the numbers of
   pictures compared and of those that differ. */
void check_frames_in_flight(const Target *target, int *pictures, int *different);

#endif
