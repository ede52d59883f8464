/* SPDX-License-Identifier: MIT */
/* The floor's texture: inverse bilinear coordinates and a bilinear lookup. */
#ifndef HD_TEXTURE_H
#define HD_TEXTURE_H

#include "scene_arguments.h"
#include "vectors.h"

FN vreal clamp_unit(vreal a) {
    return lesser(greater(a, splat(R(0.0))), splat(R(1.0)));
}

/* Texture coordinates in the unit square of a point of the floor. With h = (a, b) - origin, t
   solves k2 t^2 + k1 t + k0 = 0, and the root inside a convex quadrilateral is the one at which the
   map's determinant, k1 + 2 k2 t, has the sign of the orientation. Of the two ways to write a root
   the one that adds numbers of equal sign is taken, which also covers k2 = 0. */
FN void floor_coordinates(GLOBAL const FloorMap *map, Vec3 point, vreal *s, vreal *t) {
    Vec3 axis_a = vec3_splat(map->axis_a[0], map->axis_a[1], map->axis_a[2]);
    Vec3 axis_b = vec3_splat(map->axis_b[0], map->axis_b[1], map->axis_b[2]);
    vreal ha = vec3_dot(axis_a, point) - splat(map->origin[0]);
    vreal hb = vec3_dot(axis_b, point) - splat(map->origin[1]);
    vreal ea = splat(map->e[0]), eb = splat(map->e[1]);
    vreal fa = splat(map->f[0]), fb = splat(map->f[1]);
    vreal ga = splat(map->g[0]), gb = splat(map->g[1]);
    vreal k2 = multiply_add(ga, fb, -(gb * fa));
    vreal k1 = multiply_add(ea, fb, -(eb * fa)) + multiply_add(ha, gb, -(hb * ga));
    vreal k0 = multiply_add(ha, eb, -(hb * ea));
    vreal discriminant = greater(multiply_add(k1, k1, k2 * k0 * R(-4.0)), splat(R(0.0)));
    vreal root = square_root(discriminant) * map->orientation;
    vmask same_sign = le(splat(R(0.0)), k1 * root);
    *t = clamp_unit(pick(same_sign, (k0 * R(-2.0)) / (k1 + root), (root - k1) / (k2 * R(2.0))));
    vreal da = multiply_add(*t, ga, ea), db = multiply_add(*t, gb, eb);
    vreal na = multiply_add(-*t, fa, ha), nb = multiply_add(-*t, fb, hb);
    vmask use_a = lt(db * db, da * da);
    *s = clamp_unit(pick(use_a, na, nb) / pick(use_a, da, db));
}

typedef struct {
    vreal r, g, b;
} Texel;

/* The texel in column x and row y for each lane; values 0..65535. */
FN Texel fetch_texel(GLOBAL const uint *texels, int width, vint x, vint y) {
    Texel texel;
    texel.r = texel.g = texel.b = splat(R(0.0));
    for (int lane = 0; lane < HD_LANES; lane++) {
        GLOBAL const uint *words =
            texels + 2 * ((uint64)lane_int(&y, lane) * (uint64)width + (uint64)lane_int(&x, lane));
        set_lane_real(&texel.r, lane, (real)(words[0] & 0xffffu));
        set_lane_real(&texel.g, lane, (real)(words[0] >> 16));
        set_lane_real(&texel.b, lane, (real)words[1]);
    }
    return texel;
}

FN vreal blend(vreal a, vreal b, vreal weight) {
    return multiply_add(weight, b - a, a);
}

/* Bilinear between texel centres, the border's texels continued outwards. */
FN Vec3 sample_texture(GLOBAL const FloorMap *map, GLOBAL const uint *texels, vreal s, vreal t) {
    int width = map->texture_width, height = map->texture_height;
    vreal zero = splat(R(0.0));
    vreal x = multiply_add(s, splat((real)width), splat(R(-0.5)));
    vreal y = multiply_add(t, splat((real)height), splat(R(-0.5)));
    x = lesser(greater(x, zero), splat((real)(width - 1)));
    y = lesser(greater(y, zero), splat((real)(height - 1)));
    vint x0 = to_int(x), y0 = to_int(y);
    vreal wx = x - to_real(x0), wy = y - to_real(y0);
    /* At the last column the weight is 0: any second texel will do. */
    vint x1 = pick_int(lt(to_real(x0), splat((real)(width - 1))), x0 + 1, x0);
    vint y1 = pick_int(lt(to_real(y0), splat((real)(height - 1))), y0 + 1, y0);
    Texel a = fetch_texel(texels, width, x0, y0), b = fetch_texel(texels, width, x1, y0);
    Texel c = fetch_texel(texels, width, x0, y1), d = fetch_texel(texels, width, x1, y1);
    vreal scale = splat(R(1.0) / R(65535.0));
    return vec3(blend(blend(a.r, b.r, wx), blend(c.r, d.r, wx), wy) * scale,
                blend(blend(a.g, b.g, wx), blend(c.g, d.g, wx), wy) * scale,
                blend(blend(a.b, b.b, wx), blend(c.b, d.b, wx), wy) * scale);
}

#endif
