/* SPDX-License-Identifier: MIT */
/* Closest hit of a bundle of rays with the solids and the floor. There is no epsilon: a ray carries
   the object it touched last and the side it runs on (docs/numerics.md). */
#ifndef HD_INTERSECTION_H
#define HD_INTERSECTION_H

#include "scene_arguments.h"
#include "vectors.h"

typedef struct {
    Vec3 origin;    /* relative to the object touched last, or to the eye */
    Vec3 direction; /* unit, up to rounding */
    Vec3 weight;    /* what this ray's radiance is multiplied by on its way to the eye */
    vint touched;   /* number of the object touched last; only in rays that left an object */
    vmask inside;   /* runs inside the solid touched last */
    vmask alive;
} Ray;

typedef struct {
    vreal t;     /* along the ray */
    vint object; /* -1: none */
    vint plane;
    vmask entering; /* meets a solid from outside */
} Hit;

/* Where the rays' origins are relative to: the eye (every lane) or the object touched last. */
typedef struct {
    int is_eye;
    int same; /* every lane has the same object */
    vint row; /* first entry of the lane's object in object_offsets */
} Reference;

FN Reference reference_of(SCENE_PARAMETERS vint object, int is_eye) {
    Reference reference;
    reference.is_eye = is_eye;
    reference.same = is_eye || all_same(object);
    reference.row = is_eye ? splat_int(0) : object * header->object_count;
    return reference;
}

/* The point `point`, relative to `reference`, made relative to the object `to`. */
FN Vec3 move_to_object(SCENE_PARAMETERS Reference reference, Vec3 point, int to) {
    GLOBAL const Vector *table = reference.is_eye ? eye_offsets : object_offsets;
    return vec3_add(point, fetch_vector(table, reference.row + to, reference.same));
}

FN void keep_closer(Hit *hit, vmask candidate, vreal t, int object, vint plane, vmask entering) {
    vmask closer = candidate & lt(t, hit->t);
    hit->t = pick(closer, t, hit->t);
    hit->object = pick_int(closer, splat_int(object), hit->object);
    hit->plane = pick_int(closer, plane, hit->plane);
    hit->entering = pick_int(closer, entering, hit->entering);
}

/* Lanes whose rays certainly miss a sphere about the object's centre: they pass it by, or are
   outside and run away from it. The margin covers the rounding of both sides and directions that
   are not quite unit, so that no ray is taken for a miss that the planes would call a hit. */
FN vmask misses_sphere(vreal radius_squared, Vec3 origin, Vec3 direction) {
    vreal along = vec3_dot(origin, direction), away = vec3_dot(origin, origin);
    vreal bound = multiply_add(away, splat(R(0.001)), radius_squared);
    vmask runs_away = lt(bound, away) & lt(splat(R(0.0)), along);
    return runs_away | lt(bound, multiply_add(-along, along, away));
}

FN void hit_solid(SCENE_PARAMETERS const Ray *ray, Reference reference, int object, Hit *hit) {
    GLOBAL const Object *solid = objects + object;
    vmask own = reference.is_eye ? mask_none() : eq_int(ray->touched, splat_int(object));
    vmask own_inside = own & ray->inside;
    if (!any_lane(ray->alive & (~own | own_inside)))
        return; /* a convex solid is not met again from its outside */

    Vec3 origin = move_to_object(SCENE_ARGUMENTS reference, ray->origin, object);
    vmask far =
        ~own_inside & misses_sphere(splat(solid->circumradius_squared), origin, ray->direction);
    if (!any_lane(ray->alive & ~far & (~own | own_inside)))
        return;
    vreal zero = splat(R(0.0));
    vreal entry = splat(R(-1.0)), exit = splat(REAL_LARGE);
    vint entry_plane = splat_int(-1), exit_plane = splat_int(0);
    vmask missed = mask_none();
    for (int k = solid->first_plane; k < solid->first_plane + solid->plane_count; k++) {
        vreal distance = plane_distance(planes + k, origin);
        vreal slope = plane_slope(planes + k, ray->direction);
        vmask towards = lt(slope, zero);
        vmask below = lt(distance, zero) | own_inside;
        vreal t = -distance / slope;
        /* The origin is strictly outside of this plane and the ray runs inwards. */
        vmask enters = lt(zero, distance) & towards & ~own_inside & lt(entry, t);
        entry = pick(enters, t, entry);
        entry_plane = pick_int(enters, splat_int(k), entry_plane);
        /* From inside an exit lies at t >= 0, though rounding may have put the origin outside. */
        vmask exits = below & lt(zero, slope) & lt(greater(t, zero), exit);
        exit = pick(exits, greater(t, zero), exit);
        exit_plane = pick_int(exits, splat_int(k), exit_plane);
        missed = missed | (~below & ~towards);
    }
    vmask outside = ~lt_int(entry_plane, splat_int(0));
    vmask meets = ~own & ~missed & (~outside | lt(entry, exit));
    keep_closer(hit, (own_inside | meets) & lt(exit, splat(REAL_LARGE)), pick(outside, entry, exit),
                object, pick_int(outside, entry_plane, exit_plane), outside);
}

FN void hit_floor(SCENE_PARAMETERS const Ray *ray, Reference reference, int object, Hit *hit) {
    vmask own = reference.is_eye ? mask_none() : eq_int(ray->touched, splat_int(object));
    if (!any_lane(ray->alive & ~own))
        return;
    int first = objects[object].first_plane;
    Vec3 origin = move_to_object(SCENE_ARGUMENTS reference, ray->origin, object);
    vreal zero = splat(R(0.0));
    vreal distance = plane_distance(planes + first, origin);
    vreal slope = plane_slope(planes + first, ray->direction);
    vmask crossing =
        (lt(zero, distance) & lt(slope, zero)) | (lt(distance, zero) & lt(zero, slope));
    vreal t = -distance / slope;
    for (int side = first + 1; side < first + 1 + HD_FLOOR_SIDES; side++) {
        vreal beyond = multiply_add(t, plane_slope(planes + side, ray->direction),
                                    plane_distance(planes + side, origin));
        crossing = crossing & le(beyond, zero);
    }
    keep_closer(hit, crossing & ~own, t, object, splat_int(first), lt(slope, zero));
}

/* For the floor, `entering` says that it is met from above its normal. */
FN Hit closest_hit(SCENE_PARAMETERS const Ray *ray, Reference reference) {
    Hit hit;
    hit.t = splat(REAL_LARGE);
    hit.object = splat_int(-1);
    hit.plane = splat_int(0);
    hit.entering = mask_none();
    for (int object = 0; object < header->solid_count; object++)
        hit_solid(SCENE_ARGUMENTS ray, reference, object, &hit);
    for (int object = header->solid_count; object < header->object_count; object++)
        hit_floor(SCENE_ARGUMENTS ray, reference, object, &hit);
    return hit;
}

#endif
