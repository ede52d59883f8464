/* SPDX-License-Identifier: MIT */
/* Straight segments in a plane, cut where they meet. */
#ifndef HD_SCENE_TRIANGULATE_SEGMENTS_H
#define HD_SCENE_TRIANGULATE_SEGMENTS_H

#include <stdbool.h>
#include <stdint.h>

#include "base/vector.h"

/* Points that are no farther apart are one; for coordinates of about 1. */
#define HD_SAME_PLACE 1e-9

/* Starts as {0}. */
typedef struct HdNetwork {
    int point_count, segment_count;
    HdVec2 *points;         /* owned */
    int32_t (*segments)[2]; /* owned; the numbers of their ends */
    int point_room, segment_room;
} HdNetwork;

/* Adds a segment with two points of its own. One that is no longer than HD_SAME_PLACE is left out.
   False: out of memory. */
bool hd_network_add(HdNetwork *network, HdVec2 a, HdVec2 b);

/* Cuts the segments where they cross, touch or overlap, and makes one of points at the same place
   and of segments between the same points. Then segments have nothing but ends in common. False:
   out of memory. */
bool hd_network_cut(HdNetwork *network);

/* Frees what the network owns and clears it. */
void hd_network_free(HdNetwork *network);

#endif
