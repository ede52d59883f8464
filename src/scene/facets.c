/* SPDX-License-Identifier: MIT */
#include "scene/facets.h"

#include <math.h>
#include <stdlib.h>

#include "base/growth.h"

/* Points that are no farther from a border lie on it; for coordinates of about 1. */
static const double same_place = 1e-9;

static bool add_point(HdFacets *facets, HdVec3 point) {
    return hd_append(&facets->points, sizeof point, &facets->point_count, &facets->point_room,
                     &point);
}

static bool add_side(HdFacets *facets, HdFacetSide side) {
    return hd_append(&facets->sides, sizeof side, &facets->side_count, &facets->side_room, &side);
}

static bool add_facet(HdFacets *facets, HdFacet facet) {
    return hd_append(&facets->facets, sizeof facet, &facets->facet_count, &facets->facet_room,
                     &facet);
}

static int end_of(const HdFacets *facets, int side) {
    return facets->sides[facets->sides[side].twin].from;
}

/* Sides 2e and 2e + 1 are those of edge e. */
static bool add_edge(HdFacets *facets, const HdPlatonic *shape, int e, int face_of[2]) {
    const HdPlatonicEdge *edge = &shape->edge[e];
    const HdVec3 leftwards =
        hd_cross(shape->vertex[edge->vertex[0]], shape->vertex[edge->vertex[1]]);
    const bool is_first = hd_dot(leftwards, shape->face_normal[edge->face[0]]) > 0.0;
    face_of[0] = edge->face[is_first ? 0 : 1];
    face_of[1] = edge->face[is_first ? 1 : 0];
    return add_side(facets, (HdFacetSide){.from = edge->vertex[0], .twin = 2 * e + 1}) &&
           add_side(facets, (HdFacetSide){.from = edge->vertex[1], .twin = 2 * e});
}

bool hd_facets_start(HdFacets *facets, const HdPlatonic *shape, int material) {
    int face_of[2 * HD_MAX_EDGES] = {0};
    for (int v = 0; v < shape->vertex_count; v++)
        if (!add_point(facets, shape->vertex[v]))
            return false;
    for (int f = 0; f < shape->face_count; f++)
        if (!add_facet(facets, (HdFacet){.face = f, .material = material}))
            return false;
    for (int e = 0; e < shape->edge_count; e++)
        if (!add_edge(facets, shape, e, &face_of[2 * e]))
            return false;
    for (int s = 0; s < facets->side_count; s++) {
        facets->facets[face_of[s]].side = s;
        for (int t = 0; t < facets->side_count; t++)
            if (face_of[t] == face_of[s] && facets->sides[t].from == end_of(facets, s))
                facets->sides[s].next = t;
    }
    return true;
}

/* Cutting */

/* How far a point is inside of the border. */
static double depth_of(const HdFacets *facets, int point, const HdHalfSpace *border) {
    return hd_dot(border->direction, facets->points[point]) - border->offset;
}

/* 1: inside of the border, -1: outside, 0: on it. */
static int place_of(const HdFacets *facets, int point, const HdHalfSpace *border) {
    const double depth = depth_of(facets, point, border);
    return (depth > same_place) - (depth < -same_place);
}

/* Whether one of the facet's points is inside of the border (1), or outside (-1). */
static bool has_point(const HdFacets *facets, int facet, const HdHalfSpace *border, int place) {
    const int first = facets->facets[facet].side;
    int side = first;
    do {
        if (place_of(facets, facets->sides[side].from, border) == place)
            return true;
        side = facets->sides[side].next;
    } while (side != first);
    return false;
}

/* Puts a point on a side, which then ends there, and another side behind it; in the facet beyond
   likewise. */
static bool divide_side(HdFacets *facets, int side, double share) {
    const int twin = facets->sides[side].twin;
    const HdVec3 from = facets->points[facets->sides[side].from];
    const HdVec3 to = facets->points[facets->sides[twin].from];
    const int point = facets->point_count, rest = facets->side_count;
    if (!add_point(facets, hd_add(from, hd_scale(hd_sub(to, from), share))) ||
        !add_side(facets, (HdFacetSide){point, facets->sides[side].next, twin}) ||
        !add_side(facets, (HdFacetSide){point, facets->sides[twin].next, side}))
        return false;
    facets->sides[side].next = rest;
    facets->sides[side].twin = rest + 1;
    facets->sides[twin].next = rest + 1;
    facets->sides[twin].twin = rest;
    return true;
}

/* Puts points where the border crosses the sides of a facet. */
static bool divide_sides(HdFacets *facets, int facet, const HdHalfSpace *border) {
    const int first = facets->facets[facet].side;
    int side = first;
    do {
        const int from = facets->sides[side].from, to = end_of(facets, side);
        const int next = facets->sides[side].next;
        if (place_of(facets, from, border) * place_of(facets, to, border) < 0) {
            const double start = depth_of(facets, from, border);
            if (!divide_side(facets, side, start / (start - depth_of(facets, to, border))))
                return false;
        }
        side = next;
    } while (side != first);
    return true;
}

static int side_before(const HdFacets *facets, int side) {
    int before = side;
    while (facets->sides[before].next != side)
        before = facets->sides[before].next;
    return before;
}

/* Cuts a facet with points on both sides of the border in two: it stays inside, and a new one is
   what lies outside. */
static bool cut(HdFacets *facets, int facet, const HdHalfSpace *border) {
    if (!divide_sides(facets, facet, border))
        return false;
    int side = facets->facets[facet].side;
    while (place_of(facets, facets->sides[side].from, border) <= 0)
        side = facets->sides[side].next;
    while (place_of(facets, end_of(facets, side), border) >= 0)
        side = facets->sides[side].next;
    const int out = side; /* begins on the border and leads outside */
    while (place_of(facets, end_of(facets, side), border) <= 0)
        side = facets->sides[side].next;
    const int in = side; /* begins on the border and leads back */
    const int before_out = side_before(facets, out), before_in = side_before(facets, in);
    const int outer = facets->side_count, inner = outer + 1;
    HdFacet outside = facets->facets[facet];
    outside.side = outer;
    if (!add_side(facets, (HdFacetSide){facets->sides[in].from, out, inner}) ||
        !add_side(facets, (HdFacetSide){facets->sides[out].from, in, outer}) ||
        !add_facet(facets, outside))
        return false;
    facets->sides[before_in].next = outer;
    facets->sides[before_out].next = inner;
    facets->facets[facet].side = inner;
    return true;
}

static bool carve_facet(HdFacets *facets, int facet, const HdHalfSpace *borders, int count,
                        int material) {
    for (int b = count; b-- > 0;)
        if (!has_point(facets, facet, &borders[b], 1))
            return true;
    for (int b = 0; b < count; b++) {
        if (!has_point(facets, facet, &borders[b], 1))
            return true;
        if (has_point(facets, facet, &borders[b], -1) && !cut(facets, facet, &borders[b]))
            return false;
    }
    const int former = facets->facets[facet].material;
    facets->facets[facet].material = material == 0 ? 0 : material + former % 2;
    return true;
}

bool hd_facets_carve(HdFacets *facets, int face, int first, const HdHalfSpace *borders, int count,
                     int material) {
    const int end = facets->facet_count;
    bool is_done = carve_facet(facets, face, borders, count, material);
    for (int f = first; f < end && is_done; f++)
        is_done = carve_facet(facets, f, borders, count, material);
    return is_done;
}

/* Triangles */

/* The points of a facet. */
typedef struct Loop {
    int count, room;
    int32_t *points;
} Loop;

static bool list_points(const HdFacets *facets, int facet, Loop *loop) {
    const int first = facets->facets[facet].side;
    int side = first;
    loop->count = 0;
    do {
        if (!hd_append(&loop->points, sizeof *loop->points, &loop->count, &loop->room,
                       &facets->sides[side].from))
            return false;
        side = facets->sides[side].next;
    } while (side != first);
    return true;
}

/* The least height of a triangle. */
static double height_of(HdVec3 a, HdVec3 b, HdVec3 c, HdVec3 normal) {
    const HdVec3 ab = hd_sub(b, a), bc = hd_sub(c, b), ca = hd_sub(a, c);
    const double longest = fmax(hd_length(ab), fmax(hd_length(bc), hd_length(ca)));
    return hd_dot(hd_cross(ca, ab), normal) / longest;
}

/* The same for the flattest triangle of the fan about a corner, as far as that is above `enough`.
 */
static double least_height(const HdFacets *facets, const Loop *loop, int corner, HdVec3 normal,
                           double enough) {
    const HdVec3 *points = facets->points, apex = points[loop->points[corner]];
    double least = HUGE_VAL;
    for (int k = 1; k < loop->count - 1 && least > enough; k++) {
        const HdVec3 b = points[loop->points[(corner + k) % loop->count]];
        const HdVec3 c = points[loop->points[(corner + k + 1) % loop->count]];
        least = fmin(least, height_of(apex, b, c, normal));
    }
    return least;
}

/* The corner of the fan whose flattest triangle is the least flat; -1 where points on one line
   leave none. */
static int best_corner(const HdFacets *facets, const Loop *loop, HdVec3 normal) {
    const double flat = 1e-2 * same_place;
    double best_height = flat;
    int best = loop->count == 3 ? 0 : -1;
    for (int i = 0; i < loop->count; i++) {
        const double height = least_height(facets, loop, i, normal, best_height);
        if (height > best_height) {
            best_height = height;
            best = i;
        }
    }
    return best;
}

/* The number of a new vertex in the middle of the facet. */
static int add_middle(const HdFacets *facets, const Loop *loop, double scale, HdMesh *mesh) {
    HdVec3 sum = hd_vec3(0.0, 0.0, 0.0);
    for (int i = 0; i < loop->count; i++)
        sum = hd_add(sum, facets->points[loop->points[i]]);
    mesh->vertices[mesh->vertex_count] = hd_scale(sum, scale / loop->count);
    return mesh->vertex_count++;
}

static void add_fan(const HdFacet *facet, const Loop *loop, int corner, int apex, HdMesh *mesh) {
    for (int k = 0; k < loop->count; k++) {
        const int32_t a = loop->points[(corner + k) % loop->count];
        const int32_t b = loop->points[(corner + k + 1) % loop->count];
        if (a == apex || b == apex)
            continue;
        const int t = mesh->triangle_count++;
        mesh->corners[t][0] = apex;
        mesh->corners[t][1] = a;
        mesh->corners[t][2] = b;
        mesh->material_of[t] = facet->material;
        mesh->group_of[t] = (uint8_t)(facet->face + 1);
    }
}

bool hd_facets_fill_mesh(const HdFacets *facets, const HdPlatonic *shape, double scale,
                         HdMesh *mesh) {
    Loop loop = {0};
    bool is_done = hd_mesh_allocate(mesh, (size_t)facets->point_count + (size_t)facets->facet_count,
                                    (size_t)facets->side_count);
    for (int p = 0; p < facets->point_count && is_done; p++)
        mesh->vertices[mesh->vertex_count++] = hd_scale(facets->points[p], scale);
    for (int f = 0; f < facets->facet_count && is_done; f++) {
        const HdFacet *facet = &facets->facets[f];
        is_done = list_points(facets, f, &loop);
        if (!is_done)
            break;
        const int corner = best_corner(facets, &loop, shape->face_normal[facet->face]);
        const int apex = corner >= 0 ? loop.points[corner] : add_middle(facets, &loop, scale, mesh);
        add_fan(facet, &loop, corner >= 0 ? corner : 0, apex, mesh);
    }
    free(loop.points);
    return is_done;
}

void hd_facets_free(HdFacets *facets) {
    free(facets->points);
    free(facets->sides);
    free(facets->facets);
    *facets = (HdFacets){0};
}
