/* SPDX-License-Identifier: MIT */
/* Frames whose pixels are known from mathematics. */
#ifndef HD_CONFORMANCE_TRUTHS_H
#define HD_CONFORMANCE_TRUTHS_H

#include "truth_check.h"

/* Renders every truth with an open renderer and prints those that fail. */
void check_truths(const Target *target, int *checked, int *failed);

/* Those of one theme. */
void check_first_hits(Check *check);
void check_geometry(Check *check);
void check_shading(Check *check);
void check_lights(Check *check);
void check_rotation(Check *check);
void check_refraction(Check *check);
void check_sides(Check *check);
void check_invariance(Check *check);

#endif
