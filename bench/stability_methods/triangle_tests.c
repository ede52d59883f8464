/* SPDX-License-Identifier: MIT */
/* HD_TESTS names the table; with HD_CONTRACTED it has those that contraction changes. */
#include "triangle_tests.h"

#include <math.h>

static HdFloat3 sub(HdFloat3 a, HdFloat3 b) {
    return (HdFloat3){a.x - b.x, a.y - b.y, a.z - b.z};
}

static HdFloat3 cross(HdFloat3 a, HdFloat3 b) {
    return (HdFloat3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static float dot(HdFloat3 a, HdFloat3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static float component(HdFloat3 a, int axis) {
    return axis == 0 ? a.x : axis == 1 ? a.y : a.z;
}

/* ---- precomputation ---- */

static void prepare_ray(HdFloatRay *ray) {
    HdFloat3 d = ray->direction;
    ray->moment = cross(ray->origin, d);
    float x = fabsf(d.x), y = fabsf(d.y), z = fabsf(d.z);
    int last = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
    ray->axis[0] = (last + 1) % 3;
    ray->axis[1] = (last + 2) % 3;
    ray->axis[2] = last;
    ray->shear[0] = component(d, ray->axis[0]) / component(d, last);
    ray->shear[1] = component(d, ray->axis[1]) / component(d, last);
    ray->shear[2] = 1.0f / component(d, last);
}

/* D. Baldwin, M. Weber 2016, Fast Ray-Triangle Intersections by Coordinate Transformation. */
static void prepare_triangle(HdFloatTriangle *triangle) {
    HdFloat3 e1 = sub(triangle->b, triangle->a), e2 = sub(triangle->c, triangle->a);
    HdFloat3 n = cross(e1, e2);
    float x = fabsf(n.x), y = fabsf(n.y), z = fabsf(n.z);
    int free_axis = x > y && x > z ? 0 : y > z ? 1 : 2;
    int i = (free_axis + 1) % 3, j = (free_axis + 2) % 3;
    float most = component(n, free_axis);
    float(*rows)[4] = triangle->to_unit;
    rows[0][free_axis] = rows[1][free_axis] = 0.0f;
    rows[0][i] = component(e2, j) / most;
    rows[0][j] = -component(e2, i) / most;
    rows[1][i] = -component(e1, j) / most;
    rows[1][j] = component(e1, i) / most;
    for (int row = 0; row < 2; row++)
        rows[row][3] =
            -(rows[row][i] * component(triangle->a, i) + rows[row][j] * component(triangle->a, j));
    rows[2][0] = n.x / most;
    rows[2][1] = n.y / most;
    rows[2][2] = n.z / most;
    rows[2][3] = -dot(n, triangle->a) / most;
    triangle->normal_sign = most < 0.0f ? -1.0f : 1.0f;
}

/* ---- the watertight test ---- */

typedef struct Corner {
    float x, y, z;
} Corner;

static Corner project(const HdFloatRay *ray, HdFloat3 p) {
    HdFloat3 from = sub(p, ray->origin);
    float z = component(from, ray->axis[2]);
    return (Corner){component(from, ray->axis[0]) - ray->shear[0] * z,
                    component(from, ray->axis[1]) - ray->shear[1] * z, ray->shear[2] * z};
}

/* Returns the side of a - b on which the ray passes; again in double if float cannot decide. */
static float edge(Corner a, Corner b) {
    float area = a.x * b.y - a.y * b.x;
    if (area == 0.0f)
        area = (float)((double)a.x * (double)b.y - (double)a.y * (double)b.x);
    return area;
}

/* Applies the tie rule: a ray through an edge belongs to one of its two triangles. */
static float untied(float area, Corner a, Corner b) {
    if (area != 0.0f)
        return area;
    if (a.y != b.y)
        return b.y < a.y ? 1e-30f : -1e-30f;
    return a.x < b.x ? 1e-30f : b.x < a.x ? -1e-30f : 0.0f;
}

/* S. Woop, C. Benthin, I. Wald 2013, Watertight Ray/Triangle Intersection. */
static bool woop(const HdFloatRay *ray, const HdFloatTriangle *triangle, bool breaks_ties,
                 HdMeeting *meeting) {
    Corner a = project(ray, triangle->a), b = project(ray, triangle->b);
    Corner c = project(ray, triangle->c);
    float u = edge(b, c), v = edge(c, a), w = edge(a, b);
    float sign_u = breaks_ties ? untied(u, b, c) : u, sign_v = breaks_ties ? untied(v, c, a) : v;
    float sign_w = breaks_ties ? untied(w, a, b) : w;
    bool some_right = sign_u < 0.0f || sign_v < 0.0f || sign_w < 0.0f;
    bool some_left = sign_u > 0.0f || sign_v > 0.0f || sign_w > 0.0f;
    if (some_right && some_left)
        return false;
    if (breaks_ties && (sign_u == 0.0f || sign_v == 0.0f || sign_w == 0.0f))
        return false;
    float area = u + v + w;
    if (area == 0.0f)
        return false;
    meeting->t = (u * a.z + v * b.z + w * c.z) / area;
    meeting->share_b = v / area;
    meeting->share_c = w / area;
    meeting->entering = (area > 0.0f) == (ray->shear[2] < 0.0f);
    return true;
}

static bool woop_plain(const HdFloatRay *ray, const HdFloatTriangle *triangle, HdMeeting *meeting) {
    return woop(ray, triangle, false, meeting);
}

static bool woop_untied(const HdFloatRay *ray, const HdFloatTriangle *triangle,
                        HdMeeting *meeting) {
    return woop(ray, triangle, true, meeting);
}

#ifndef HD_CONTRACTED

/* ---- the others ---- */

/* T. Moeller, B. Trumbore 1997, Fast, Minimum Storage Ray/Triangle Intersection; both sides. */
static bool moeller_trumbore(const HdFloatRay *ray, const HdFloatTriangle *triangle, float epsilon,
                             HdMeeting *meeting) {
    HdFloat3 e1 = sub(triangle->b, triangle->a), e2 = sub(triangle->c, triangle->a);
    HdFloat3 p = cross(ray->direction, e2);
    float determinant = dot(e1, p);
    if (epsilon > 0.0f ? fabsf(determinant) < epsilon : determinant == 0.0f)
        return false;
    float inverse = 1.0f / determinant;
    HdFloat3 s = sub(ray->origin, triangle->a);
    float u = dot(s, p) * inverse;
    if (!(u >= 0.0f && u <= 1.0f))
        return false;
    HdFloat3 q = cross(s, e1);
    float v = dot(ray->direction, q) * inverse;
    if (!(v >= 0.0f && u + v <= 1.0f))
        return false;
    meeting->t = dot(e2, q) * inverse;
    meeting->share_b = u;
    meeting->share_c = v;
    meeting->entering = determinant > 0.0f;
    return true;
}

static bool moeller_trumbore_epsilon(const HdFloatRay *ray, const HdFloatTriangle *triangle,
                                     HdMeeting *meeting) {
    return moeller_trumbore(ray, triangle, 1e-6f, meeting);
}

static bool moeller_trumbore_zero(const HdFloatRay *ray, const HdFloatTriangle *triangle,
                                  HdMeeting *meeting) {
    return moeller_trumbore(ray, triangle, 0.0f, meeting);
}

static float apply(const float row[4], HdFloat3 v) {
    return row[0] * v.x + row[1] * v.y + row[2] * v.z;
}

static bool baldwin_weber(const HdFloatRay *ray, const HdFloatTriangle *triangle,
                          HdMeeting *meeting) {
    const float(*rows)[4] = triangle->to_unit;
    float slope = apply(rows[2], ray->direction);
    float t = -(apply(rows[2], ray->origin) + rows[2][3]) / slope;
    HdFloat3 d = ray->direction, o = ray->origin;
    HdFloat3 at = {o.x + t * d.x, o.y + t * d.y, o.z + t * d.z};
    float u = apply(rows[0], at) + rows[0][3], v = apply(rows[1], at) + rows[1][3];
    if (!(u >= 0.0f && v >= 0.0f && u + v <= 1.0f))
        return false;
    meeting->t = t;
    meeting->share_b = u;
    meeting->share_c = v;
    meeting->entering = slope * triangle->normal_sign < 0.0f;
    return true;
}

/* Returns the permuted inner product of the Pluecker coordinates of the ray and of the line from a
   to b. */
static float pluecker_side(const HdFloatRay *ray, HdFloat3 a, HdFloat3 b) {
    return dot(ray->direction, cross(a, b)) + dot(ray->moment, sub(b, a));
}

/* J. Erickson 1997, Pluecker Coordinates. */
static bool pluecker(const HdFloatRay *ray, const HdFloatTriangle *triangle, HdMeeting *meeting) {
    HdFloat3 a = triangle->a, b = triangle->b, c = triangle->c;
    float u = pluecker_side(ray, b, c), v = pluecker_side(ray, c, a), w = pluecker_side(ray, a, b);
    bool all_left = u >= 0.0f && v >= 0.0f && w >= 0.0f;
    bool all_right = u <= 0.0f && v <= 0.0f && w <= 0.0f;
    float sum = u + v + w;
    if (!(all_left || all_right) || sum == 0.0f)
        return false;
    HdFloat3 n = cross(sub(b, a), sub(c, a));
    meeting->t = dot(n, sub(a, ray->origin)) / dot(n, ray->direction);
    meeting->share_b = v / sum;
    meeting->share_c = w / sum;
    meeting->entering = dot(n, ray->direction) < 0.0f;
    return true;
}

static const HdTriangleTest tests[] = {
    {"moeller_trumbore_1e-6", moeller_trumbore_epsilon},
    {"moeller_trumbore_0", moeller_trumbore_zero},
    {"baldwin_weber", baldwin_weber},
    {"pluecker", pluecker},
    {"watertight", woop_plain},
    {"watertight_tie", woop_untied},
};

#else

static const HdTriangleTest tests[] = {
    {"watertight_contracted", woop_plain},
    {"watertight_tie_contracted", woop_untied},
};

#endif

const HdTriangleTests HD_TESTS = {
    .prepare_ray = prepare_ray,
    .prepare_triangle = prepare_triangle,
    .count = sizeof tests / sizeof *tests,
    .tests = tests,
};
