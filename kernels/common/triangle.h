/* SPDX-License-Identifier: MIT */
/* Ray/triangle crossings without gaps or duplicates. Of the triangles that share an edge or a
   corner, a ray through it crosses one, or one on its way in and one on its way out. Lanes are rays
   against one triangle, or triangles against one ray.

   A shear puts the ray on an axis through the origin (Woop, Benthin and Wald 2013, Watertight
   Ray/Triangle Intersection). It treats a corner alike in all of its triangles. The signs of the
   edge functions are exact: a fused multiplication gives the error of a product. If one is zero,
   the ray moves by an infinitely small step (Edelsbrunner and Muecke 1990, Simulation of
   Simplicity). */
#ifndef HD_TRIANGLE_H
#define HD_TRIANGLE_H

#include "kernel_arguments.h"
#include "vectors.h"

/* The dominant axis of each ray's direction: x, y or, if neither, z. */
typedef struct {
    vmask x, y;
} DominantAxis;

FN DominantAxis dominant_axis(Vec3 direction) {
    vreal x = absolute(direction.x), y = absolute(direction.y), z = absolute(direction.z);
    DominantAxis last;
    last.x = le(y, x) & le(z, x);
    last.y = ~last.x & le(z, y);
    return last;
}

/* Permutes coordinates so that each ray's dominant axis comes last and they stay right-handed. All
   functions below use such coordinates. */
FN Vec3 turn(DominantAxis last, Vec3 p) {
    return vec3(vselect(last.x, p.y, vselect(last.y, p.z, p.x)),
                vselect(last.x, p.z, vselect(last.y, p.x, p.y)),
                vselect(last.x, p.x, vselect(last.y, p.y, p.z)));
}

/* The shear to a ray's own coordinates. From (x, y, z) = p - origin a point p has x + across z, y +
   upward z and, in units of the ray's direction, forward z. */
typedef struct {
    Vec3 origin;
    vreal across, upward, forward;
    vmask backward; /* runs against its dominant axis */
} RayFrame;

FN RayFrame ray_frame(Vec3 origin, Vec3 direction) {
    RayFrame frame;
    frame.origin = origin;
    frame.forward = times_sign_of(reciprocal(absolute(direction.z)), direction.z);
    frame.across = -direction.x * frame.forward;
    frame.upward = -direction.y * frame.forward;
    frame.backward = lt(direction.z, splat(R(0.0)));
    return frame;
}

/* Ray data for axis-parallel boxes: a ray meets a bound b of an axis at t = b * inverse + near (or
   far). `near` is early and `far` late by the bound of rounding here and in a triangle's test
   (after Ize 2013, Robust BVH Ray Traversal). */
typedef struct {
    Vec3 inverse, near, far;
    vmask negative[3]; /* runs towards the lower bound of an axis */
} Slabs;

/* The bound of rounding, relative to the coordinates or, in shares, products and sums of two
   distances, to the furthest corner. The minimum share of a direction along an axis is far below
   that; it avoids division by zero. */
#if HD_DOUBLE
#define ROUNDING_MARGIN R(3.5527136788005009e-15) /* 2^-48 */
#define MIN_SHARE       R(1e-30)
#else
#define ROUNDING_MARGIN R(1.9073486328125e-6) /* 2^-19 */
#define MIN_SHARE       R(1e-12)
#endif

FN vreal slab_inverse(vreal direction, vreal least) {
    return times_sign_of(reciprocal(vmax(absolute(direction), least)), direction);
}

/* Returns the slab data for boxes whose coordinates are at most `reach`. */
FN Slabs ray_slabs(Vec3 origin, Vec3 direction, vreal reach) {
    vreal far_out = vmax(absolute(origin.x), vmax(absolute(origin.y), absolute(origin.z)));
    vreal longest = vmax(absolute(direction.x), vmax(absolute(direction.y), absolute(direction.z)));
    vreal least = longest * MIN_SHARE, zero = splat(R(0.0));
    vreal margin = (far_out + reach) * ROUNDING_MARGIN;
    Slabs slabs;
    slabs.inverse = vec3(slab_inverse(direction.x, least), slab_inverse(direction.y, least),
                         slab_inverse(direction.z, least));
    Vec3 start = vec3_mul(origin, slabs.inverse);
    Vec3 slack = vec3_scale(
        vec3(absolute(slabs.inverse.x), absolute(slabs.inverse.y), absolute(slabs.inverse.z)),
        margin);
    slabs.near = vec3_scale(vec3_add(start, slack), splat(R(-1.0)));
    slabs.far = vec3_sub(slack, start);
    slabs.negative[0] = lt(slabs.inverse.x, zero);
    slabs.negative[1] = lt(slabs.inverse.y, zero);
    slabs.negative[2] = lt(slabs.inverse.z, zero);
    return slabs;
}

FN Vec3 vec3_min(Vec3 a, Vec3 b) {
    return vec3(vmin(a.x, b.x), vmin(a.y, b.y), vmin(a.z, b.z));
}
FN Vec3 vec3_max(Vec3 a, Vec3 b) {
    return vec3(vmax(a.x, b.x), vmax(a.y, b.y), vmax(a.z, b.z));
}

/* The first two of a corner's coordinates in the ray's frame. */
typedef struct {
    vreal across, upward;
} Corner;

FN Corner project_corner(const RayFrame *frame, Vec3 p) {
    Corner corner;
    corner.across = multiply_add(frame->across, p.z, p.x);
    corner.upward = multiply_add(frame->upward, p.z, p.y);
    return corner;
}

/* Finds the side of the line from a to b on which the ray passes; neither if a and b coincide. Only
   lanes of `m` need be correct. */
FN void test_edge(Corner a, Corner b, vmask m, vmask *left, vmask *right) {
    vreal p = a.across * b.upward, q = a.upward * b.across;
    *left = lt(q, p);
    *right = lt(p, q);
    vmask tied = m & ~(*left | *right);
    if (any_lane(tied)) {
        vreal p_rest = multiply_add(a.across, b.upward, -p);
        vreal q_rest = multiply_add(a.upward, b.across, -q);
        vmask exact_left = lt(q_rest, p_rest), exact_right = lt(p_rest, q_rest);
        vmask moved_left = lt(b.upward, a.upward), moved_right = lt(a.upward, b.upward);
        vmask level = ~(moved_left | moved_right);
        moved_left = moved_left | (level & lt(a.across, b.across));
        moved_right = moved_right | (level & lt(b.across, a.across));
        vmask through = ~(exact_left | exact_right);
        *left = *left | (tied & (exact_left | (through & moved_left)));
        *right = *right | (tied & (exact_right | (through & moved_right)));
    }
}

/* Returns twice the area of a, b and the ray, positive on the left. Its relative error is a few
   units of rounding at any angle, so that triangles that share an edge agree where a ray near it
   crosses. */
FN vreal double_area(Corner a, Corner b) {
    vreal p = a.across * b.upward, q = a.upward * b.across;
    vreal p_rest = multiply_add(a.across, b.upward, -p);
    vreal q_rest = multiply_add(a.upward, b.across, -q);
    return (p - q) + (p_rest - q_rest);
}

/* A ray's crossing of a triangle. */
typedef struct {
    vreal t;
    vreal slack;    /* two crossings at an edge may coincide if they differ by less than this */
    vreal share[3]; /* barycentric coordinates of the point */
    vmask entering;
} TriangleCrossing;

/* Clamps `t` to the triangle's bounding box; returns the lanes that meet this box. The boxes of a
   hierarchy contain it, so every order of search finds the same hit. */
FN vmask keep_in_box(const Slabs *slabs, Vec3 a, Vec3 b, Vec3 c, vreal *t) {
    Vec3 lower = vec3_min(a, vec3_min(b, c)), upper = vec3_max(a, vec3_max(b, c));
    const vmask *negative = slabs->negative;
    Vec3 first =
        vec3(vselect(negative[0], upper.x, lower.x), vselect(negative[1], upper.y, lower.y),
             vselect(negative[2], upper.z, lower.z));
    Vec3 last = vec3(vselect(negative[0], lower.x, upper.x), vselect(negative[1], lower.y, upper.y),
                     vselect(negative[2], lower.z, upper.z));
    first = vec3_mul_add(first, slabs->inverse, slabs->near);
    last = vec3_mul_add(last, slabs->inverse, slabs->far);
    vreal near = vmax(first.x, vmax(first.y, first.z));
    vreal far = vmin(last.x, vmin(last.y, last.z));
    *t = vmin(vmax(*t, near), far);
    return le(near, far);
}

/* Returns the lanes of `m` whose lines cross the triangle a, b, c. */
FN vmask cross_triangle(const RayFrame *frame, const Slabs *slabs, vmask m, Vec3 a, Vec3 b, Vec3 c,
                        TriangleCrossing *crossing) {
    Vec3 from_a = vec3_sub(a, frame->origin), from_b = vec3_sub(b, frame->origin);
    Vec3 from_c = vec3_sub(c, frame->origin);
    crossing->t = crossing->slack = splat(R(0.0));
    crossing->share[0] = crossing->share[1] = crossing->share[2] = splat(R(0.0));
    crossing->entering = mask_none();
    Corner at_a = project_corner(frame, from_a), at_b = project_corner(frame, from_b);
    Corner at_c = project_corner(frame, from_c);
    vmask left_a, right_a, left_b, right_b, left_c, right_c;
    test_edge(at_b, at_c, m, &left_a, &right_a);
    test_edge(at_c, at_a, m, &left_b, &right_b);
    vmask left = m & left_a & left_b, right = m & right_a & right_b;
    if (!must_visit(left | right))
        return mask_none();
    test_edge(at_a, at_b, left | right, &left_c, &right_c);
    left = left & left_c;
    right = right & right_c;
    vmask crosses = left | right;
    if (!any_lane(crosses))
        return crosses;
    vreal area_a = double_area(at_b, at_c), area_b = double_area(at_c, at_a);
    vreal area_c = double_area(at_a, at_b), area = area_a + area_b + area_c;
    vmask too_small = ~(lt(area, splat(R(0.0))) |
                        lt(splat(R(0.0)), area)); /* the first corner replaces the point */
    area_a = vselect(too_small, splat(R(1.0)), area_a);
    area = vselect(too_small, splat(R(1.0)), area);
    vreal inverse = times_sign_of(reciprocal(absolute(area)), area);
    crossing->share[0] = area_a * inverse;
    crossing->share[1] = area_b * inverse;
    crossing->share[2] = area_c * inverse;
    const vreal *share = crossing->share;
    vreal depth =
        multiply_add(share[0], from_a.z, multiply_add(share[1], from_b.z, share[2] * from_c.z));
    /* Rays against the axis hit a counterclockwise triangle from outside. */
    crossing->entering = (left & frame->backward) | (right & ~frame->backward);
    crossing->t = depth * frame->forward;
    vreal furthest = vmax(absolute(from_a.z), vmax(absolute(from_b.z), absolute(from_c.z)));
    crossing->slack = furthest * absolute(frame->forward) * splat(ROUNDING_MARGIN);
    return crosses & keep_in_box(slabs, a, b, c, &crossing->t);
}

/* ---- triangles of a mesh in the lanes of a packet ---- */

/* One triangle for all lanes, or one for each. */
typedef struct {
    Vec3 a, b, c;
    vint number, face, mesh_material;
} TriangleLanes;

/* Reals in a row of the table, and between two corners. */
enum { TRIANGLE_STRIDE = sizeof(Triangle) / sizeof(real), CORNER_STRIDE = TRIANGLE_STRIDE / 3 };

/* Returns the face of a triangle: one number for each group, otherwise a negative one for each
   triangle. */
FN vint face_of_triangle(vint number, vint group, int first_face) {
    vmask grouped = lt_int(splat_int(0), group);
    return vselect_int(grouped, group + (first_face - 1), splat_int(-2) - number);
}

FN void name_triangles(TriangleLanes *lanes, vint number, vint tag, int first_face,
                       int first_mesh_material) {
    vint group = tag & (HD_TRIANGLE_GROUPS - 1);
    lanes->number = number;
    lanes->mesh_material = (tag >> HD_TRIANGLE_GROUP_BITS) + first_mesh_material;
    lanes->face = face_of_triangle(number, group, first_face);
}

/* Returns one triangle in all lanes, its coordinates in the order of `axis`. */
FN TriangleLanes same_triangle(GLOBAL const Triangle *triangles, int number, const int axis[3],
                               int first_face, int first_mesh_material) {
    GLOBAL const Triangle *triangle = triangles + number;
    TriangleLanes lanes;
    lanes.a = vec3_splat(triangle->a[axis[0]], triangle->a[axis[1]], triangle->a[axis[2]]);
    lanes.b = vec3_splat(triangle->b[axis[0]], triangle->b[axis[1]], triangle->b[axis[2]]);
    lanes.c = vec3_splat(triangle->c[axis[0]], triangle->c[axis[1]], triangle->c[axis[2]]);
    name_triangles(&lanes, splat_int(number), splat_int((int)triangle->tag), first_face,
                   first_mesh_material);
    return lanes;
}

FN TriangleLanes fetch_triangles(GLOBAL const Triangle *triangles, vint number, int first_face,
                                 int first_mesh_material) {
    GLOBAL const real *table = (GLOBAL const real *)triangles;
    vint place = number * TRIANGLE_STRIDE;
    FourReals a = fetch_four_reals(table, place);
    FourReals b = fetch_four_reals(table, place + CORNER_STRIDE);
    FourReals c = fetch_four_reals(table, place + 2 * CORNER_STRIDE);
    TriangleLanes lanes;
    lanes.a = vec3(a.number[0], a.number[1], a.number[2]);
    lanes.b = vec3(b.number[0], b.number[1], b.number[2]);
    lanes.c = vec3(c.number[0], c.number[1], c.number[2]);
    name_triangles(&lanes, number, to_int(a.number[3]), first_face, first_mesh_material);
    return lanes;
}

/* Returns the normal, as long as twice the area. */
FN Vec3 normal_of(const TriangleLanes *triangle) {
    return vec3_cross(vec3_sub(triangle->b, triangle->a), vec3_sub(triangle->c, triangle->a));
}

#endif
