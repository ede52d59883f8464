/* SPDX-License-Identifier: MIT */
#include "scene/contact.h"

#include <math.h>
#include <stdlib.h>

/* ---- depth ---- */

/* The separating axis theorem: two convex bodies are separate exactly if their projections are, on
   a face's normal or on the cross product of an edge of each. See S. Gottschalk, M. C. Lin, D.
   Manocha, OBBTree: A Hierarchical Structure for Rapid Interference Detection, SIGGRAPH 1996,
   section 5. The smallest overlap of projections is the penetration depth. */

/* Sine of the angle below which lines count as parallel. An axis omitted for it costs nothing: its
   neighbours find the overlap to about that angle. */
static const double parallel = 1e-12;

typedef struct Axes {
    int count;
    HdVec3 axis[HD_MAX_EDGES]; /* unit, no two parallel */
} Axes;

/* A convex polyhedron, or a flat convex polygon. */
typedef struct Body {
    HdVec3 centre;
    double radius; /* radius of the bounding sphere about the centre */
    int point_count;
    HdVec3 point[HD_MAX_VERTICES]; /* relative to the centre */
    Axes normals, edges;
} Body;

static void add_axis(Axes *axes, HdVec3 axis) {
    for (int i = 0; i < axes->count; i++)
        if (hd_length(hd_cross(axes->axis[i], axis)) < parallel)
            return;
    axes->axis[axes->count++] = axis;
}

static void body_of_solid(Body *body, const HdSolid *solid) {
    const HdPlatonic shape = hd_solid_shape(solid);
    *body = (Body){
        .centre = solid->centre, .radius = solid->circumradius, .point_count = shape.vertex_count};
    for (int i = 0; i < shape.vertex_count; i++)
        body->point[i] = hd_scale(shape.vertex[i], solid->circumradius);
    for (int i = 0; i < shape.face_count; i++)
        add_axis(&body->normals, shape.face_normal[i]);
    for (int i = 0; i < shape.edge_count; i++) {
        const int *end = shape.edge[i].vertex;
        add_axis(&body->edges, hd_normalize(hd_sub(shape.vertex[end[1]], shape.vertex[end[0]])));
    }
}

static void body_of_floor(Body *body, const HdFloor *floor) {
    const HdVec3 *corner = floor->corners;
    const HdVec3 normal =
        hd_normalize(hd_cross(hd_sub(corner[2], corner[0]), hd_sub(corner[3], corner[1])));
    *body = (Body){.point_count = 4};
    for (int i = 0; i < 4; i++)
        body->centre = hd_add(body->centre, hd_scale(corner[i], 0.25));
    for (int i = 0; i < 4; i++) {
        const HdVec3 point = hd_sub(corner[i], body->centre);
        body->point[i] = hd_sub(point, hd_scale(normal, hd_dot(point, normal)));
        body->radius = fmax(body->radius, hd_length(body->point[i]));
    }
    add_axis(&body->normals, normal);
    for (int i = 0; i < 4; i++)
        add_axis(&body->edges, hd_normalize(hd_sub(body->point[(i + 1) % 4], body->point[i])));
}

typedef struct Projection {
    double low, high;
} Projection;

static Projection project(const Body *body, HdVec3 axis) {
    Projection projection = {(double)INFINITY, -(double)INFINITY};
    for (int i = 0; i < body->point_count; i++) {
        const double along = hd_dot(body->point[i], axis);
        projection.low = along < projection.low ? along : projection.low;
        projection.high = along > projection.high ? along : projection.high;
    }
    return projection;
}

/* Two bodies and the smallest overlap found so far. */
typedef struct Pair {
    const Body *a, *b;
    HdVec3 offset; /* vector from a's centre to b's */
    double touch;  /* depth that still counts as touching */
    double depth;
} Pair;

/* Returns false if the axis separates the bodies. */
static bool try_axis(Pair *pair, HdVec3 axis) {
    const double offset = hd_dot(pair->offset, axis);
    const Projection a = project(pair->a, axis), b = project(pair->b, axis);
    pair->depth = fmin(pair->depth, fmin(a.high - b.low - offset, b.high - a.low + offset));
    return pair->depth > pair->touch;
}

static bool try_normals(Pair *pair, const Axes *normals) {
    for (int i = 0; i < normals->count; i++)
        if (!try_axis(pair, normals->axis[i]))
            return false;
    return true;
}

static bool try_edges(Pair *pair) {
    const Axes *of_a = &pair->a->edges, *of_b = &pair->b->edges;
    for (int i = 0; i < of_a->count; i++)
        for (int j = 0; j < of_b->count; j++) {
            const HdVec3 across = hd_cross(of_a->axis[i], of_b->axis[j]);
            if (hd_length(across) >= parallel && !try_axis(pair, hd_normalize(across)))
                return false;
        }
    return true;
}

static double depth_of(const Body *a, const Body *b, double least) {
    Pair pair = {.a = a,
                 .b = b,
                 .offset = hd_sub(b->centre, a->centre),
                 .touch = least,
                 .depth = (double)INFINITY};
    const bool deep =
        try_normals(&pair, &a->normals) && try_normals(&pair, &b->normals) && try_edges(&pair);
    return deep ? pair.depth : least;
}

static bool are_far_apart(const HdSolid *solid, HdVec3 centre, double radius, double least) {
    return hd_length(hd_sub(solid->centre, centre)) >= solid->circumradius + radius - least;
}

double hd_solid_depth(const HdSolid *a, const HdSolid *b, double least) {
    Body body_a, body_b;
    if (are_far_apart(a, b->centre, b->circumradius, least))
        return least;
    body_of_solid(&body_a, a);
    body_of_solid(&body_b, b);
    return depth_of(&body_a, &body_b, least);
}

double hd_floor_depth(const HdSolid *solid, const HdFloor *floor, double least) {
    Body body_a, body_b;
    body_of_floor(&body_b, floor);
    if (are_far_apart(solid, body_b.centre, body_b.radius, least))
        return least;
    body_of_solid(&body_a, solid);
    return depth_of(&body_a, &body_b, least);
}

/* Returns the depth that still counts as touching. */
static double touch_of(HdVec3 centre_a, double radius_a, HdVec3 centre_b, double radius_b) {
    static const double touch = 1e-9;
    static const double rounding = 1e-15;
    const double extent = hd_length(centre_a) + radius_a + hd_length(centre_b) + radius_b;
    return touch * fmin(radius_a, radius_b) + rounding * extent;
}

double hd_solid_overlap(const HdSolid *a, const HdSolid *b) {
    const double touch = touch_of(a->centre, a->circumradius, b->centre, b->circumradius);
    const double depth = hd_solid_depth(a, b, touch);
    return depth > touch ? depth : 0.0;
}

/* ---- nesting ---- */

/* Separation moves faces by less. */
static const double clear_share = 0x1p-14;

bool hd_solid_holds(const HdSolid *outer, const HdSolid *inner) {
    const HdVec3 offset = hd_sub(inner->centre, outer->centre);
    const double radius = outer->circumradius;
    if (inner->circumradius > radius || hd_length(offset) > radius)
        return false;
    const HdPlatonic around = hd_solid_shape(outer), within = hd_solid_shape(inner);
    const double most = (around.inradius - clear_share) * radius;
    for (int i = 0; i < within.vertex_count; i++) {
        const HdVec3 corner = hd_add(offset, hd_scale(within.vertex[i], inner->circumradius));
        for (int f = 0; f < around.face_count; f++)
            if (hd_dot(around.face_normal[f], corner) > most)
                return false;
    }
    return true;
}

/* Of two solids that hold a third, the inner one has the smaller circumradius. */
int hd_solid_around(const HdSolid *solids, int count, int number) {
    double smallest = (double)INFINITY;
    int around = -1;
    for (int i = 0; i < count; i++)
        if (i != number && solids[i].circumradius < smallest &&
            hd_solid_holds(&solids[i], &solids[number])) {
            smallest = solids[i].circumradius;
            around = i;
        }
    return around;
}

/* ---- contact ---- */

/* Step by which solids are separated, and distance from which they count as separate, as parts of
   their radii and distance. Half a step is twice what the float kernels need to tell faces apart.
   */
static const double step_share = 0x1p-20, near_share = 0x1p-21;
static const double max_inset_share = 0x1p-10; /* part of the inradius */

static double scale_of(const HdSolid *a, HdVec3 b_centre, double b_radius) {
    return fmax(hd_length(hd_sub(a->centre, b_centre)), fmax(a->circumradius, b_radius));
}

/* Returns the circumradius of a face. */
static double face_radius(const HdSolid *solid, const HdPlatonic *shape) {
    return solid->circumradius * sqrt(1.0 - shape->inradius * shape->inradius);
}

static HdVec3 middle_of_face(const HdSolid *solid, const HdPlatonic *shape, int face) {
    return hd_add(solid->centre,
                  hd_scale(shape->face_normal[face], shape->inradius * solid->circumradius));
}

/* Returns whether the face lies in the plane, of either orientation. */
static bool is_in_plane(const HdSolid *solid, const HdPlatonic *shape, int face, HdVec3 point,
                        HdVec3 normal, double near) {
    const HdVec3 middle = middle_of_face(solid, shape, face);
    const double tilt = hd_length(hd_cross(shape->face_normal[face], normal));
    return fabs(hd_dot(hd_sub(middle, point), normal)) <= near &&
           tilt * face_radius(solid, shape) <= near;
}

/* Compares the circles about the faces. Some adjacent faces count too, which costs only a step. */
static bool faces_coincide(const HdSolid *a, const HdSolid *b, double near) {
    const HdPlatonic shape_a = hd_solid_shape(a), shape_b = hd_solid_shape(b);
    const double reach = face_radius(a, &shape_a) + face_radius(b, &shape_b);
    for (int i = 0; i < shape_a.face_count; i++) {
        const HdVec3 middle = middle_of_face(a, &shape_a, i);
        for (int j = 0; j < shape_b.face_count; j++)
            if (hd_length(hd_sub(middle_of_face(b, &shape_b, j), middle)) <= reach &&
                is_in_plane(b, &shape_b, j, middle, shape_a.face_normal[i], near))
                return true;
    }
    return false;
}

HdContact hd_solids_contact(const HdSolid *a, const HdSolid *b) {
    const double near = near_share * scale_of(a, b->centre, b->circumradius);
    const double depth = hd_solid_depth(a, b, -near);
    if (depth <= -near)
        return HD_CONTACT_NONE;
    if (depth <= near)
        return HD_CONTACT_TOUCHES;
    return faces_coincide(a, b, near) ? HD_CONTACT_SHARES : HD_CONTACT_OVERLAPS;
}

/* A solid that overlaps a flat floor shares no face with it. */
HdContact hd_floor_contact(const HdSolid *solid, const HdFloor *floor) {
    const double near = near_share * scale_of(solid, hd_floor_centre(floor), 0.0);
    const double depth = hd_floor_depth(solid, floor, -near);
    if (depth <= -near)
        return HD_CONTACT_NONE;
    return depth <= near ? HD_CONTACT_TOUCHES : HD_CONTACT_OVERLAPS;
}

int hd_touching_lights(const HdSolid *solid, const HdLight *lights, int count, int *first) {
    const HdPlatonic shape = hd_solid_shape(solid);
    const double near = near_share * solid->circumradius;
    const double inradius = shape.inradius * solid->circumradius;
    int touching = 0;
    for (int i = 0; i < count; i++) {
        const HdVec3 place = hd_sub(lights[i].position, solid->centre);
        const double distance = hd_length(place);
        if (distance < inradius - near || distance > solid->circumradius + near)
            continue;
        double farthest = -distance;
        for (int f = 0; f < shape.face_count; f++)
            farthest = fmax(farthest, hd_dot(place, shape.face_normal[f]));
        if (fabs(farthest - inradius) <= near && touching++ == 0)
            *first = i;
    }
    return touching;
}

bool hd_contact_coincides(HdContact contact) {
    return contact == HD_CONTACT_TOUCHES || contact == HD_CONTACT_SHARES;
}

/* ---- separation ---- */

typedef struct Separation {
    const HdScene *scene;
    int level[HD_MAX_SOLIDS];   /* shrink of each solid, in steps */
    double step[HD_MAX_SOLIDS]; /* size of a step, the same for all solids of a group */
    int group[HD_MAX_SOLIDS];   /* number of the group of solids that touch, directly or through
                                   others */
} Separation;

static void join_groups(Separation *separation, int count, int from, int to) {
    const double step = fmax(separation->step[from], separation->step[to]);
    const int old = separation->group[from], joined = separation->group[to];
    for (int i = 0; i < count; i++) {
        if (separation->group[i] == old)
            separation->group[i] = joined;
        if (separation->group[i] == joined)
            separation->step[i] = fmax(separation->step[i], step);
    }
}

static void raise_step(Separation *separation, int solid, double scale) {
    separation->step[solid] = fmax(separation->step[solid], step_share * scale);
}

/* Returns whether the floor or a light touches the solid, so that level 0 is taken. */
static bool touches_fixed(Separation *separation, int index) {
    const HdScene *scene = separation->scene;
    const HdFloor *floor = &scene->floor;
    const HdSolid *solid = &scene->solids[index];
    int first;
    const bool at_floor = floor->present && hd_contact_coincides(hd_floor_contact(solid, floor));
    const bool at_light = hd_touching_lights(solid, scene->lights, scene->light_count, &first) > 0;
    if (at_floor)
        raise_step(separation, index, scale_of(solid, hd_floor_centre(floor), 0.0));
    if (at_light)
        raise_step(separation, index, solid->circumradius);
    return at_floor || at_light;
}

static void choose_level(Separation *separation, int index) {
    const HdSolid *solids = separation->scene->solids;
    bool taken[HD_MAX_SOLIDS + 1] = {false};
    separation->group[index] = index;
    taken[0] = touches_fixed(separation, index);
    for (int i = 0; i < index; i++) {
        if (!hd_contact_coincides(hd_solids_contact(&solids[i], &solids[index])))
            continue;
        taken[separation->level[i]] = true;
        raise_step(separation, index,
                   scale_of(&solids[index], solids[i].centre, solids[i].circumradius));
        join_groups(separation, index + 1, i, index);
    }
    while (taken[separation->level[index]])
        separation->level[index]++;
}

void hd_scene_separate_contacts(HdScene *scene) {
    Separation separation = {.scene = scene};
    for (int i = 0; i < scene->solid_count; i++)
        choose_level(&separation, i);
    for (int i = 0; i < scene->solid_count; i++) {
        HdSolid *solid = &scene->solids[i];
        HdPlatonic shape;
        hd_platonic(solid->kind, &shape);
        const double share =
            separation.level[i] * separation.step[i] / (shape.inradius * solid->circumradius);
        if (share <= max_inset_share)
            solid->circumradius *= 1.0 - share;
    }
}

/* ---- instances ---- */

static int compare_vectors(HdVec3 a, HdVec3 b) {
    if (a.x != b.x)
        return a.x < b.x ? -1 : 1;
    if (a.y != b.y)
        return a.y < b.y ? -1 : 1;
    return (a.z > b.z) - (a.z < b.z);
}

static int compare_places(const HdInstance *a, const HdInstance *b) {
    int order = (a->mesh > b->mesh) - (a->mesh < b->mesh);
    order = order != 0 ? order : (a->up > b->up) - (a->up < b->up);
    order = order != 0 ? order : compare_vectors(a->position, b->position);
    order = order != 0 ? order : compare_vectors(a->rotation_degrees, b->rotation_degrees);
    return order != 0 ? order : compare_vectors(a->scale, b->scale);
}

/* Orders those of one place as in the scene. */
static int compare_instances(const void *first, const void *second) {
    const HdInstance *a = *(const HdInstance *const *)first;
    const HdInstance *b = *(const HdInstance *const *)second;
    const int order = compare_places(a, b);
    return order != 0 ? order : (a > b) - (a < b);
}

HdStatus hd_scene_drop_second_instances(HdScene *scene, int *dropped, HdError *error) {
    const size_t count = (size_t)scene->instance_count;
    HdInstance **sorted = malloc((count + 1) * sizeof(HdInstance *));
    if (sorted == NULL)
        return HD_NO_ROOM(error, "%d places of meshes", scene->instance_count);
    for (size_t i = 0; i < count; i++)
        sorted[i] = &scene->instances[i];
    qsort(sorted, count, sizeof(HdInstance *), compare_instances);
    for (size_t i = count; i-- > 1;)
        if (compare_places(sorted[i - 1], sorted[i]) == 0)
            sorted[i]->mesh = -1;
    free(sorted);
    int kept = 0;
    for (int i = 0; i < scene->instance_count; i++)
        if (scene->instances[i].mesh >= 0)
            scene->instances[kept++] = scene->instances[i];
    *dropped = scene->instance_count - kept;
    scene->instance_count = kept;
    return HD_OK;
}
