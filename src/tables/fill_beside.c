/* SPDX-License-Identifier: MIT */
/* What is known beforehand of where objects are to each other (docs/numerics.md, Occlusion masks);
   compiled for each precision. */
#include "tables/builder.h"

#include <math.h>

#include "scene/overlap.h"

static HdVec3 way_between(const HdBuilder *builder, int from, int to) {
    return hd_sub(builder->centres[to], builder->centres[from]);
}

static double circumradius(const HdBuilder *builder, int object) {
    if (object < builder->solid_count)
        return builder->scene->solids[object].circumradius;
    if (!builder->has_floor || object != builder->solid_count)
        return sqrt(3.0) * builder->mesh_reach;
    double radius = 0.0;
    for (int i = 0; i < 4; i++) {
        HdVec3 corner = builder->scene->floor.corners[i];
        radius = fmax(radius, hd_length(hd_sub(corner, builder->centres[object])));
    }
    return radius;
}

/* No eye of the flight is further away from a point. */
static double farthest_eye(const HdPath *path, HdVec3 point) {
    const HdCylinderPath *cylinder = &path->cylinder;
    if (path->is_fixed)
        return hd_length(hd_sub(path->point, point));
    return hd_length(point) + fabs(cylinder->r0) + fabs(cylinder->r_amplitude) +
           fabs(cylinder->z0) + fabs(cylinder->z_amplitude);
}

/* Of a ball about the centre in which points are where rays meet the object: they are off by what
   rounding makes of the way that the ray came. */
static double radius_about(const HdBuilder *builder, int object) {
    double way = farthest_eye(&builder->scene->eye, builder->centres[object]);
    for (int i = 0; i < builder->object_count; i++)
        way = fmax(way, hd_length(way_between(builder, object, i)) + circumradius(builder, i));
    return 1.001 * circumradius(builder, object) + 1e-6 * way;
}

/* ---- ways of light ---- */

/* Distance of a point from the convex hull of a ball about the origin and a light, a cone with a
   round end. */
static double distance_to_ways(double radius, HdVec3 light, HdVec3 point) {
    double length = hd_length(light), share = 0.0;
    if (length > radius) {
        double along = hd_dot(point, light) / length;
        double across = sqrt(fmax(hd_dot(point, point) - along * along, 0.0));
        double sine = radius / length; /* of half the cone's angle */
        along -= across * sine / sqrt(1.0 - sine * sine);
        share = fmin(fmax(along / length, 0.0), 1.0);
    }
    double left = radius * (1.0 - share); /* of the ball there */
    return hd_length(hd_sub(point, hd_scale(light, share))) - left;
}

static bool solid_is_beside(const HdBuilder *builder, const HdLightSource *source, int object,
                            double radius, int solid) {
    HdVec3 centre = way_between(builder, object, solid);
    double slack = (hd_length(centre) + radius) * 1e-4 +
                   hd_length(hd_light_offset(builder, source, solid)) * 1e-5;
    double least = builder->scene->solids[solid].circumradius * 1.001 + slack;
    return distance_to_ways(radius, hd_light_offset(builder, source, object), centre) > least;
}

/* The points of an object, as lights see them. */
typedef struct {
    int object;
    double radius; /* of a ball about all of them */
    int side;      /* of the floor's plane: 1, -1, or 0 for both */
} Lit;

/* Corners tell of a solid, its ball of meshes. */
static int side_of_floor(const HdBuilder *builder, int object, double radius) {
    HdVec3 normal = hd_floor_frame(&builder->scene->floor).normal;
    HdVec3 centre = way_between(builder, builder->solid_count, object);
    double reach = radius;
    if (object < builder->solid_count) {
        const HdPlatonic *shape = &builder->shapes[object];
        double most = 0.0;
        for (int i = 0; i < shape->vertex_count; i++)
            most = fmax(most, fabs(hd_dot(normal, shape->vertex[i])));
        reach -= (1.0 - most) * circumradius(builder, object);
    }
    double least = reach + (hd_length(centre) + radius) * 1e-4, height = hd_dot(normal, centre);
    return (height > least) - (height < -least);
}

static bool floor_is_beside(const HdBuilder *builder, int light, const Lit *lit) {
    if (lit->object == builder->solid_count)
        return true; /* it is in nobody's light who is on it */
    const real *row = (const real *)builder->table[HD_TABLE_light_coordinates] +
                      (size_t)light * (size_t)builder->plane_count;
    real height = row[builder->plane_count - HD_FLOOR_PLANES];
    return lit->side > 0 ? height > R(0.0) : lit->side < 0 && height < R(0.0);
}

static int beside_ways(const HdBuilder *builder, int light, const Lit *lit) {
    const HdLightSource *source = &builder->sources[light];
    const LightSides *sides = (const LightSides *)builder->table[HD_TABLE_light_sides] +
                              (size_t)light * (size_t)builder->object_count;
    int beside = 0;
    for (int s = 0; s < builder->solid_count && s < HD_JUDGED_OBJECTS; s++) {
        /* Segments leave their own solid only to where the light is outside of it. */
        bool is_beside = s == lit->object
                             ? sides[s].outside == 0
                             : solid_is_beside(builder, source, lit->object, lit->radius, s);
        beside |= is_beside ? 1 << s : 0;
    }
    if (builder->has_floor && builder->solid_count < HD_JUDGED_OBJECTS)
        beside |= floor_is_beside(builder, light, lit) ? 1 << builder->solid_count : 0;
    return beside;
}

/* Kernels measure nothing for what is beside the ways of all lights: the first number has no bit
   that the number of some light has not. */
static void fill_ways(const HdBuilder *builder, int object) {
    int *beside = (int *)builder->table[HD_TABLE_light_ways] +
                  (size_t)object * ((size_t)builder->light_count + 1);
    double radius = radius_about(builder, object);
    Lit lit = {object, radius, builder->has_floor ? side_of_floor(builder, object, radius) : 0};
    beside[0] = -1;
    for (int i = 0; i < builder->light_count; i++) {
        beside[i + 1] = beside_ways(builder, i, &lit);
        beside[0] &= beside[i + 1];
    }
}

/* ---- what reaches into a solid ---- */

/* Objects with less between them might meet, for all that rounding does. */
static double least_gap(const HdBuilder *builder, int a, int b) {
    return (radius_about(builder, a) + radius_about(builder, b)) * 1.0001 -
           circumradius(builder, a) - circumradius(builder, b);
}

static bool reaches_into(const HdBuilder *builder, int other, int solid) {
    const HdScene *scene = builder->scene;
    double least = -least_gap(builder, solid, other);
    if (other < builder->solid_count)
        return hd_solid_depth(&scene->solids[solid], &scene->solids[other], least) > least;
    if (builder->has_floor && other == builder->solid_count)
        return hd_floor_depth(&scene->solids[solid], &scene->floor, least) > least;
    double sum = circumradius(builder, solid) + circumradius(builder, other);
    return !(hd_length(way_between(builder, solid, other)) - sum > -least);
}

static bool is_apart(const HdBuilder *builder, int solid) {
    for (int i = 0; i < builder->object_count; i++)
        if (i != solid && reaches_into(builder, i, solid))
            return false;
    return true;
}

void NAMED(hd_fill_beside)(const HdBuilder *builder) {
    Object *objects = builder->table[HD_TABLE_objects];
    for (int i = 0; i < builder->object_count; i++) {
        fill_ways(builder, i);
        objects[i].apart = i < builder->solid_count && is_apart(builder, i);
    }
}
