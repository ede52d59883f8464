/* SPDX-License-Identifier: MIT */
/* Bundles of vectors, and reading tables lane by lane. */
#ifndef HD_VECTORS_H
#define HD_VECTORS_H

#include "scene_tables.h"

typedef struct {
    vreal x, y, z;
} Vec3;

FN Vec3 vec3(vreal x, vreal y, vreal z) {
    Vec3 v;
    v.x = x;
    v.y = y;
    v.z = z;
    return v;
}

FN Vec3 vec3_splat(real x, real y, real z) {
    return vec3(splat(x), splat(y), splat(z));
}
FN Vec3 vec3_zero(void) {
    return vec3_splat(R(0.0), R(0.0), R(0.0));
}
FN Vec3 vec3_add(Vec3 a, Vec3 b) {
    return vec3(a.x + b.x, a.y + b.y, a.z + b.z);
}
FN Vec3 vec3_sub(Vec3 a, Vec3 b) {
    return vec3(a.x - b.x, a.y - b.y, a.z - b.z);
}
FN Vec3 vec3_mul(Vec3 a, Vec3 b) {
    return vec3(a.x * b.x, a.y * b.y, a.z * b.z);
}
FN Vec3 vec3_scale(Vec3 a, vreal s) {
    return vec3(a.x * s, a.y * s, a.z * s);
}

/* a * s + b */
FN Vec3 vec3_scale_add(Vec3 a, vreal s, Vec3 b) {
    return vec3(multiply_add(a.x, s, b.x), multiply_add(a.y, s, b.y), multiply_add(a.z, s, b.z));
}

FN vreal vec3_dot(Vec3 a, Vec3 b) {
    return multiply_add(a.x, b.x, multiply_add(a.y, b.y, a.z * b.z));
}

FN Vec3 vec3_pick(vmask m, Vec3 a, Vec3 b) {
    return vec3(pick(m, a.x, b.x), pick(m, a.y, b.y), pick(m, a.z, b.z));
}

FN Vec3 vec3_normalize(Vec3 a) {
    return vec3_scale(a, splat(R(1.0)) / square_root(vec3_dot(a, a)));
}

/* Non-zero when all lanes hold the same number. */
FN int all_same(vint a) {
    return !any_lane(~eq_int(a, splat_int(lane_int(&a, 0))));
}

/* Numbers in which the lanes outside of `m` repeat one from inside, so that dead lanes neither hold
   a wrong number nor make a bundle look mixed. */
FN vint spread_first(vint numbers, vmask m) {
    int filler = any_lane(m) ? lane_int(&numbers, first_lane(m)) : 0;
    return pick_int(m, numbers, splat_int(filler));
}

/* table[index] for each lane; `same` is all_same(index), which callers compute once for many reads.
 */
FN Vec3 fetch_vector(GLOBAL const Vector *table, vint index, int same) {
    if (same) {
        GLOBAL const Vector *v = table + lane_int(&index, 0);
        return vec3_splat(v->x, v->y, v->z);
    }
    Vec3 result = vec3_zero();
    for (int lane = 0; lane < HD_LANES; lane++) {
        GLOBAL const Vector *v = table + lane_int(&index, lane);
        set_lane_real(&result.x, lane, v->x);
        set_lane_real(&result.y, lane, v->y);
        set_lane_real(&result.z, lane, v->z);
    }
    return result;
}

/* Signed distance of a point to a plane of the same object, positive outside. */
FN vreal plane_distance(GLOBAL const Plane *plane, Vec3 point) {
    return multiply_add(
        splat(plane->x), point.x,
        multiply_add(splat(plane->y), point.y,
                     multiply_add(splat(plane->z), point.z, splat(-plane->distance))));
}

/* Cosine between a direction and the plane's outward normal, times the direction's length. */
FN vreal plane_slope(GLOBAL const Plane *plane, Vec3 direction) {
    return multiply_add(splat(plane->x), direction.x,
                        multiply_add(splat(plane->y), direction.y, splat(plane->z) * direction.z));
}

#endif
