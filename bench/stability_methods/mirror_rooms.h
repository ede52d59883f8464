/* SPDX-License-Identifier: MIT */
/* Mirrored solids, and the paths of rays between them in double: independent of the kernels. */
#ifndef HD_BENCH_MIRROR_ROOMS_H
#define HD_BENCH_MIRROR_ROOMS_H

#include <stdbool.h>
#include <stdint.h>

#include "product.h"

enum { HD_MOST_ROOM_SOLIDS = 3 };

/* Convex solids, of circumradius 1 about the origin the first, whose faces mirror on both sides;
   the others lie within the first. */
typedef struct HdRoom {
    int count;
    HdSolidKind kind[HD_MOST_ROOM_SOLIDS];
    HdVec3 degrees[HD_MOST_ROOM_SOLIDS], centre[HD_MOST_ROOM_SOLIDS];
    double radius[HD_MOST_ROOM_SOLIDS];
    HdPlatonic shape[HD_MOST_ROOM_SOLIDS]; /* turned, of circumradius 1 */
} HdRoom;

typedef enum HdRoomKind { HD_ROOM_EMPTY, HD_ROOM_WITH_SOLIDS, HD_ROOM_KINDS } HdRoomKind;

extern const char *const hd_room_names[HD_ROOM_KINDS];

/* `turn` chooses among the solids; turned at random. */
void hd_room_make(HdRoom *room, HdRoomKind kind, int turn, uint64_t *random);

/* A place within the first solid and outside of the others. */
HdVec3 hd_room_eye(const HdRoom *room, uint64_t *random);

/* The faces that a path meets, `count` of them. */
void hd_room_follow(const HdRoom *room, HdVec3 origin, HdVec3 direction, int count,
                    HdBounce *bounces);

#endif
