/* SPDX-License-Identifier: MIT */
/* Packets of vectors, and reading tables lane by lane. */
#ifndef HD_VECTORS_H
#define HD_VECTORS_H

#include "division.h"
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
/* Returns three consecutive table entries in all lanes. */
FN Vec3 vec3_of(GLOBAL const real *row) {
    return vec3_splat(row[0], row[1], row[2]);
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

/* Returns a * b + c by component. */
FN Vec3 vec3_mul_add(Vec3 a, Vec3 b, Vec3 c) {
    return vec3(multiply_add(a.x, b.x, c.x), multiply_add(a.y, b.y, c.y),
                multiply_add(a.z, b.z, c.z));
}

/* Returns a * s + b. */
FN Vec3 vec3_scale_add(Vec3 a, vreal s, Vec3 b) {
    return vec3(multiply_add(a.x, s, b.x), multiply_add(a.y, s, b.y), multiply_add(a.z, s, b.z));
}

FN vreal vec3_dot(Vec3 a, Vec3 b) {
    return multiply_add(a.x, b.x, multiply_add(a.y, b.y, a.z * b.z));
}

FN Vec3 vec3_cross(Vec3 a, Vec3 b) {
    return vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

FN Vec3 vec3_select(vmask m, Vec3 a, Vec3 b) {
    return vec3(vselect(m, a.x, b.x), vselect(m, a.y, b.y), vselect(m, a.z, b.z));
}

FN Vec3 vec3_normalize(Vec3 a) {
    return vec3_scale(a, reciprocal_root(vec3_dot(a, a)));
}

/* Returns non-zero if all lanes hold the same number. */
FN int all_same(vint a) {
    return !any_lane(~eq_int(a, splat_int(lane_int(&a, 0))));
}

/* Returns `numbers` with the lanes outside `m` replaced by the first number inside. So dead lanes
   hold a valid number and do not make a packet look mixed. */
FN vint spread_first(vint numbers, vmask m) {
    int filler = any_lane(m) ? lane_int(&numbers, first_lane(m)) : 0;
    return vselect_int(m, numbers, splat_int(filler));
}

/* Returns table[index] for each lane; suits packets with few different numbers. */
FN Vec3 fetch_vector(GLOBAL const Vector *table, vint index) {
    GLOBAL const Vector *v = table + lane_int(&index, 0);
    Vec3 result = vec3_splat(v->x, v->y, v->z);
    vmask left = ~eq_int(index, splat_int(lane_int(&index, 0)));
    while (any_lane(left)) {
        int number = lane_int(&index, first_lane(left));
        vmask m = eq_int(index, splat_int(number));
        v = table + number;
        result = vec3_select(m, vec3_splat(v->x, v->y, v->z), result);
        left = lanes_after(left, m);
    }
    return result;
}

/* Returns n.v for a plane's normal n: a point's coordinate along it, or a direction's slope. */
FN vreal along_normal(GLOBAL const Plane *plane, Vec3 v) {
    return multiply_add(splat(plane->x), v.x,
                        multiply_add(splat(plane->y), v.y, splat(plane->z) * v.z));
}

/* Returns the signed distance of a point to a plane of the same object, positive outside. */
FN vreal plane_distance(GLOBAL const Plane *plane, Vec3 point) {
    return along_normal(plane, point) - splat(plane->distance);
}

#endif
