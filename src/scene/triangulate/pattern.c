/* SPDX-License-Identifier: MIT */
#include "scene/triangulate/pattern.h"

#include <math.h>

#include "base/trigonometry.h"

/* The least rim and the least side of a disc or of what a rim leaves of a face: smaller ones could
   hardly be told from points that are one. */
#define LEAST_LENGTH (10.0 * HD_SAME_PLACE)

enum { MOST_CORNERS = HD_MAX_DISC_SIDES + 2 }; /* each of two cuts adds at most one */

typedef struct Polygon {
    int count;
    HdVec2 corner[MOST_CORNERS];
} Polygon;

/* The points of a plane where direction . point + offset >= 0. */
typedef struct HalfPlane {
    HdVec2 direction;
    double offset;
} HalfPlane;

/* The polygon that stands for what a disc, seen as a ball, has of a face's plane. */
typedef struct Disc {
    HdVec2 centre;
    HdVec2 along; /* unit, to its first corner: that of its edge where the face has it */
    double corner_radius;
} Disc;

/* An edge, as seen in a face's plane: coordinate . point + start is the place along the edge's
   line, from its middle. */
typedef struct EdgeView {
    HdVec3 middle, direction;
    HdVec2 coordinate;
    double start;
    bool is_own; /* of the face */
} EdgeView;

static HdVec2 project(const HdFace *face, HdVec3 point) {
    HdVec3 offset = hd_sub(point, face->origin);
    return (HdVec2){hd_dot(offset, face->u), hd_dot(offset, face->v)};
}

static bool face_has_edge(const HdPlatonic *shape, int face, int edge) {
    return shape->edge[edge].face[0] == face || shape->edge[edge].face[1] == face;
}

/* The edge of a face that leaves a vertex counterclockwise; vertex -1: any. */
static int find_side(const HdPlatonic *shape, int face, int vertex, bool *is_reversed) {
    for (int e = 0; e < shape->edge_count; e++) {
        if (!face_has_edge(shape, face, e))
            continue;
        const int *ends = shape->edge[e].vertex;
        HdVec3 across = hd_cross(shape->vertex[ends[0]], shape->vertex[ends[1]]);
        *is_reversed = hd_dot(across, shape->face_normal[face]) < 0.0;
        if (vertex < 0 || ends[*is_reversed ? 1 : 0] == vertex)
            return e;
    }
    return -1;
}

static void list_sides(HdFace *face, const HdPlatonic *shape, int number) {
    int vertex = -1;
    do {
        int side = face->side_count++;
        int edge = find_side(shape, number, vertex, &face->is_reversed[side]);
        bool is_reversed = face->is_reversed[side];
        face->edge[side] = edge;
        face->vertex[side] = shape->edge[edge].vertex[is_reversed ? 1 : 0];
        vertex = shape->edge[edge].vertex[is_reversed ? 0 : 1];
    } while (vertex != face->vertex[0]);
}

static void prepare_face(HdFace *face, const HdPlatonic *shape, int number) {
    HdVec3 normal = shape->face_normal[number];
    *face = (HdFace){0};
    list_sides(face, shape, number);
    face->origin = hd_scale(normal, shape->inradius);
    HdVec3 along = hd_sub(shape->vertex[face->vertex[1]], shape->vertex[face->vertex[0]]);
    face->u = hd_normalize(along);
    face->v = hd_cross(normal, face->u);
    for (int i = 0; i < face->side_count; i++)
        face->corner[i] = project(face, shape->vertex[face->vertex[i]]);
    for (int i = 0; i < face->side_count; i++) {
        HdVec2 side = hd_sub2(face->corner[(i + 1) % face->side_count], face->corner[i]);
        double length = hd_length2(side);
        face->direction[i] = (HdVec2){side.x / length, side.y / length};
    }
}

/* A regular polygon of n sides has the area n / 2 sin(2 pi / n) of its circumradius squared. */
static void prepare_discs(HdPattern *pattern, int sides) {
    double sine, cosine;
    hd_sine_cosine(2.0 * HD_PI / sides, &sine, &cosine);
    pattern->disc_sides = sides;
    pattern->widening = sqrt(2.0 * HD_PI / (sides * sine));
    for (int i = 0; i < 2 * sides; i++)
        hd_sine_cosine(HD_PI * i / sides, &pattern->spoke[i].y, &pattern->spoke[i].x);
}

double hd_face_depth(const HdFace *face, int side, HdVec2 point) {
    return hd_cross2(face->direction[side], hd_sub2(point, face->corner[side]));
}

/* The size, as a share of the face's, of what is no nearer to a side than `width`. */
static double inset_share(const HdFace *face, double width) {
    return 1.0 - width / hd_face_depth(face, 0, (HdVec2){0.0, 0.0});
}

void hd_pattern_prepare(HdPattern *pattern, const HdSolid *solid, int disc_sides) {
    /* Discs of two circumradii cover everything, and so do polygons of twice that, and rims. */
    static const double largest = 4.0;
    double rim = solid->rim_width / solid->circumradius;
    double disc = fmin(solid->lights.disc_radius / solid->circumradius, largest);
    *pattern =
        (HdPattern){.per_edge = solid->lights.per_edge, .colour_count = solid->lights.colour_count};
    if (rim > LEAST_LENGTH)
        pattern->rim_width = rim;
    if (solid->lights.per_edge > 0 && disc * 2.0 * HD_PI / disc_sides > LEAST_LENGTH)
        pattern->disc_radius = disc;
    pattern->shape = hd_solid_shape(solid);
    for (int f = 0; f < pattern->shape.face_count; f++)
        prepare_face(&pattern->face[f], &pattern->shape, f);
    if (inset_share(&pattern->face[0], rim) <= LEAST_LENGTH)
        pattern->rim_width = largest;
    prepare_discs(pattern, disc_sides);
}

/* The distance to the nearest side. */
static double depth_in(const HdFace *face, HdVec2 point) {
    double least = hd_face_depth(face, 0, point);
    for (int i = 1; i < face->side_count; i++)
        least = fmin(least, hd_face_depth(face, i, point));
    return least;
}

static EdgeView view_edge(const HdPattern *pattern, int face, int edge) {
    const HdPlatonic *shape = &pattern->shape;
    const HdFace *plane = &pattern->face[face];
    HdVec3 a = shape->vertex[shape->edge[edge].vertex[0]];
    HdVec3 b = shape->vertex[shape->edge[edge].vertex[1]];
    EdgeView view = {.middle = hd_scale(hd_add(a, b), 0.5),
                     .direction = hd_normalize(hd_sub(b, a))};
    view.coordinate = (HdVec2){hd_dot(view.direction, plane->u), hd_dot(view.direction, plane->v)};
    view.start = hd_dot(view.direction, hd_sub(plane->origin, view.middle));
    view.is_own = face_has_edge(shape, face, edge);
    return view;
}

/* The border between an edge's lights number k - 1 and k, as a place along the edge. */
static double cell_border(const HdPattern *pattern, int k) {
    return pattern->shape.edge_length * ((double)k / pattern->per_edge - 0.5);
}

/* False where the ball about a light does not reach the plane. */
static bool disc_in_plane(const HdPattern *pattern, const HdFace *face, const EdgeView *view,
                          int light, Disc *disc) {
    double place = pattern->shape.edge_length * ((light + 0.5) / pattern->per_edge - 0.5);
    HdVec3 centre = hd_add(view->middle, hd_scale(view->direction, place));
    double height = hd_dot(hd_sub(centre, face->origin), hd_cross(face->u, face->v));
    double squared = pattern->disc_radius * pattern->disc_radius;
    if (!view->is_own)
        squared -= height * height;
    double length = hd_length2(view->coordinate);
    disc->centre = project(face, centre);
    disc->along = length > 1e-6 ? (HdVec2){view->coordinate.x / length, view->coordinate.y / length}
                                : (HdVec2){1.0, 0.0};
    disc->corner_radius = squared > 0.0 ? pattern->widening * sqrt(squared) : 0.0;
    return squared > 0.0;
}

static void add_corner(Polygon *polygon, HdVec2 corner) {
    if (polygon->count < MOST_CORNERS)
        polygon->corner[polygon->count++] = corner;
}

/* Keeps what a convex polygon has in the half plane. */
static void cut_polygon(Polygon *polygon, HalfPlane half) {
    Polygon kept = {.count = 0};
    for (int i = 0; i < polygon->count; i++) {
        HdVec2 a = polygon->corner[i], b = polygon->corner[(i + 1) % polygon->count];
        double from = hd_dot2(half.direction, a) + half.offset;
        double to = hd_dot2(half.direction, b) + half.offset;
        if (from >= 0.0)
            add_corner(&kept, a);
        if ((from >= 0.0) != (to >= 0.0))
            add_corner(&kept, hd_mix2(a, b, from / (from - to)));
    }
    *polygon = kept;
}

static void cut_to_cell(Polygon *polygon, const HdPattern *pattern, const EdgeView *view,
                        int light) {
    HdVec2 forward = view->coordinate, backward = {-forward.x, -forward.y};
    double start = view->start;
    if (light > 0)
        cut_polygon(polygon, (HalfPlane){forward, start - cell_border(pattern, light)});
    if (light < pattern->per_edge - 1)
        cut_polygon(polygon, (HalfPlane){backward, cell_border(pattern, light + 1) - start});
}

static Polygon disc_polygon(const HdPattern *pattern, const Disc *disc) {
    Polygon polygon = {.count = pattern->disc_sides};
    HdVec2 along = disc->along;
    for (int i = 0; i < polygon.count; i++) {
        HdVec2 spoke = pattern->spoke[2 * i];
        polygon.corner[i].x =
            disc->centre.x + disc->corner_radius * (spoke.x * along.x - spoke.y * along.y);
        polygon.corner[i].y =
            disc->centre.y + disc->corner_radius * (spoke.x * along.y + spoke.y * along.x);
    }
    return polygon;
}

/* Adds what a segment has inside of the face. */
static bool add_inside(const HdFace *face, HdVec2 a, HdVec2 b, HdNetwork *network) {
    double from = 0.0, to = 1.0;
    for (int i = 0; i < face->side_count; i++) {
        double at_a = hd_face_depth(face, i, a), at_b = hd_face_depth(face, i, b);
        if (at_a < 0.0 && at_b < 0.0)
            return true;
        if (at_a < 0.0)
            from = fmax(from, at_a / (at_a - at_b));
        else if (at_b < 0.0)
            to = fmin(to, at_a / (at_a - at_b));
    }
    return from >= to || hd_network_add(network, hd_mix2(a, b, from), hd_mix2(a, b, to));
}

static bool add_polygon(const HdFace *face, const Polygon *polygon, HdNetwork *network) {
    const int count = polygon->count;
    for (int i = 0; i < count; i++)
        if (!add_inside(face, polygon->corner[i], polygon->corner[(i + 1) % count], network))
            return false;
    return true;
}

/* The inner border of the rim; none where that is the whole face. */
static bool add_rim(const HdFace *face, double width, HdNetwork *network) {
    Polygon inner = {.count = face->side_count};
    double left = inset_share(face, width);
    if (left <= LEAST_LENGTH)
        return true;
    for (int i = 0; i < face->side_count; i++)
        inner.corner[i] = (HdVec2){left * face->corner[i].x, left * face->corner[i].y};
    return add_polygon(face, &inner, network);
}

/* The kernels ask of a disc's points that they be near a side, too. All are: no edge is nearer to a
   point of a face than the face's nearest side. */
static bool add_discs(const HdPattern *pattern, int face, int edge, HdNetwork *network) {
    EdgeView view = view_edge(pattern, face, edge);
    for (int k = 0; k < pattern->per_edge; k++) {
        Disc disc;
        if (!disc_in_plane(pattern, &pattern->face[face], &view, k, &disc))
            continue;
        Polygon polygon = disc_polygon(pattern, &disc);
        cut_to_cell(&polygon, pattern, &view, k);
        if (!add_polygon(&pattern->face[face], &polygon, network))
            return false;
    }
    return true;
}

bool hd_pattern_add_borders(const HdPattern *pattern, int face, HdNetwork *network) {
    if (pattern->rim_width > 0.0 && !add_rim(&pattern->face[face], pattern->rim_width, network))
        return false;
    for (int e = 0; pattern->disc_radius > 0.0 && e < pattern->shape.edge_count; e++)
        if (!add_discs(pattern, face, e, network))
            return false;
    return true;
}

static bool polygon_has(const HdPattern *pattern, const Disc *disc, HdVec2 point) {
    HdVec2 offset = hd_sub2(point, disc->centre);
    HdVec2 turned = {hd_dot2(disc->along, offset), hd_cross2(disc->along, offset)};
    double reach = disc->corner_radius * pattern->spoke[1].x;
    for (int i = 1; i < 2 * pattern->disc_sides; i += 2)
        if (hd_dot2(pattern->spoke[i], turned) >= reach)
            return false;
    return true;
}

/* Whether the disc of the nearest of an edge's lights covers the point. */
static bool is_covered(const HdPattern *pattern, int face, int edge, HdVec2 point) {
    EdgeView view = view_edge(pattern, face, edge);
    double place = hd_dot2(view.coordinate, point) + view.start;
    double cell = (place / pattern->shape.edge_length + 0.5) * pattern->per_edge;
    int light = (int)fmin(fmax(cell, 0.0), pattern->per_edge - 1);
    Disc disc;
    return disc_in_plane(pattern, &pattern->face[face], &view, light, &disc) &&
           polygon_has(pattern, &disc, point);
}

int hd_pattern_material(const HdPattern *pattern, int face, HdVec2 point) {
    int on_rim = depth_in(&pattern->face[face], point) < pattern->rim_width ? 1 : 0;
    if (pattern->disc_radius > 0.0)
        for (int e = pattern->shape.edge_count - 1; e >= 0; e--)
            if (is_covered(pattern, face, e, point))
                return HD_SOLID_MATERIAL_DISCS + 2 * (e % pattern->colour_count) + on_rim;
    return on_rim ? HD_SOLID_MATERIAL_RIM : HD_SOLID_MATERIAL_FACE;
}
