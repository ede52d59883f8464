/* SPDX-License-Identifier: MIT */
#include "mesh/mesh.h"

/* Ring of the remaining corners, in the plane in which the polygon runs counterclockwise. */
typedef struct Ring {
    int count;
    HdVec2 point[HD_MAX_CONCAVE_CORNERS];
    int16_t next[HD_MAX_CONCAVE_CORNERS], last[HD_MAX_CONCAVE_CORNERS];
    bool is_convex[HD_MAX_CONCAVE_CORNERS];
    bool is_ear[HD_MAX_CONCAVE_CORNERS];
} Ring;

/* Returns Newell's normal, twice the area long: exact for corners in one plane, a mean for
   others. */
static HdVec3 normal_of(const HdVec3 *corners, int count) {
    HdVec3 sum = {0.0, 0.0, 0.0};
    for (int i = 1; i + 1 < count; i++)
        sum = hd_add(sum,
                     hd_cross(hd_sub(corners[i], corners[0]), hd_sub(corners[i + 1], corners[0])));
    return sum;
}

/* Drops the coordinate with the longest normal component, and mirrors clockwise polygons. */
static HdVec2 project(HdVec3 corner, HdVec3 normal) {
    const double x = fabs(normal.x), y = fabs(normal.y), z = fabs(normal.z);
    double sign = normal.z;
    HdVec2 point = {corner.x, corner.y};
    if (x >= y && x >= z) {
        sign = normal.x;
        point = (HdVec2){corner.y, corner.z};
    } else if (y >= z) {
        sign = normal.y;
        point = (HdVec2){corner.z, corner.x};
    }
    if (sign < 0.0)
        point.x = -point.x;
    return point;
}

/* Returns twice the signed area, positive if a, b, c run counterclockwise. */
static double twice_area(HdVec2 a, HdVec2 b, HdVec2 c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/* Returns whether the fan from the first corner covers the polygon. */
static bool is_fan(const HdVec3 *corners, int count, HdVec3 normal) {
    const HdVec2 tip = project(corners[0], normal);
    for (int i = 1; i + 1 < count; i++)
        if (!(twice_area(tip, project(corners[i], normal), project(corners[i + 1], normal)) > 0.0))
            return false;
    return true;
}

static void cut_fan(int count, int32_t (*triangles)[3]) {
    for (int i = 1; i + 1 < count; i++) {
        triangles[i - 1][0] = 0;
        triangles[i - 1][1] = i;
        triangles[i - 1][2] = i + 1;
    }
}

static bool is_same(HdVec2 a, HdVec2 b) {
    return a.x == b.x && a.y == b.y;
}

/* Ignores corners that coincide with the triangle's: bridges to holes have them twice. */
static bool has_inside(const Ring *ring, int last, int corner, int next) {
    const HdVec2 a = ring->point[last], b = ring->point[corner], c = ring->point[next];
    for (int i = ring->next[next]; i != last; i = ring->next[i]) {
        const HdVec2 p = ring->point[i];
        if (ring->is_convex[i] || is_same(p, a) || is_same(p, b) || is_same(p, c))
            continue;
        if (twice_area(a, b, p) >= 0.0 && twice_area(b, c, p) >= 0.0 && twice_area(c, a, p) >= 0.0)
            return true;
    }
    return false;
}

static void look_at_bend(Ring *ring, int corner) {
    const int last = ring->last[corner], next = ring->next[corner];
    ring->is_convex[corner] =
        twice_area(ring->point[last], ring->point[corner], ring->point[next]) > 0.0;
}

static void look_for_ear(Ring *ring, int corner) {
    ring->is_ear[corner] = ring->is_convex[corner] &&
                           !has_inside(ring, ring->last[corner], corner, ring->next[corner]);
}

/* Returns an ear to cut off; `from` if there is none, as in self-intersecting polygons. */
static int find_ear(const Ring *ring, int from) {
    int i = from;
    do {
        if (ring->is_ear[i])
            return i;
        i = ring->next[i];
    } while (i != from);
    return from;
}

static void cut_off(Ring *ring, int corner, int32_t triangle[3]) {
    const int16_t last = ring->last[corner], next = ring->next[corner];
    triangle[0] = last;
    triangle[1] = corner;
    triangle[2] = next;
    ring->next[last] = next;
    ring->last[next] = last;
    ring->count--;
    look_at_bend(ring, last);
    look_at_bend(ring, next);
    look_for_ear(ring, last);
    look_for_ear(ring, next);
}

static void fill_ring(Ring *ring, const HdVec3 *corners, int count, HdVec3 normal) {
    ring->count = count;
    for (int i = 0; i < count; i++) {
        ring->point[i] = project(corners[i], normal);
        ring->next[i] = (int16_t)((i + 1) % count);
        ring->last[i] = (int16_t)((i + count - 1) % count);
    }
    for (int i = 0; i < count; i++)
        look_at_bend(ring, i);
    for (int i = 0; i < count; i++)
        look_for_ear(ring, i);
}

static void cut_ears(const HdVec3 *corners, int count, HdVec3 normal, int32_t (*triangles)[3]) {
    Ring ring;
    int at = 0;
    fill_ring(&ring, corners, count, normal);
    for (int i = 0; i < count - 2; i++) {
        at = find_ear(&ring, at);
        cut_off(&ring, at, triangles[i]);
        at = ring.next[at]; /* the ring's: a removed corner keeps its neighbours */
    }
}

bool hd_polygon_cut(const HdVec3 *corners, int count, int32_t (*triangles)[3]) {
    const HdVec3 normal = normal_of(corners, count);
    if (count == 3 || is_fan(corners, count, normal)) {
        cut_fan(count, triangles);
        return true;
    }
    if (count > HD_MAX_CONCAVE_CORNERS)
        return false;
    cut_ears(corners, count, normal, triangles);
    return true;
}
