/* SPDX-License-Identifier: MIT */
/* Angles between vectors, whose bytes do not depend on a system's mathematics library. */
#ifndef HD_BASE_ANGLE_H
#define HD_BASE_ANGLE_H

#include "base/vector.h"

/* The angle between two vectors of any length in radians, 0..pi, within 1e-15; 0 where one of them
   is 0. */
double hd_angle(HdVec3 a, HdVec3 b);

#endif
