/* SPDX-License-Identifier: MIT */
/* Numbers that tell what a ray met on which way: samples of neighbouring pixels with different ones
 * see different things, be it in a mirror. */
#ifndef HD_IDENTITY_H
#define HD_IDENTITY_H

#include "surface.h"

/* Rays of less weight have no identity: what they see is hardly seen. */
#define LEAST_IDENTITY_WEIGHT R(0.03125)

enum { PATH_OF_EYE = 1, PATH_MIRRORED = 0x9e3779, PATH_THROUGH = 0x5bd1e9 };

/* Mixes two numbers into one of 24 bits; no product exceeds 31 bits. */
FN vint mix(vint a, vint b) {
    a = ((a ^ b) & HD_IDENTITY_MASK) * 121 & HD_IDENTITY_MASK;
    a = (a ^ (a >> 11)) * 89 & HD_IDENTITY_MASK;
    a = (a ^ (a >> 7)) * 109 & HD_IDENTITY_MASK;
    return a ^ (a >> 13);
}

/* Of the surface that a ray met; a mesh is one thing, but for its skins. */
FN vint identity_of(vint path, const Surface *surface, const Hit *hit) {
    vint met = mix(hit->object + 1, surface->part);
    return mix(path, met);
}

#endif
