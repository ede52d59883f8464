/* SPDX-License-Identifier: MIT */
/* Closest hit of a packet of rays with the solids and the floor. There is no epsilon: a ray carries
   its last hit and the side it runs on (docs/numerics.md). */
#ifndef HD_INTERSECTION_H
#define HD_INTERSECTION_H

#include "kernel_arguments.h"
#include "vectors.h"

typedef struct {
    Vec3 origin;    /* relative to the last hit object or mesh instance, or to the eye */
    Vec3 direction; /* unit, up to rounding */
    Vec3 weight;    /* factor of this ray's radiance on its way to the eye */
    vint last_hit;  /* number of the last hit object; only in rays that left an object */
    vint face;      /* and of its face; used in scenes with meshes only */
    vmask inside;   /* runs inside the last hit solid */
    vmask alive;
} Ray;

typedef struct {
    vreal t;     /* along the ray */
    vint object; /* -1: none */
    vint face;
    vmask entering; /* hits a solid from outside */
} Hit;

/* The local origin of rays: the eye (in every lane) or the last hit object. */
typedef struct {
    int is_eye;
    int same;      /* whether every lane has the same object */
    vint row;      /* first entry of the lane's object in object_offsets */
    int first_row; /* the first lane's */
    Vec3 start;    /* place of the lane's mesh instance, relative to the meshes' centre */
} LocalOrigin;

/* Returns the object of a number, which may be a mesh instance's. */
FN vint object_of(SCENE_PARAMETERS vint number) {
    return MESHES(header) ? min_int(number, splat_int(header->floor_end)) : number;
}

/* Returns the place of mesh instances, relative to the meshes' centre; zero for other objects. */
FN Vec3 start_of_instance(SCENE_PARAMETERS vint number) {
    enum { STRIDE = sizeof(Instance) / sizeof(real) };
    vint instance = number - header->floor_end;
    vmask is_instance = ~lt_int(instance, splat_int(0));
    if (!any_lane(is_instance))
        return vec3_zero();
    GLOBAL const real *starts = instances->start;
    FourReals start =
        fetch_four_reals(starts, vselect_int(is_instance, instance, splat_int(0)) * STRIDE);
    return vec3_select(is_instance, vec3(start.number[0], start.number[1], start.number[2]),
                       vec3_zero());
}

FN LocalOrigin local_origin_of(SCENE_PARAMETERS vint object, int is_eye) {
    LocalOrigin local_origin;
    local_origin.start = vec3_zero();
    if (MESHES(header) && !is_eye)
        local_origin.start = start_of_instance(SCENE_ARGUMENTS object);
    object = object_of(SCENE_ARGUMENTS object);
    local_origin.is_eye = is_eye;
    local_origin.same = is_eye || all_same(object);
    local_origin.first_row = is_eye ? 0 : lane_int(&object, 0) * header->object_count;
    local_origin.row = object * header->object_count;
    return local_origin;
}

/* Returns a point that is relative to `local_origin`, made relative to the object `to`. */
FN Vec3 move_to_object(SCENE_PARAMETERS LocalOrigin local_origin, Vec3 point, int to) {
    GLOBAL const Vector *table = local_origin.is_eye ? eye_offsets : object_offsets;
    if (MESHES(header))
        point = vec3_add(point, local_origin.start);
    if (local_origin.same)
        return vec3_add(point, vec3_of(&table[local_origin.first_row + to].x));
    return vec3_add(point, fetch_vector(table, local_origin.row + to));
}

FN void keep_closer(Hit *hit, vmask candidate, vreal t, int object, vint face, vmask entering) {
    vmask closer = candidate & lt(t, hit->t);
    hit->t = vselect(closer, t, hit->t);
    hit->object = vselect_int(closer, splat_int(object), hit->object);
    hit->face = vselect_int(closer, face, hit->face);
    hit->entering = vselect_mask(closer, entering, hit->entering);
}

/* Returns lanes whose rays certainly miss a sphere about the object's centre. The margin covers the
   rounding of both sides and of unit directions, so that no ray counts as a miss that hits the
   planes. */
FN vmask misses_sphere(vreal radius_squared, Vec3 origin, Vec3 direction) {
    vreal along = vec3_dot(origin, direction), away = vec3_dot(origin, origin);
    vreal bound = multiply_add(away, splat(R(0.001)), radius_squared);
    vmask runs_away = lt(bound, away) & lt(splat(R(0.0)), along);
    return runs_away | lt(bound, multiply_add(-along, along, away));
}

/* A ray's crossing of a plane: t = distance / |slope|. Products compare two of them, which leaves
   one division to the end of a search. */
typedef struct {
    vreal distance; /* along the normal, not negative */
    vreal slope;
    vint plane;
} Crossing;

/* Returns the crossing's t; undefined in lanes without a slope. */
FN vreal crossing_time(Crossing c) {
    return c.distance * reciprocal(absolute(c.slope));
}

FN vmask is_before(Crossing a, Crossing b) {
    return lt(a.distance * absolute(b.slope), b.distance * absolute(a.slope));
}

FN Crossing select_crossing(vmask m, Crossing a, Crossing b) {
    Crossing picked;
    picked.distance = vselect(m, a.distance, b.distance);
    picked.slope = vselect(m, a.slope, b.slope);
    picked.plane = vselect_int(m, a.plane, b.plane);
    return picked;
}

FN Crossing crossing(real distance, real slope, int plane) {
    Crossing c;
    c.distance = splat(distance);
    c.slope = splat(slope);
    c.plane = splat_int(plane);
    return c;
}

/* Intersects the slabs between a solid's parallel planes (Kay and Kajiya 1986). A ray leaves each
   by the plane that it runs towards from inside, and enters it by the other one. */
FN void hit_solid(SCENE_PARAMETERS const Ray *ray, LocalOrigin local_origin, int object, Hit *hit) {
    GLOBAL const Object *solid = objects + object;
    vmask own = local_origin.is_eye ? mask_none() : eq_int(ray->last_hit, splat_int(object));
    vmask own_inside = own & ray->inside;
    if (!any_lane(ray->alive & (~own | own_inside)))
        return; /* rays that leave a convex solid do not hit it again */

    Vec3 origin = move_to_object(SCENE_ARGUMENTS local_origin, ray->origin, object);
    vmask outside = ray->alive & ~own &
                    ~misses_sphere(splat(solid->circumradius_squared), origin, ray->direction);
    int from_outside = any_lane(outside);
    if (!from_outside && !any_lane(ray->alive & own_inside))
        return;
    vreal zero = splat(R(0.0));
    Crossing exit = crossing(R(1.0), R(0.0), solid->first_plane); /* never reached */
    Crossing entry = crossing(R(0.0), R(1.0), -1);                /* at the origin */
    vmask beyond = mask_none();
    for (int k = solid->first_plane; k < solid->first_plane + solid->plane_count; k++) {
        vreal width = splat(planes[k].distance);
        Crossing next;
        next.slope = along_normal(planes + k, ray->direction) + zero; /* no -0 */
        next.plane = splat_int(k);
        vreal forward = times_sign_of(along_normal(planes + k, origin), next.slope);
        vreal to_exit = width - forward, to_entry = -width - forward;
        if (!solid->paired) {
            vmask against = lt(next.slope, zero);
            to_exit = vselect(against, splat(REAL_LARGE), to_exit);
            to_entry = vselect(against, to_entry, splat(-REAL_LARGE));
        }
        /* From inside an exit lies at t >= 0, though rounding may have put the origin outside. */
        next.distance = vmax(to_exit, zero);
        exit = select_crossing(is_before(next, exit), next, exit);
        if (from_outside) {
            beyond = beyond | lt(to_exit, zero);
            next.distance = to_entry;
            entry = select_crossing(is_before(entry, next), next, entry);
        }
    }
    vmask enters = ~own & ~lt_int(entry.plane, splat_int(0));
    vmask meets = outside & ~beyond & is_before(entry, exit);
    Crossing met = select_crossing(enters, entry, exit);
    /* The slope is negative if the ray enters by the first plane or leaves by the second. */
    vint face = met.plane + met.plane;
    face = vselect_int(enters ^ lt(met.slope, zero), face + 1, face);
    keep_closer(hit, meets | own_inside, crossing_time(met), object, face, enters);
}

FN void hit_floor(SCENE_PARAMETERS const Ray *ray, LocalOrigin local_origin, int object, Hit *hit) {
    vmask own = local_origin.is_eye ? mask_none() : eq_int(ray->last_hit, splat_int(object));
    if (!any_lane(ray->alive & ~own))
        return;
    int first = objects[object].first_plane;
    Vec3 origin = move_to_object(SCENE_ARGUMENTS local_origin, ray->origin, object);
    vreal zero = splat(R(0.0)), least = splat(R(1e-30)); /* smaller slopes count as 0 */
    vreal distance = along_normal(planes + first, origin);
    vreal slope = along_normal(planes + first, ray->direction);
    vmask crossing =
        (lt(zero, distance) & lt(slope, -least)) | (lt(distance, zero) & lt(least, slope));
    vreal t = absolute(distance) * reciprocal(absolute(slope));
    for (int side = first + 1; side < first + 1 + HD_FLOOR_SIDES; side++) {
        vreal beyond = multiply_add(t, along_normal(planes + side, ray->direction),
                                    plane_distance(planes + side, origin));
        crossing = crossing & le(beyond, zero);
    }
    keep_closer(hit, crossing & ~own, t, object, splat_int(2 * first), lt(slope, zero));
}

#endif
