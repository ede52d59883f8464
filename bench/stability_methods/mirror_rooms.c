/* SPDX-License-Identifier: MIT */
#include "mirror_rooms.h"

#include "../../scenes/models/random.h"
#include "shapes.h"

const char *const hd_room_names[HD_ROOM_KINDS] = {"inside", "between"};

static void add(HdRoom *room, HdSolidKind kind, HdVec3 centre, double radius, uint64_t *random) {
    int n = room->count++;
    room->kind[n] = kind;
    room->centre[n] = centre;
    room->radius[n] = radius;
    room->degrees[n] = hd_random_turn(random);
    hd_platonic(kind, &room->shape[n]);
    hd_platonic_rotate(&room->shape[n], room->degrees[n]);
}

void hd_room_make(HdRoom *room, HdRoomKind kind, int turn, uint64_t *random) {
    HdVec3 origin = hd_vec3(0.0, 0.0, 0.0), aside = hd_vec3(0.2511, -0.1037, 0.0892);
    room->count = 0;
    if (kind == HD_ROOM_EMPTY) {
        add(room, (HdSolidKind)(turn % HD_SOLID_KIND_COUNT), origin, 1.0, random);
        return;
    }
    add(room, turn % 2 == 0 ? HD_HEXAHEDRON : HD_DODECAHEDRON, origin, 1.0, random);
    add(room, (HdSolidKind)(turn % HD_SOLID_KIND_COUNT), aside, 0.24, random);
    add(room, (HdSolidKind)((turn + 2) % HD_SOLID_KIND_COUNT), hd_scale(aside, -1.0), 0.24, random);
}

static double height(const HdRoom *room, int solid, int face, HdVec3 point) {
    const HdPlatonic *shape = &room->shape[solid];
    return hd_dot(shape->face_normal[face], hd_sub(point, room->centre[solid])) -
           shape->inradius * room->radius[solid];
}

static bool is_within(const HdRoom *room, int solid, HdVec3 point, double margin) {
    for (int face = 0; face < room->shape[solid].face_count; face++)
        if (height(room, solid, face, point) > margin)
            return false;
    return true;
}

HdVec3 hd_room_eye(const HdRoom *room, uint64_t *random) {
    for (;;) {
        HdVec3 eye = hd_scale(hd_random_direction(random), random_between(random, 0.0, 0.6));
        bool fits = is_within(room, 0, eye, -0.05);
        for (int s = 1; s < room->count && fits; s++)
            fits = !is_within(room, s, eye, 0.02);
        if (fits)
            return eye;
    }
}

/* Where a path goes on: the solid and the face, and how far away. */
typedef struct Next {
    double t;
    HdBounce at;
} Next;

/* Out of a solid that the ray runs within. */
static void leave(const HdRoom *room, int solid, HdVec3 origin, HdVec3 direction, Next *next) {
    for (int face = 0; face < room->shape[solid].face_count; face++) {
        double slope = hd_dot(room->shape[solid].face_normal[face], direction);
        if (!(slope > 0.0))
            continue;
        double t = fmax(-height(room, solid, face, origin), 0.0) / slope;
        if (t < next->t)
            *next = (Next){t, {solid, face}};
    }
}

static void enter(const HdRoom *room, int solid, HdVec3 origin, HdVec3 direction, Next *next) {
    double in = 0.0, out = next->t;
    int entered = -1;
    for (int face = 0; face < room->shape[solid].face_count; face++) {
        double slope = hd_dot(room->shape[solid].face_normal[face], direction);
        double away = height(room, solid, face, origin);
        if (slope < 0.0 && -away / slope > in) {
            in = -away / slope;
            entered = face;
        } else if (slope > 0.0) {
            out = fmin(out, -away / slope);
        } else if (away > 0.0 && slope >= 0.0) {
            return;
        }
    }
    if (entered >= 0 && in < out)
        *next = (Next){in, {solid, entered}};
}

void hd_room_follow(const HdRoom *room, HdVec3 origin, HdVec3 direction, int count,
                    HdBounce *bounces) {
    int last = -1;
    for (int i = 0; i < count; i++) {
        Next next = {.t = 1e30};
        leave(room, 0, origin, direction, &next);
        for (int s = 1; s < room->count; s++)
            if (s != last)
                enter(room, s, origin, direction, &next);
        bounces[i] = next.at;
        last = next.at.object;
        HdVec3 normal = room->shape[last].face_normal[next.at.face];
        origin = hd_add(origin, hd_scale(direction, next.t));
        direction = hd_sub(direction, hd_scale(normal, 2.0 * hd_dot(normal, direction)));
    }
}
