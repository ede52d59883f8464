/* SPDX-License-Identifier: MIT */
/* Trees of rays as others follow them: triangles and rays in float, in world coordinates. None is
   part of the product. */
#ifndef HD_BENCH_PLAIN_TREES_H
#define HD_BENCH_PLAIN_TREES_H

#include "plain_paths.h"

/* A material of the model's, grey. */
typedef struct HdGrey {
    float colour, diffuse, reflection, transmission;
} HdGrey;

typedef struct HdPlainPicture {
    HdPlainScene scene;
    const HdGrey *materials; /* of the objects */
    HdFloat3 eye, light;     /* of intensity 1 */
    int depth;
} HdPlainPicture;

/* What the eye sees in a direction, of unit length. */
float hd_plain_seen(const HdPlainPicture *picture, int avoidance, HdFloat3 direction);

#endif
