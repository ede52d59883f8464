/* SPDX-License-Identifier: MIT */
/* The plain C kernels with the test of Moeller and Trumbore (1997, Fast, Minimum Storage
   Ray/Triangle Intersection) in place of their own: the hunt must find its leaks. */
#define cross_triangle exact_cross_triangle
#include "cpu/dialect.h"
#include "kernels/common/triangle.h"
#undef cross_triangle

/* The same contract as in kernels/common/triangle.h. */
FN vmask cross_triangle(const RayFrame *frame, const Slabs *slabs, vmask m, Vec3 a, Vec3 b, Vec3 c,
                        TriangleCrossing *crossing) {
    vreal zero = splat(R(0.0)), one = splat(R(1.0));
    Vec3 direction = vec3_scale(vec3(-frame->across, -frame->upward, one), one / frame->forward);
    Vec3 to_b = vec3_sub(b, a), to_c = vec3_sub(c, a), from_a = vec3_sub(frame->origin, a);
    Vec3 p = vec3_cross(direction, to_c), q = vec3_cross(from_a, to_b);
    vreal determinant = vec3_dot(to_b, p), inverse = one / determinant;
    crossing->share[1] = vec3_dot(from_a, p) * inverse;
    crossing->share[2] = vec3_dot(direction, q) * inverse;
    crossing->share[0] = one - crossing->share[1] - crossing->share[2];
    crossing->t = vec3_dot(to_c, q) * inverse;
    crossing->entering = lt(zero, determinant);
    vmask crosses = m & le(zero, crossing->share[1]) & le(zero, crossing->share[2]) &
                    le(crossing->share[1] + crossing->share[2], one);
    return crosses & keep_in_box(slabs, a, b, c, &crossing->t);
}

#include "cpu/kernel.c"
