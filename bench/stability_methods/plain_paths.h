/* SPDX-License-Identifier: MIT */
/* Paths of mirrors as others follow them: triangles and rays in float, in world coordinates, and
   something against meeting the surface that a ray leaves. None is part of the product. */
#ifndef HD_BENCH_PLAIN_PATHS_H
#define HD_BENCH_PLAIN_PATHS_H

#include "mirror_rooms.h"
#include "triangle_tests.h"

enum { HD_MOST_PLAIN_TRIANGLES = 128 };

typedef struct HdPlainScene {
    int count;
    HdFloatTriangle triangles[HD_MOST_PLAIN_TRIANGLES];
    HdFloat3 normals[HD_MOST_PLAIN_TRIANGLES]; /* unit, outward */
    HdBounce faces[HD_MOST_PLAIN_TRIANGLES];
} HdPlainScene;

enum { HD_AVOIDANCES = 8 };
extern const char *const hd_avoidance_names[HD_AVOIDANCES];

void hd_plain_scene_make(HdPlainScene *scene, const HdRoom *room, HdVec3 centre, double scale);

/* Follows a path of mirrors; returns how many faces it met, at most `most`. */
int hd_plain_path(const HdPlainScene *scene, int avoidance, HdFloat3 eye, HdFloat3 direction,
                  int most, HdBounce *bounces);

#endif
