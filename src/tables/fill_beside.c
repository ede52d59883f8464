/* SPDX-License-Identifier: MIT */
/* What is known beforehand of where objects are to each other (docs/numerics.md, Beside and apart);
   compiled for each precision. */
#include "tables/builder.h"

#include <math.h>

/* A ball that all points of a site are in; world space. */
typedef struct {
    HdVec3 centre;
    double radius;
    int object;
} Site;

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

/* More than an object's own by far more than rounding can do. */
static Site site_of_object(const HdBuilder *builder, int object) {
    return (Site){builder->centres[object], 1.001 * circumradius(builder, object), object};
}

/* Of the convex hull of a site's ball and a light, a cone with a round end. */
static double distance_to_ways(const Site *site, HdVec3 light, HdVec3 point) {
    HdVec3 way = hd_sub(light, site->centre), to_point = hd_sub(point, site->centre);
    double length = hd_length(way), share = 0.0;
    if (length > site->radius) {
        double along = hd_dot(to_point, way) / length;
        double across = sqrt(fmax(hd_dot(to_point, to_point) - along * along, 0.0));
        double sine = site->radius / length; /* of half the cone's angle */
        along -= across * sine / sqrt(1.0 - sine * sine);
        share = fmin(fmax(along / length, 0.0), 1.0);
    }
    double radius = site->radius * (1.0 - share); /* of the ball there */
    return hd_length(hd_sub(to_point, hd_scale(way, share))) - radius;
}

static bool solid_is_beside(const HdBuilder *builder, int solid, const Site *site, HdVec3 light) {
    HdVec3 centre = builder->centres[solid];
    double slack = (hd_length(hd_sub(site->centre, centre)) + site->radius) * 1e-4 +
                   hd_length(hd_sub(light, centre)) * 1e-5;
    double radius = builder->scene->solids[solid].circumradius * 1.001;
    return distance_to_ways(site, light, centre) > radius + slack;
}

/* How far a site reaches from its centre in a direction and against it. */
static double reach_along(const HdBuilder *builder, const Site *site, HdVec3 direction) {
    if (site->object >= builder->solid_count)
        return site->radius;
    const HdPlatonic *shape = &builder->shapes[site->object];
    double most = 0.0;
    for (int i = 0; i < shape->vertex_count; i++)
        most = fmax(most, fabs(hd_dot(direction, shape->vertex[i])));
    return most * site->radius;
}

/* The side of the floor's plane that a site is on: 1, -1, or 0 for both. */
static int side_of_floor(const HdBuilder *builder, const Site *site) {
    HdVec3 normal = hd_floor_frame(&builder->scene->floor).normal;
    HdVec3 centre = hd_sub(site->centre, builder->centres[builder->solid_count]);
    double height = hd_dot(normal, centre);
    double least = reach_along(builder, site, normal) + (hd_length(centre) + site->radius) * 1e-4;
    return (height > least) - (height < -least);
}

static bool floor_is_beside(const HdBuilder *builder, const Site *site, int light) {
    if (site->object == builder->solid_count)
        return true; /* it is in nobody's light who is on it */
    const real *row = (const real *)builder->table[HD_TABLE_light_coordinates] +
                      (size_t)light * (size_t)builder->plane_count;
    real height = row[builder->plane_count - HD_FLOOR_PLANES];
    int side = side_of_floor(builder, site);
    return side > 0 ? height > R(0.0) : side < 0 && height < R(0.0);
}

static int beside_ways(const HdBuilder *builder, const Site *site, int light) {
    const LightSides *sides = (const LightSides *)builder->table[HD_TABLE_light_sides] +
                              (size_t)light * (size_t)builder->object_count;
    HdVec3 position = hd_light_offset(builder, &builder->sources[light], site->object);
    position = hd_add(position, builder->centres[site->object]);
    int beside = 0;
    for (int s = 0; s < builder->solid_count && s < HD_JUDGED_OBJECTS; s++) {
        /* Segments leave their own solid only to where the light is outside of it. */
        bool is_beside =
            s == site->object ? sides[s].outside == 0 : solid_is_beside(builder, s, site, position);
        beside |= is_beside ? 1 << s : 0;
    }
    if (builder->has_floor && builder->solid_count < HD_JUDGED_OBJECTS)
        beside |= floor_is_beside(builder, site, light) ? 1 << builder->solid_count : 0;
    return beside;
}

static void fill_site(const HdBuilder *builder, int number, const Site *site) {
    int *beside = (int *)builder->table[HD_TABLE_light_ways] +
                  (size_t)number * ((size_t)builder->light_count + 1);
    beside[0] = -1;
    for (int i = 0; i < builder->light_count; i++) {
        beside[i + 1] = beside_ways(builder, site, i);
        beside[0] &= beside[i + 1];
    }
}

/* ---- what reaches into a solid ---- */

static bool is_apart(const HdBuilder *builder, int solid) {
    Site site = site_of_object(builder, solid);
    for (int other = 0; other < builder->object_count; other++) {
        if (other == solid)
            continue;
        Site reach = site_of_object(builder, other);
        double distance = hd_length(hd_sub(site.centre, reach.centre));
        bool is_floor = builder->has_floor && other == builder->solid_count;
        if (is_floor ? side_of_floor(builder, &site) == 0
                     : !(distance > (site.radius + reach.radius) * 1.0001))
            return false;
    }
    return true;
}

void NAMED(hd_fill_beside)(const HdBuilder *builder) {
    Object *objects = builder->table[HD_TABLE_objects];
    for (int i = 0; i < builder->object_count; i++) {
        Site site = site_of_object(builder, i);
        fill_site(builder, i, &site);
        objects[i].apart = i < builder->solid_count && is_apart(builder, i);
    }
}
