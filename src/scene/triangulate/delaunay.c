/* SPDX-License-Identifier: MIT */
#include "scene/triangulate/delaunay.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "base/growth.h"

/* Edge i of a triangle runs from corner i to corner i + 1. */
typedef struct Triangle {
    int32_t corner[3];
    int32_t beyond[3]; /* the triangle on the other side of each edge, -1: none */
    bool is_fixed[3];  /* the edge is one of the segments */
} Triangle;

/* Points of an edge that is to be turned. */
typedef struct Crossed {
    int32_t a, b;
} Crossed;

typedef struct Work {
    const HdVec2 *points;
    int count;
    Triangle *triangles;
    int32_t *one_at; /* of each point, one of the triangles about it */
    int32_t *stack;  /* triangles to look at; four for each point */
    int last;        /* where the last point was found */
    int crossed_first, crossed_count, crossed_room;
    Crossed *crossed; /* edges that a segment crosses, from the first on that is left */
    bool is_broken;   /* outlines lie too near to each other; otherwise what fails is memory */
} Work;

/* The edge of a triangle. */
typedef struct Side {
    int triangle, edge;
} Side;

static bool fail_broken(Work *work) {
    work->is_broken = true;
    return false;
}

static int next(int i) {
    return i == 2 ? 0 : i + 1;
}

static int before(int i) {
    return i == 0 ? 2 : i - 1;
}

/* Twice the area of the triangle, positive where it is counterclockwise. */
static double area(const Work *work, int a, int b, int c) {
    const HdVec2 *p = work->points;
    return hd_cross2(hd_sub2(p[b], p[a]), hd_sub2(p[c], p[a]));
}

static int index_of(const Triangle *triangle, int point) {
    return triangle->corner[0] == point ? 0 : triangle->corner[1] == point ? 1 : 2;
}

/* Lets a triangle border on `to` where it bordered on `from`. */
static void relink(const Work *work, int triangle, int from, int to) {
    if (triangle < 0)
        return;
    int32_t *beyond = work->triangles[triangle].beyond;
    for (int i = 0; i < 3; i++)
        if (beyond[i] == from) {
            beyond[i] = to;
            return;
        }
}

static void set_triangle(Work *work, int number, int a, int b, int c) {
    Triangle *triangle = &work->triangles[number];
    *triangle = (Triangle){.corner = {a, b, c}, .beyond = {-1, -1, -1}};
    work->one_at[a] = work->one_at[b] = work->one_at[c] = number;
}

/* Sets what is beyond an edge. */
static void join(Work *work, int triangle, int edge, int beyond, bool is_fixed) {
    work->triangles[triangle].beyond[edge] = beyond;
    work->triangles[triangle].is_fixed[edge] = is_fixed;
}

/* Lets an edge of a new triangle be that of a former one, whose number was `from`. */
static void inherit(Work *work, int triangle, int edge, const Triangle *old, int old_edge,
                    int from) {
    join(work, triangle, edge, old->beyond[old_edge], old->is_fixed[old_edge]);
    relink(work, old->beyond[old_edge], from, triangle);
}

/* The same edge as the triangle beyond it has it. */
static Side opposite(const Work *work, Side side) {
    const Triangle *triangle = &work->triangles[side.triangle];
    int other = triangle->beyond[side.edge];
    return (Side){other, index_of(&work->triangles[other], triangle->corner[next(side.edge)])};
}

/* Puts the other diagonal of the quadrilateral about an edge in its place: of a, d, b, c about a-b
   become a, d, c and d, b, c. */
static void flip(Work *work, Side side) {
    Side back = opposite(work, side);
    int t = side.triangle, u = back.triangle;
    Triangle left = work->triangles[t], right = work->triangles[u];
    int i = side.edge, j = back.edge;
    int a = left.corner[i], b = right.corner[j];
    int c = left.corner[before(i)], d = right.corner[before(j)];
    set_triangle(work, t, a, d, c);
    set_triangle(work, u, d, b, c);
    inherit(work, t, 0, &right, next(j), u);
    join(work, t, 1, u, false);
    inherit(work, t, 2, &left, before(i), t);
    inherit(work, u, 0, &right, before(j), u);
    inherit(work, u, 1, &left, next(i), t);
    join(work, u, 2, t, false);
}

/* Whether the angles against an edge are more than half a turn together, by more than rounding:
   then the other diagonal of the quadrilateral is the better one, and lies within it. */
static bool should_flip(const Work *work, Side side) {
    const Triangle *triangle = &work->triangles[side.triangle];
    if (triangle->beyond[side.edge] < 0 || triangle->is_fixed[side.edge])
        return false;
    Side back = opposite(work, side);
    const HdVec2 *p = work->points;
    HdVec2 a = p[triangle->corner[side.edge]], b = p[triangle->corner[next(side.edge)]];
    HdVec2 c = p[triangle->corner[before(side.edge)]];
    HdVec2 d = p[work->triangles[back.triangle].corner[before(back.edge)]];
    HdVec2 ca = hd_sub2(a, c), cb = hd_sub2(b, c), da = hd_sub2(a, d), db = hd_sub2(b, d);
    double sine = hd_cross2(ca, cb) * hd_dot2(db, da) + hd_dot2(ca, cb) * hd_cross2(db, da);
    double size = hd_length2(ca) * hd_length2(cb) * hd_length2(da) * hd_length2(db);
    return sine < -1e-10 * size;
}

/* Flips what should be flipped about a point that was put in last; the triangles about it are on
   the stack. */
static void settle(Work *work, int point, int waiting) {
    while (waiting > 0) {
        int t = work->stack[--waiting];
        Side side = {t, next(index_of(&work->triangles[t], point))};
        if (!should_flip(work, side))
            continue;
        int u = work->triangles[t].beyond[side.edge];
        flip(work, side);
        work->stack[waiting++] = t;
        work->stack[waiting++] = u;
    }
}

/* How far a point is to the left of an edge. */
static double distance_from(const Work *work, Side side, int point) {
    const int32_t *corner = work->triangles[side.triangle].corner;
    int a = corner[side.edge], b = corner[next(side.edge)];
    return area(work, a, b, point) / hd_length2(hd_sub2(work->points[b], work->points[a]));
}

/* The edge of a triangle that a point is the least far to the left of. */
static Side nearest_edge(const Work *work, int t, int point, double *distance) {
    Side nearest = {t, 0};
    *distance = distance_from(work, nearest, point);
    for (int i = 1; i < 3; i++) {
        double left = distance_from(work, (Side){t, i}, point);
        if (left < *distance) {
            *distance = left;
            nearest.edge = i;
        }
    }
    return nearest;
}

/* Finds the triangle that a point lies in, and its edge that is the nearest to it. A walk towards
   the point comes to an end, as the triangles are Delaunay's; it would only go back over an edge
   that the point is on up to rounding. */
static bool find_point(const Work *work, int point, Side *nearest, double *distance) {
    int t = work->last, from = -1;
    for (int moves = 0; moves < 4 * work->count; moves++) {
        *nearest = nearest_edge(work, t, point, distance);
        int beyond = work->triangles[t].beyond[nearest->edge];
        if (*distance >= 0.0 || beyond < 0 || beyond == from)
            return true;
        from = t;
        t = beyond;
    }
    return false;
}

/* a, b, c become a, b, p and b, c, p and c, a, p. */
static void split_triangle(Work *work, int t, int point) {
    Triangle old = work->triangles[t];
    int part[3] = {t, work->count, work->count + 1};
    work->count += 2;
    for (int i = 0; i < 3; i++)
        set_triangle(work, part[i], old.corner[i], old.corner[next(i)], point);
    for (int i = 0; i < 3; i++) {
        inherit(work, part[i], 0, &old, i, t);
        join(work, part[i], 1, part[next(i)], false);
        join(work, part[i], 2, part[before(i)], false);
        work->stack[i] = part[i];
    }
    settle(work, point, 3);
}

/* Of a, b, c, whose edge a-b is a part of the polygon's side, become a, p, c and p, b, c. */
static void split_side(Work *work, Side side, int point) {
    Triangle old = work->triangles[side.triangle];
    int i = side.edge, t = side.triangle, u = work->count++;
    int a = old.corner[i], b = old.corner[next(i)], c = old.corner[before(i)];
    set_triangle(work, t, a, point, c);
    set_triangle(work, u, point, b, c);
    join(work, t, 1, u, false);
    inherit(work, t, 2, &old, before(i), t);
    inherit(work, u, 1, &old, next(i), t);
    join(work, u, 2, t, false);
    work->stack[0] = t;
    work->stack[1] = u;
    settle(work, point, 2);
}

/* A point on an inner edge makes a flat triangle, which is flipped at once. */
static bool insert_point(Work *work, int point) {
    static const double on_side = 1e-12;
    Side nearest = {0, 0};
    double distance = 0.0;
    if (!find_point(work, point, &nearest, &distance))
        return fail_broken(work);
    if (distance < on_side && work->triangles[nearest.triangle].beyond[nearest.edge] < 0)
        split_side(work, nearest, point);
    else
        split_triangle(work, nearest.triangle, point);
    work->last = work->one_at[point];
    return true;
}

static void start_with_fan(Work *work, int corner_count) {
    work->count = corner_count - 2;
    for (int i = 0; i < work->count; i++)
        set_triangle(work, i, 0, i + 1, i + 2);
    for (int i = 1; i < work->count; i++) {
        join(work, i - 1, 2, i, false);
        join(work, i, 0, i - 1, false);
    }
}

/* The first of the triangles about a point, clockwise, or any where they go all round. */
static int first_about(const Work *work, int point) {
    int start = work->one_at[point], t = start;
    for (;;) {
        int clockwise = work->triangles[t].beyond[index_of(&work->triangles[t], point)];
        if (clockwise < 0 || clockwise == start)
            return t;
        t = clockwise;
    }
}

/* The next one, counterclockwise; -1: there is none. */
static int next_about(const Work *work, int t, int point, int first) {
    int following = work->triangles[t].beyond[before(index_of(&work->triangles[t], point))];
    return following == first ? -1 : following;
}

/* Finds the edge from a to b, on either side. */
static bool find_edge(const Work *work, int a, int b, Side *side) {
    int first = first_about(work, a);
    for (int t = first; t >= 0; t = next_about(work, t, a, first)) {
        const Triangle *triangle = &work->triangles[t];
        int i = index_of(triangle, a);
        *side = (Side){t, triangle->corner[next(i)] == b ? i : before(i)};
        if (triangle->corner[next(i)] == b || triangle->corner[before(i)] == b)
            return true;
    }
    return false;
}

static void fix_edge(Work *work, Side side) {
    Triangle *triangle = &work->triangles[side.triangle];
    triangle->is_fixed[side.edge] = true;
    if (triangle->beyond[side.edge] >= 0) {
        Side back = opposite(work, side);
        work->triangles[back.triangle].is_fixed[back.edge] = true;
    }
}

/* Finds the triangle at a that the segment to b leaves through the edge against a. */
static bool find_first_crossed(const Work *work, int a, int b, Side *crossed) {
    int first = first_about(work, a);
    for (int t = first; t >= 0; t = next_about(work, t, a, first)) {
        const Triangle *triangle = &work->triangles[t];
        int i = index_of(triangle, a);
        *crossed = (Side){t, next(i)};
        if (area(work, a, triangle->corner[next(i)], b) > 0.0 &&
            area(work, a, triangle->corner[before(i)], b) < 0.0)
            return true;
    }
    return false;
}

static bool add_crossed(Work *work, int a, int b) {
    const Crossed edge = {a, b};
    return hd_append(&work->crossed, sizeof edge, &work->crossed_count, &work->crossed_room, &edge);
}

/* Lists the edges that the segment from a to b crosses. */
static bool list_crossed(Work *work, int a, int b) {
    Side side;
    work->crossed_first = work->crossed_count = 0;
    if (!find_first_crossed(work, a, b, &side))
        return fail_broken(work);
    for (;;) {
        const Triangle *triangle = &work->triangles[side.triangle];
        if (triangle->is_fixed[side.edge] || triangle->beyond[side.edge] < 0)
            return fail_broken(work);
        if (!add_crossed(work, triangle->corner[side.edge], triangle->corner[next(side.edge)]))
            return false;
        side = opposite(work, side);
        int tip = work->triangles[side.triangle].corner[before(side.edge)];
        if (tip == b)
            return true;
        side.edge = area(work, a, b, tip) > 0.0 ? next(side.edge) : before(side.edge);
    }
}

/* The corners of the quadrilateral about an edge that are not on it. */
static void tips_of(const Work *work, Side side, int tips[2]) {
    Side back = opposite(work, side);
    tips[0] = work->triangles[side.triangle].corner[before(side.edge)];
    tips[1] = work->triangles[back.triangle].corner[before(back.edge)];
}

static bool crosses(const Work *work, const int tips[2], int a, int b) {
    if (tips[0] == a || tips[0] == b || tips[1] == a || tips[1] == b)
        return false;
    return (area(work, a, b, tips[0]) > 0.0) != (area(work, a, b, tips[1]) > 0.0);
}

/* Whether the quadrilateral about an edge has a second diagonal, more than rounding inside. */
static bool is_convex(const Work *work, Crossed edge, const int tips[2]) {
    static const double least = 1e-12;
    double length = hd_length2(hd_sub2(work->points[tips[1]], work->points[tips[0]]));
    double a = area(work, tips[0], tips[1], edge.a) / length;
    double b = area(work, tips[0], tips[1], edge.b) / length;
    return (a > least && b < -least) || (a < -least && b > least);
}

/* Flips the crossed edges, each when its quadrilateral is convex, until none crosses. */
static bool turn_crossed(Work *work, int a, int b) {
    int put_off = 0;
    while (work->crossed_first < work->crossed_count) {
        Crossed edge = work->crossed[work->crossed_first++];
        Side side;
        int tips[2];
        if (!find_edge(work, edge.a, edge.b, &side) ||
            put_off > work->crossed_count - work->crossed_first)
            return fail_broken(work);
        tips_of(work, side, tips);
        bool can_flip = is_convex(work, edge, tips);
        put_off = can_flip ? 0 : put_off + 1;
        if (can_flip) {
            flip(work, side);
            edge = (Crossed){tips[0], tips[1]};
        }
        if ((!can_flip || crosses(work, tips, a, b)) && !add_crossed(work, edge.a, edge.b))
            return false;
    }
    return true;
}

static bool insert_segment(Work *work, int a, int b) {
    Side side = {0, 0};
    if (!find_edge(work, a, b, &side)) {
        if (!list_crossed(work, a, b) || !turn_crossed(work, a, b))
            return false;
        if (!find_edge(work, a, b, &side))
            return fail_broken(work);
    }
    fix_edge(work, side);
    return true;
}

static void settle_all(Work *work) {
    for (bool changed = true; changed;) {
        changed = false;
        for (int t = 0; t < work->count; t++)
            for (int i = 0; i < 3; i++)
                if (should_flip(work, (Side){t, i})) {
                    flip(work, (Side){t, i});
                    changed = true;
                }
    }
}

static bool build(Work *work, int point_count, int corner_count, const int32_t (*segments)[2],
                  int segment_count) {
    start_with_fan(work, corner_count);
    for (int p = corner_count; p < point_count; p++)
        if (!insert_point(work, p))
            return false;
    for (int s = 0; s < segment_count; s++)
        if (!insert_segment(work, segments[s][0], segments[s][1]))
            return false;
    settle_all(work);
    return true;
}

static HdStatus fail(const Work *work, HdError *error) {
    if (work->is_broken)
        return hd_fail(error, HD_FAILED,
                       "the outlines on a face lie too near to each other to be told apart");
    return hd_fail(error, HD_FAILED, "out of memory: a face has too many triangles");
}

HdStatus hd_triangulate_plane(const HdVec2 *points, int point_count, int corner_count,
                              const int32_t (*segments)[2], int segment_count,
                              int32_t (*triangles)[3], int *triangle_count, HdError *error) {
    size_t room = 2 * (size_t)point_count;
    Work work = {.points = points,
                 .triangles = calloc(room, sizeof *work.triangles),
                 .one_at = calloc(room, sizeof *work.one_at),
                 .stack = calloc(2 * room, sizeof *work.stack)};
    const bool is_done = work.triangles != NULL && work.one_at != NULL && work.stack != NULL &&
                         build(&work, point_count, corner_count, segments, segment_count);
    *triangle_count = is_done ? work.count : 0;
    for (int t = 0; t < *triangle_count; t++)
        memcpy(triangles[t], work.triangles[t].corner, sizeof triangles[t]);
    free(work.triangles);
    free(work.one_at);
    free(work.stack);
    free(work.crossed);
    return is_done ? HD_OK : fail(&work, error);
}
