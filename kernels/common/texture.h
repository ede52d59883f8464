/* SPDX-License-Identifier: MIT */
/* Textures: the floor's inverse bilinear coordinates, and bilinear lookups. */
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
    Vec3 axis_a = vec3_of(map->axis_a);
    Vec3 axis_b = vec3_of(map->axis_b);
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
    *t = clamp_unit(
        pick(same_sign, quotient(k0 * R(-2.0), k1 + root), quotient(root - k1, k2 * R(2.0))));
    vreal da = multiply_add(*t, ga, ea), db = multiply_add(*t, gb, eb);
    vreal na = multiply_add(-*t, fa, ha), nb = multiply_add(-*t, fb, hb);
    vmask use_a = lt(db * db, da * da);
    *s = clamp_unit(quotient(pick(use_a, na, nb), pick(use_a, da, db)));
}

FN void parallelogram_coordinates(GLOBAL const FloorMap *map, Vec3 point, vreal *s, vreal *t) {
    Vec3 axis_s = vec3_of(map->axis_s);
    Vec3 axis_t = vec3_of(map->axis_t);
    *s = clamp_unit(vec3_dot(axis_s, point) + splat(map->start[0]));
    *t = clamp_unit(vec3_dot(axis_t, point) + splat(map->start[1]));
}

FN vreal blend(vreal a, vreal b, vreal weight) {
    return multiply_add(weight, b - a, a);
}

FN vreal low_half(vint word) {
    return to_real(word & 0xffff);
}

FN vreal high_half(vint word) {
    return to_real(word >> 16 & 0xffff);
}

/* The texel number `index` of each lane, blended with the next one; values 0..65535. */
FN Vec3 blend_row(GLOBAL const uint *texels, vint index, vreal weight) {
    FourWords words = fetch_four_words(texels, index + index);
    return vec3(blend(low_half(words.word[0]), low_half(words.word[2]), weight),
                blend(high_half(words.word[0]), high_half(words.word[2]), weight),
                blend(low_half(words.word[1]), low_half(words.word[3]), weight));
}

/* Between four texels: two from number `place` on, and those `stride` texels behind them. One place
   serves both rows, so that its lanes are taken apart once. */
FN Vec3 blend_texels(GLOBAL const uint *texels, vint place, int stride, vreal across, vreal down) {
    Vec3 above = blend_row(texels, place, across);
    Vec3 below = blend_row(texels + 2 * stride, place, across);
    vreal scale = splat(R(1.5259021896696422e-5)); /* 1 / 65535 */
    return vec3(blend(above.x, below.x, down) * scale, blend(above.y, below.y, down) * scale,
                blend(above.z, below.z, down) * scale);
}

/* A coordinate of a texture that repeats, in texels from the middle of the first one on. */
FN vreal repeat(vreal u, int texels) {
    vreal part = u - to_real(to_int(u)), zero = splat(R(0.0)), whole = splat((real)texels);
    part = pick(lt(part, zero), part + splat(R(1.0)), part);
    vreal at = multiply_add(part, whole, splat(R(-0.5)));
    at = pick(lt(at, zero), at + whole, at);
    /* Lanes that are off may hold anything. */
    return lesser(greater(at, zero), whole);
}

/* The same of a texture that ends. */
FN vreal stay_within(vreal u, int texels) {
    vreal at = multiply_add(clamp_unit(u), splat((real)texels), splat(R(-0.5)));
    return lesser(greater(at, splat(R(0.0))), splat((real)(texels - 1)));
}

/* Bilinear between texel centres. Behind the last column and row of a picture there is room for
   another: its first ones where it repeats, anything where it does not. */
FN Vec3 sample_picture(GLOBAL const Picture *picture, GLOBAL const uint *texels, vreal u, vreal v) {
    vreal x, y;
    if (picture->is_clamped) {
        x = stay_within(u, picture->width);
        y = stay_within(v, picture->height);
    } else {
        x = repeat(u, picture->width);
        y = repeat(v, picture->height);
    }
    /* Rounding may have put a coordinate at the end, where the first texel follows the last one. */
    vint column = least_int(to_int(x), splat_int(picture->width - 1));
    vint row = least_int(to_int(y), splat_int(picture->height - 1));
    int stride = picture->width + 1;
    vint place = row * stride + column + picture->first_texel;
    return blend_texels(texels, place, stride, x - to_real(column), y - to_real(row));
}

#endif
