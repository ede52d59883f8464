/* SPDX-License-Identifier: MIT */
/* Cuts a solid's surface into convex facets. Adjacent facets always share a whole side with the
   same two points, so cuts leave no gaps. */
#define _POSIX_C_SOURCE 200809L

#include "scene/triangulate.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/growth.h"
#include "base/trigonometry.h"

/* Least width of a rim and least side of a disc or of the face inside a rim, in circumradii. Points
   closer together would merge by rounding. */
static const double min_length = 1e-8;

/* Distance from a border, in circumradii, within which points lie on it. */
static const double same_place = 1e-9;

/* A directed side; its facet is to its left as seen from outside. */
typedef struct Side {
    int32_t from;       /* start point; the end is the next side's start */
    int32_t next, twin; /* next side of the same facet; reversed side of the adjacent facet */
} Side;

typedef struct Facet {
    int32_t side; /* one of its sides */
    int face, material;
    HdVec3 corner; /* one of its points; all others are within `reach` */
    double reach;
} Facet;

/* The points with direction . point >= offset; the direction is unit. */
typedef struct HalfSpace {
    HdVec3 direction;
    double offset;
} HalfSpace;

/* A solid in progress, in units of its circumradius. */
typedef struct Work {
    const HdSolid *solid;
    HdPlatonic shape;   /* rotated as in the scene */
    double rim_width;   /* 0: no rim */
    double disc_radius; /* 0: no discs */
    int disc_sides;
    double widening; /* ratio of the polygon's circumradius to the disc's radius */
    double flatness; /* ratio of the polygon's inradius to its circumradius */
    HdVec2 outwards[HD_MAX_DISC_SIDES]; /* directions to the middles of the polygon's sides */
    int point_count, side_count, facet_count, border_count;
    int point_capacity, side_capacity, facet_capacity;
    HdVec3 *points;
    Side *sides;
    Facet *facets;
    HalfSpace borders[HD_MAX_DISC_SIDES + 6]; /* borders of the region to cut out */
} Work;

static HdStatus no_memory(HdError *error) {
    return hd_fail(error, HD_FAILED, "out of memory: the solid has too many triangles");
}

/* Facets */

static bool add_point(Work *work, HdVec3 point) {
    return hd_append(&work->points, sizeof point, &work->point_count, &work->point_capacity,
                     &point);
}

static bool add_side(Work *work, int from, int next, int twin) {
    const Side side = {from, next, twin};
    return hd_append(&work->sides, sizeof side, &work->side_count, &work->side_capacity, &side);
}

static bool add_facet(Work *work, Facet facet) {
    return hd_append(&work->facets, sizeof facet, &work->facet_count, &work->facet_capacity,
                     &facet);
}

static int end_of(const Work *work, int side) {
    return work->sides[work->sides[side].twin].from;
}

static void update_reach(Work *work, int number) {
    Facet *facet = &work->facets[number];
    int side = facet->side;
    facet->corner = work->points[work->sides[side].from];
    facet->reach = 0.0;
    do {
        const HdVec3 point = work->points[work->sides[side].from];
        facet->reach = fmax(facet->reach, hd_length(hd_sub(point, facet->corner)));
        side = work->sides[side].next;
    } while (side != facet->side);
}

/* Makes a facet of each face. Sides 2e and 2e + 1 belong to edge e. */
static bool start_facets(Work *work, int material) {
    const HdPlatonic *shape = &work->shape;
    int face_of[2 * HD_MAX_EDGES] = {0};
    bool is_done = true;
    for (int v = 0; v < shape->vertex_count; v++)
        is_done = is_done && add_point(work, shape->vertex[v]);
    for (int f = 0; f < shape->face_count; f++)
        is_done = is_done && add_facet(work, (Facet){.face = f, .material = material});
    for (int e = 0; e < shape->edge_count && is_done; e++) {
        const int *ends = shape->edge[e].vertex, *faces = shape->edge[e].face;
        const HdVec3 leftwards = hd_cross(shape->vertex[ends[0]], shape->vertex[ends[1]]);
        const bool is_first = hd_dot(leftwards, shape->face_normal[faces[0]]) > 0.0;
        face_of[2 * e] = faces[is_first ? 0 : 1];
        face_of[2 * e + 1] = faces[is_first ? 1 : 0];
        is_done = add_side(work, ends[0], 0, 2 * e + 1) && add_side(work, ends[1], 0, 2 * e);
    }
    for (int s = 0; s < work->side_count && is_done; s++) {
        work->facets[face_of[s]].side = s;
        for (int t = 0; t < work->side_count; t++)
            if (face_of[t] == face_of[s] && work->sides[t].from == end_of(work, s))
                work->sides[s].next = t;
    }
    for (int f = 0; f < shape->face_count && is_done; f++)
        update_reach(work, f);
    return is_done;
}

/* Cutting */

/* Returns the point's signed distance from the border, positive inside. */
static double depth_of(const Work *work, int point, const HalfSpace *border) {
    return hd_dot(border->direction, work->points[point]) - border->offset;
}

/* Returns 1 inside the border, -1 outside, 0 on it. */
static int place_of(const Work *work, int point, const HalfSpace *border) {
    const double depth = depth_of(work, point, border);
    return (depth > same_place) - (depth < -same_place);
}

/* Returns whether a point of the facet is inside the border (1) or outside (-1). */
static bool has_point(const Work *work, int facet, const HalfSpace *border, int place) {
    const int first = work->facets[facet].side;
    int side = first;
    do {
        if (place_of(work, work->sides[side].from, border) == place)
            return true;
        side = work->sides[side].next;
    } while (side != first);
    return false;
}

/* Splits a side and its twin at a new point. */
static bool divide_side(Work *work, int side, double share) {
    const int twin = work->sides[side].twin, point = work->point_count, rest = work->side_count;
    const HdVec3 from = work->points[work->sides[side].from];
    const HdVec3 to = work->points[work->sides[twin].from];
    if (!add_point(work, hd_add(from, hd_scale(hd_sub(to, from), share))) ||
        !add_side(work, point, work->sides[side].next, twin) ||
        !add_side(work, point, work->sides[twin].next, side))
        return false;
    work->sides[side].next = rest;
    work->sides[side].twin = rest + 1;
    work->sides[twin].next = rest + 1;
    work->sides[twin].twin = rest;
    return true;
}

/* Splits the sides of a facet that cross the border. */
static bool divide_sides(Work *work, int facet, const HalfSpace *border) {
    const int first = work->facets[facet].side;
    int side = first;
    do {
        const int from = work->sides[side].from, to = end_of(work, side);
        const int next = work->sides[side].next;
        if (place_of(work, from, border) * place_of(work, to, border) < 0) {
            const double depth = depth_of(work, from, border);
            if (!divide_side(work, side, depth / (depth - depth_of(work, to, border))))
                return false;
        }
        side = next;
    } while (side != first);
    return true;
}

static int side_before(const Work *work, int side) {
    int before = side;
    while (work->sides[before].next != side)
        before = work->sides[before].next;
    return before;
}

/* Cuts a facet that has points on both sides of the border: it keeps the inside, a new one the
   outside. */
static bool cut(Work *work, int facet, const HalfSpace *border) {
    if (!divide_sides(work, facet, border))
        return false;
    int side = work->facets[facet].side;
    while (place_of(work, work->sides[side].from, border) <= 0)
        side = work->sides[side].next;
    while (place_of(work, end_of(work, side), border) >= 0)
        side = work->sides[side].next;
    const int out = side; /* starts on the border, leads outside */
    while (place_of(work, end_of(work, side), border) <= 0)
        side = work->sides[side].next;
    const int in = side; /* starts on the border, leads back */
    const int before_out = side_before(work, out), before_in = side_before(work, in);
    const int outer = work->side_count, inner = outer + 1;
    if (!add_side(work, work->sides[in].from, out, inner) ||
        !add_side(work, work->sides[out].from, in, outer) || !add_facet(work, work->facets[facet]))
        return false;
    work->sides[before_in].next = outer;
    work->sides[before_out].next = inner;
    work->facets[facet].side = inner;
    work->facets[work->facet_count - 1].side = outer;
    update_reach(work, facet);
    update_reach(work, work->facet_count - 1);
    return true;
}

static bool carve_facet(Work *work, int facet, int material) {
    const HalfSpace *borders = work->borders;
    for (int b = 0; b < work->border_count; b++)
        if (!has_point(work, facet, &borders[b], 1))
            return true;
    for (int b = 0; b < work->border_count; b++) {
        if (!has_point(work, facet, &borders[b], 1))
            return true;
        if (has_point(work, facet, &borders[b], -1) && !cut(work, facet, &borders[b]))
            return false;
    }
    const int former = work->facets[facet].material;
    work->facets[facet].material = material == 0 ? 0 : material + former % 2;
    return true;
}

/* Cuts the facets of a face (its own and those from `first` on) along all borders, whose common
   inside lies in a ball, and gives that inside the material. Facets of an odd material get the next
   material. */
static bool carve(Work *work, int face, int first, HdVec3 centre, double radius, int material) {
    const int end = work->facet_count;
    bool is_done = carve_facet(work, face, material);
    for (int f = first; f < end && is_done; f++) {
        const Facet *facet = &work->facets[f];
        if (hd_length(hd_sub(facet->corner, centre)) <= facet->reach + radius)
            is_done = carve_facet(work, f, material);
    }
    return is_done;
}

/* Rims and discs */

/* Adds the half space in a direction from `distance` before a point. */
static void add_border(Work *work, HdVec3 point, HdVec3 direction, double distance) {
    work->borders[work->border_count++] =
        (HalfSpace){direction, hd_dot(direction, point) - distance};
}

static HdVec3 middle_of_face(const Work *work, int face) {
    return hd_scale(work->shape.face_normal[face], work->shape.inradius);
}

static HdVec3 middle_of_edge(const Work *work, int edge) {
    const int *ends = work->shape.edge[edge].vertex;
    return hd_scale(hd_add(work->shape.vertex[ends[0]], work->shape.vertex[ends[1]]), 0.5);
}

static bool face_has_edge(const Work *work, int face, int edge) {
    const int *faces = work->shape.edge[edge].face;
    return faces[0] == face || faces[1] == face;
}

/* The face starts as rim; the region inside the rim becomes the face. */
static bool carve_rim(Work *work, int face, int first) {
    const HdVec3 middle = middle_of_face(work, face);
    work->border_count = 0;
    for (int e = 0; e < work->shape.edge_count; e++) {
        if (!face_has_edge(work, face, e))
            continue;
        const HdVec3 side = middle_of_edge(work, e), inwards = hd_sub(middle, side);
        const double inradius = hd_length(inwards);
        if (inradius - work->rim_width <= min_length * inradius)
            return true;
        add_border(work, side, hd_scale(inwards, 1.0 / inradius), -work->rim_width);
    }
    return carve(work, face, first, middle, 1.0, HD_SOLID_MATERIAL_FACE);
}

static HdVec3 direction_of(const Work *work, int edge) {
    const int *ends = work->shape.edge[edge].vertex;
    return hd_normalize(hd_sub(work->shape.vertex[ends[1]], work->shape.vertex[ends[0]]));
}

/* Light k of an edge is at k + 1/2, and is the nearest from k to k + 1. */
static HdVec3 point_of_edge(const Work *work, int edge, double k) {
    const double along = work->shape.edge_length * (k / work->solid->lights.per_edge - 0.5);
    return hd_add(middle_of_edge(work, edge), hd_scale(direction_of(work, edge), along));
}

/* Returns the unit vector in the face nearest to a direction. */
static HdVec3 along_face(const Work *work, int face, HdVec3 direction) {
    const HdVec3 normal = work->shape.face_normal[face];
    const HdVec3 along = hd_sub(direction, hd_scale(normal, hd_dot(direction, normal)));
    if (hd_length(along) > 1e-6)
        return hd_normalize(along);
    const HdVec3 axis = fabs(normal.x) < 0.5 ? hd_vec3(1.0, 0.0, 0.0) : hd_vec3(0.0, 1.0, 0.0);
    return hd_normalize(hd_cross(normal, axis));
}

/* Adds the sides of the polygon for a disc: the section of its ball by a face's plane, which the
   unit vectors span. Two borders that only touch it come first, then the sides steepest to the
   edge. They end at those two borders, so no cut leaves the disc's surroundings. */
static void add_disc_sides(Work *work, HdVec3 centre, HdVec3 along, HdVec3 across, double radius) {
    const int half = work->disc_sides / 2;
    for (int sign = -1; sign <= 1; sign += 2)
        add_border(work, centre, hd_scale(across, sign), radius);
    for (int k = 0; 2 * k < half; k++) {
        const int sides[4] = {k, half - 1 - k, half + k, 2 * half - 1 - k};
        for (int i = 0; i < 4; i++) {
            const HdVec2 outwards = work->outwards[sides[i]];
            const HdVec3 inwards =
                hd_add(hd_scale(along, -outwards.x), hd_scale(across, -outwards.y));
            add_border(work, centre, inwards, work->flatness * radius);
        }
    }
}

/* Cuts out the section of the light's ball by the face, as far as the light is its edge's nearest.
   Of overlapping discs the last edge's shows, as in the kernels. The kernels also require a disc's
   points to be near a side; all are, for a face's own sides are the nearest edges. */
static bool carve_disc(Work *work, int face, int first, int edge, int light) {
    const HdVec3 normal = work->shape.face_normal[face], direction = direction_of(work, edge);
    const HdVec3 point = point_of_edge(work, edge, light + 0.5);
    double height = 0.0;
    if (!face_has_edge(work, face, edge))
        height = hd_dot(hd_sub(point, middle_of_face(work, face)), normal);
    const double squared = work->disc_radius * work->disc_radius - height * height;
    if (!(squared > 0.0))
        return true;
    const HdVec3 centre = hd_sub(point, hd_scale(normal, height));
    const HdVec3 along = along_face(work, face, direction);
    const double radius = work->widening * sqrt(squared);
    work->border_count = 0;
    add_disc_sides(work, centre, along, hd_cross(normal, along), radius);
    if (light > 0)
        add_border(work, point_of_edge(work, edge, light), direction, 0.0);
    if (light < work->solid->lights.per_edge - 1)
        add_border(work, point_of_edge(work, edge, light + 1), hd_scale(direction, -1.0), 0.0);
    return carve(work, face, first, centre, radius,
                 HD_SOLID_MATERIAL_DISCS + 2 * (edge % work->solid->lights.colour_count));
}

static bool carve_face(Work *work, int face) {
    const int first = work->facet_count;
    bool is_done = work->rim_width == 0.0 || carve_rim(work, face, first);
    for (int e = 0; e < work->shape.edge_count && work->disc_radius > 0.0; e++)
        for (int k = 0; k < work->solid->lights.per_edge && is_done; k++)
            is_done = carve_disc(work, face, first, e, k);
    return is_done;
}

/* A regular polygon of n sides has the area n / 2 sin(2 pi / n) of its circumradius squared. */
static void prepare(Work *work, const HdSolid *solid, int disc_sides) {
    /* Discs of two circumradii cover everything, and so do polygons of twice that. */
    static const double largest = 4.0;
    const double rim = solid->rim_width / solid->circumradius;
    const double disc = fmin(solid->lights.disc_radius / solid->circumradius, largest);
    double sine, cosine;
    work->solid = solid;
    work->shape = hd_solid_shape(solid);
    work->disc_sides = disc_sides;
    if (rim > min_length)
        work->rim_width = rim;
    if (solid->lights.per_edge > 0 && disc * 2.0 * HD_PI / disc_sides > min_length)
        work->disc_radius = disc;
    hd_sine_cosine(HD_PI / disc_sides, &sine, &cosine);
    work->widening = sqrt(HD_PI / (disc_sides * sine * cosine));
    work->flatness = cosine;
    for (int i = 0; i < disc_sides; i++)
        hd_sine_cosine(HD_PI * (2 * i + 1) / disc_sides, &work->outwards[i].y,
                       &work->outwards[i].x);
}

/* Triangles */

/* Lists the points of a facet and returns their number. */
static int list_points(const Work *work, int facet, int32_t *loop) {
    const int first = work->facets[facet].side;
    int side = first, count = 0;
    do {
        loop[count++] = work->sides[side].from;
        side = work->sides[side].next;
    } while (side != first);
    return count;
}

/* Returns the least height of a triangle. */
static double height_of(HdVec3 a, HdVec3 b, HdVec3 c, HdVec3 normal) {
    const HdVec3 ab = hd_sub(b, a), bc = hd_sub(c, b), ca = hd_sub(a, c);
    const double longest = fmax(hd_length(ab), fmax(hd_length(bc), hd_length(ca)));
    return hd_dot(hd_cross(ca, ab), normal) / longest;
}

/* Returns the least height in the fan about a corner; stops once it is at most `enough`. */
static double min_height(const HdVec3 *points, const int32_t *loop, int count, int corner,
                         HdVec3 normal, double enough) {
    double least = HUGE_VAL;
    for (int k = 1; k < count - 1 && least > enough; k++) {
        const HdVec3 b = points[loop[(corner + k) % count]];
        const HdVec3 c = points[loop[(corner + k + 1) % count]];
        least = fmin(least, height_of(points[loop[corner]], b, c, normal));
    }
    return least;
}

/* Returns the corner whose fan has the greatest least height; -1 if all points are on one line. */
static int best_corner(const HdVec3 *points, const int32_t *loop, int count, HdVec3 normal) {
    double best_height = 1e-2 * same_place;
    int best = count == 3 ? 0 : -1;
    for (int i = 0; i < count; i++) {
        const double height = min_height(points, loop, count, i, normal, best_height);
        if (height > best_height) {
            best_height = height;
            best = i;
        }
    }
    return best;
}

/* Adds a facet as a fan of triangles about one of its points, or about a new one in its middle. */
static void add_fan(const Work *work, const Facet *facet, const int32_t *loop, int count,
                    HdMesh *mesh) {
    const HdVec3 normal = work->shape.face_normal[facet->face];
    int corner = best_corner(work->points, loop, count, normal), apex = mesh->vertex_count;
    if (corner >= 0)
        apex = loop[corner];
    else {
        HdVec3 sum = hd_vec3(0.0, 0.0, 0.0);
        for (int i = 0; i < count; i++)
            sum = hd_add(sum, work->points[loop[i]]);
        mesh->vertices[mesh->vertex_count++] = hd_scale(sum, work->solid->circumradius / count);
        corner = 0;
    }
    for (int k = 0; k < count; k++) {
        const int32_t corners[3] = {apex, loop[(corner + k) % count],
                                    loop[(corner + k + 1) % count]};
        if (corners[1] == apex || corners[2] == apex)
            continue;
        const int t = mesh->triangle_count++;
        memcpy(mesh->corners[t], corners, sizeof corners);
        mesh->material_of[t] = facet->material;
        mesh->group_of[t] = (uint8_t)(facet->face + 1);
    }
}

static bool fill_mesh(const Work *work, HdMesh *mesh) {
    int32_t *loop = malloc((size_t)work->side_count * sizeof *loop);
    const bool has_memory =
        loop != NULL &&
        hd_mesh_allocate(mesh, (size_t)work->point_count + (size_t)work->facet_count,
                         (size_t)work->side_count);
    for (int p = 0; p < work->point_count && has_memory; p++)
        mesh->vertices[mesh->vertex_count++] = hd_scale(work->points[p], work->solid->circumradius);
    for (int f = 0; f < work->facet_count && has_memory; f++)
        add_fan(work, &work->facets[f], loop, list_points(work, f, loop), mesh);
    free(loop);
    return has_memory;
}

static HdStatus add_material(HdMesh *mesh, const char *name, const HdMeshMaterial *material,
                             HdError *error) {
    HdMeshMaterial *added = &mesh->materials[mesh->material_count++];
    *added = *material;
    added->picture = -1;
    added->name = strdup(name);
    return added->name != NULL ? HD_OK : no_memory(error);
}

/* A disc shows only its own radiance. */
static HdStatus add_materials(HdMesh *mesh, const HdSolid *solid, bool has_discs, HdError *error) {
    const int discs = has_discs ? 2 * solid->lights.colour_count : 0;
    mesh->materials = calloc(HD_SOLID_MATERIAL_DISCS + (size_t)discs, sizeof *mesh->materials);
    if (mesh->materials == NULL)
        return no_memory(error);
    HdMeshMaterial added = {.material = solid->face, .mask_picture = -1, .passes_as = -1};
    HD_TRY(add_material(mesh, "face", &added, error));
    added.material = solid->rim;
    HD_TRY(add_material(mesh, "rim", &added, error));
    added.material = (HdMaterial){.shininess = 1, .index_of_refraction = 1.0};
    for (int i = 0; i < discs; i++) {
        char name[64];
        snprintf(name, sizeof name, "disc of colour %d%s", i / 2 + 1, i % 2 ? " on the rim" : "");
        added.emission = hd_scale(solid->lights.colours[i / 2], solid->lights.disc_radiance);
        added.passes_as = i % 2 ? HD_SOLID_MATERIAL_RIM : HD_SOLID_MATERIAL_FACE;
        HD_TRY(add_material(mesh, name, &added, error));
    }
    return HD_OK;
}

static HdStatus make_solid(Work *work, HdMesh *mesh, int divisions, HdError *error) {
    HD_TRY(add_materials(mesh, work->solid, work->disc_radius > 0.0, error));
    bool is_done =
        start_facets(work, work->rim_width > 0.0 ? HD_SOLID_MATERIAL_RIM : HD_SOLID_MATERIAL_FACE);
    for (int f = 0; f < work->shape.face_count && is_done; f++)
        is_done = carve_face(work, f);
    if (!is_done || !fill_mesh(work, mesh))
        return no_memory(error);
    return hd_divide_triangles(mesh, divisions, error);
}

HdStatus hd_triangulate_solid(HdMesh *mesh, const HdSolid *solid, int disc_sides, int divisions,
                              HdError *error) {
    *mesh = (HdMesh){0};
    if (disc_sides < HD_MIN_DISC_SIDES || disc_sides > HD_MAX_DISC_SIDES || disc_sides % 2 != 0)
        return hd_fail(error, HD_BAD_INPUT,
                       "discs have %d sides, expected an even number from %d to %d", disc_sides,
                       (int)HD_MIN_DISC_SIDES, (int)HD_MAX_DISC_SIDES);
    Work *work = calloc(1, sizeof *work);
    if (work == NULL)
        return no_memory(error);
    prepare(work, solid, disc_sides);
    const HdStatus status = make_solid(work, mesh, divisions, error);
    free(work->points);
    free(work->sides);
    free(work->facets);
    free(work);
    if (status != HD_OK)
        hd_mesh_free(mesh);
    return status;
}

/* The floor */

/* Returns the floor's point at share `s` from corner 0 to 1 and share `t` from there towards 3 and
   2. */
static HdVec3 floor_point(const HdVec3 corner[4], double s, double t) {
    HdVec3 upper = hd_add(hd_scale(corner[0], 1.0 - s), hd_scale(corner[1], s));
    HdVec3 lower = hd_add(hd_scale(corner[3], 1.0 - s), hd_scale(corner[2], s));
    return hd_add(hd_scale(upper, 1.0 - t), hd_scale(lower, t));
}

static void fill_floor_points(HdMesh *mesh, const HdFloor *floor, int divisions) {
    const HdVec3 centre = hd_floor_centre(floor);
    HdVec3 corner[4];
    for (int i = 0; i < 4; i++)
        corner[i] = hd_sub(floor->corners[i], centre);
    for (int row = 0; row <= divisions; row++)
        for (int column = 0; column <= divisions; column++) {
            double s = (double)column / divisions, t = (double)row / divisions;
            int v = mesh->vertex_count++;
            mesh->vertices[v] = floor_point(corner, s, t);
            mesh->uvs[v][0] = s;
            mesh->uvs[v][1] = 1.0 - t;
        }
    mesh->uv_count = mesh->vertex_count;
}

static void fill_floor_triangles(HdMesh *mesh, int divisions) {
    for (int row = 0; row < divisions; row++)
        for (int column = 0; column < divisions; column++) {
            const int32_t upper = row * (divisions + 1) + column, lower = upper + divisions + 1;
            const int32_t corners[2][3] = {{upper, upper + 1, lower + 1},
                                           {upper, lower + 1, lower}};
            memcpy(mesh->corners[mesh->triangle_count], corners, sizeof corners);
            memcpy(mesh->corner_uvs[mesh->triangle_count], corners, sizeof corners);
            mesh->triangle_count += 2;
        }
    memset(mesh->group_of, 1, (size_t)mesh->triangle_count);
}

static HdStatus make_floor_mesh(HdMesh *mesh, const HdFloor *floor, int divisions, HdError *error) {
    const size_t n = (size_t)divisions, points = (n + 1) * (n + 1), triangles = 2 * n * n;
    const HdMeshMaterial material = {
        .material = floor->material, .mask_picture = -1, .passes_as = -1};
    mesh->uvs = malloc(points * sizeof *mesh->uvs);
    mesh->corner_uvs = malloc(triangles * sizeof *mesh->corner_uvs);
    mesh->materials = calloc(1, sizeof *mesh->materials);
    if (mesh->uvs == NULL || mesh->corner_uvs == NULL || mesh->materials == NULL ||
        !hd_mesh_allocate(mesh, points, triangles))
        return HD_NO_ROOM(error, "%zu triangles", triangles);
    HD_TRY(add_material(mesh, "floor", &material, error));
    fill_floor_points(mesh, floor, divisions);
    fill_floor_triangles(mesh, divisions);
    return HD_OK;
}

HdStatus hd_triangulate_floor(HdMesh *mesh, const HdFloor *floor, int divisions, HdError *error) {
    *mesh = (HdMesh){0};
    HD_TRY(hd_check_divisions(2, divisions, error));
    const HdStatus status = make_floor_mesh(mesh, floor, divisions, error);
    if (status != HD_OK)
        hd_mesh_free(mesh);
    return status;
}

/* The scene */

/* `made` holds the new objects, which come before the scene's own meshes and instances and after
   its pictures; its arrays have space for both. */

/* Places the newest mesh. */
static void add_instance(HdScene *made, HdVec3 position) {
    made->instances[made->instance_count++] = (HdInstance){.mesh = made->mesh_count++,
                                                           .entry = -1,
                                                           .position = position,
                                                           .scale = hd_vec3(1.0, 1.0, 1.0)};
}

/* Copies the texture as one that clamps at its border instead of repeating. */
static HdStatus copy_texture(HdPicture *picture, const HdTexture *texture, HdError *error) {
    size_t bytes = (size_t)texture->width * (size_t)texture->height * 3 * sizeof *texture->texels;
    *picture = (HdPicture){.texture = *texture, .is_clamped = true};
    picture->texture.texels = malloc(bytes);
    if (picture->texture.texels == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: the floor's texture has %zu bytes", bytes);
    memcpy(picture->texture.texels, texture->texels, bytes);
    return HD_OK;
}

static HdStatus make_floor(HdScene *made, const HdScene *scene, int divisions, HdError *error) {
    const HdFloor *floor = &scene->floor;
    HdMesh *mesh = &made->meshes[made->mesh_count];
    HD_TRY(hd_triangulate_floor(mesh, floor, divisions, error));
    add_instance(made, hd_floor_centre(floor));
    mesh->materials[0].is_opaque_to_shadows = true;
    if (floor->texture.width == 0)
        return HD_OK;
    mesh->materials[0].picture = scene->picture_count;
    made->picture_count = scene->picture_count + 1;
    return copy_texture(&made->pictures[scene->picture_count], &floor->texture, error);
}

static HdStatus build_meshes(HdScene *made, const HdScene *scene, int disc_sides, int divisions,
                             HdError *error) {
    size_t own = (size_t)scene->solid_count + 1;
    made->meshes = calloc(own + (size_t)scene->mesh_count, sizeof *made->meshes);
    made->instances = calloc(own + (size_t)scene->instance_count, sizeof *made->instances);
    made->pictures = calloc((size_t)scene->picture_count + 1, sizeof *made->pictures);
    if (made->meshes == NULL || made->instances == NULL || made->pictures == NULL)
        return HD_NO_ROOM(error, "%zu meshes", own + (size_t)scene->mesh_count);
    for (int s = 0; s < scene->solid_count; s++) {
        const HdSolid *solid = &scene->solids[s];
        HD_TRY(hd_triangulate_solid(&made->meshes[s], solid, disc_sides, divisions, error));
        add_instance(made, solid->centre);
    }
    if (scene->floor.present)
        HD_TRY(make_floor(made, scene, divisions, error));
    return hd_scene_build_meshes(made, error);
}

static void install(HdScene *scene, const HdScene *made) {
    const int count = made->mesh_count;
    for (int i = 0; i < scene->mesh_count; i++)
        made->meshes[count + i] = scene->meshes[i];
    for (int i = 0; i < scene->instance_count; i++) {
        made->instances[count + i] = scene->instances[i];
        made->instances[count + i].mesh += count;
    }
    for (int i = 0; i < scene->picture_count; i++)
        made->pictures[i] = scene->pictures[i];
    free(scene->meshes);
    free(scene->instances);
    free(scene->pictures);
    scene->meshes = made->meshes;
    scene->instances = made->instances;
    scene->pictures = made->pictures;
    scene->mesh_count += count;
    scene->instance_count += count;
    scene->picture_count += made->picture_count > 0;
    scene->geometry = HD_GEOMETRY_TRIANGLES;
}

HdStatus hd_scene_triangulate(HdScene *scene, int disc_sides, int divisions, HdError *error) {
    HdScene made = {0};
    HdStatus status = build_meshes(&made, scene, disc_sides, divisions, error);
    if (status == HD_OK)
        install(scene, &made);
    else
        hd_scene_drop_meshes(&made);
    return status;
}
