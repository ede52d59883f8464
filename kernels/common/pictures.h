/* SPDX-License-Identifier: MIT */
/* Lookup in pictures, and where a point of a triangle lies in its picture. */
#ifndef HD_PICTURES_H
#define HD_PICTURES_H

#include "triangle.h"

FN vreal clamp_unit(vreal a) {
    return vmin(vmax(a, splat(R(0.0))), splat(R(1.0)));
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

/* Returns texel `index` of each lane, blended with the next one; values 0..65535. */
FN Vec3 blend_row(GLOBAL const uint *texels, vint index, vreal weight) {
    FourWords words = fetch_four_words(texels, index + index);
    return vec3(blend(low_half(words.word[0]), low_half(words.word[2]), weight),
                blend(high_half(words.word[0]), high_half(words.word[2]), weight),
                blend(low_half(words.word[1]), low_half(words.word[3]), weight));
}

/* Blends four texels: two from `place` on and two `stride` texels later. One place serves both
   rows, so that its lanes are extracted once. */
FN Vec3 blend_texels(GLOBAL const uint *texels, vint place, int stride, vreal across, vreal down) {
    Vec3 above = blend_row(texels, place, across);
    Vec3 below = blend_row(texels + 2 * stride, place, across);
    vreal scale = splat(R(1.5259021896696422e-5)); /* 1 / 65535 */
    return vec3(blend(above.x, below.x, down) * scale, blend(above.y, below.y, down) * scale,
                blend(above.z, below.z, down) * scale);
}

/* Returns a coordinate of a repeating texture, in texels from the centre of the first one. */
FN vreal repeat(vreal u, int texels) {
    vreal part = u - to_real(to_int(u)), zero = splat(R(0.0)), whole = splat((real)texels);
    part = vselect(lt(part, zero), part + splat(R(1.0)), part);
    vreal at = multiply_add(part, whole, splat(R(-0.5)));
    at = vselect(lt(at, zero), at + whole, at);
    /* Dead lanes may hold any value. */
    return vmin(vmax(at, zero), whole);
}

/* Returns the same for a clamped texture. */
FN vreal stay_within(vreal u, int texels) {
    vreal at = multiply_add(clamp_unit(u), splat((real)texels), splat(R(-0.5)));
    return vmin(vmax(at, splat(R(0.0))), splat((real)(texels - 1)));
}

/* Returns the bilinear blend of texel centres about column x and row y, within the picture. One
   more column and row follow its last ones: its first ones if it repeats, any values if it does
   not. */
FN Vec3 sample_at(GLOBAL const Picture *picture, GLOBAL const uint *texels, vreal x, vreal y) {
    /* Rounding may have put a coordinate at the end, after the last texel. */
    vint column = min_int(to_int(x), splat_int(picture->width - 1));
    vint row = min_int(to_int(y), splat_int(picture->height - 1));
    int stride = picture->width + 1;
    vint place = row * stride + column + picture->first_texel;
    return blend_texels(texels, place, stride, x - to_real(column), y - to_real(row));
}

/* Returns the value at texture coordinates. */
FN Vec3 sample_picture(GLOBAL const Picture *picture, GLOBAL const uint *texels, vreal u, vreal v) {
    vmask clamped = lt_int(splat_int(0), splat_int(picture->is_clamped));
    vreal x = splat(R(0.0)), y = x;
    if (must_visit(~clamped)) {
        x = repeat(u, picture->width);
        y = repeat(v, picture->height);
    }
    if (must_visit(clamped)) {
        x = vselect(clamped, stay_within(u, picture->width), x);
        y = vselect(clamped, stay_within(v, picture->height), y);
    }
    return sample_at(picture, texels, x, y);
}

/* Returns the three words of each lane's triangle in a table. */
FN FourWords fetch_corner_words(GLOBAL const int *table, int first, vint triangle) {
    return fetch_four_words((GLOBAL const uint *)table, triangle * 3 + first);
}

/* Returns the lanes whose triangle has texture coordinates, and those of the point with these
   shares. Lanes of other instances must hold a triangle of this one; without any coordinates, its
   first one. */
FN vmask coordinates_in_picture(SCENE_PARAMETERS GLOBAL const Instance *instance, vint triangle,
                                const vreal share[3], vreal *u, vreal *v) {
    enum { UV_STRIDE = sizeof(TextureCoordinates) / sizeof(real) };
    int first = instance->first_corner_uvs < 0 ? 0 : instance->first_corner_uvs;
    FourWords corner = fetch_corner_words(corner_uvs, first, triangle - instance->first_triangle);
    vmask has = ~lt_int(corner.word[0], splat_int(0));
    GLOBAL const real *table = (GLOBAL const real *)mesh_uvs;
    *u = *v = splat(R(0.0));
    for (int i = 0; i < 3; i++) {
        vint place = vselect_int(has, corner.word[i], splat_int(0)) * UV_STRIDE;
        FourReals at = fetch_four_reals(table, place);
        *u = multiply_add(at.number[0], share[i], *u);
        *v = multiply_add(at.number[1], share[i], *v);
    }
    return has;
}

#endif
