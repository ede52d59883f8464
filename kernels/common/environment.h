/* SPDX-License-Identifier: MIT */
/* What rays see that hit nothing: a picture all around, with equal steps of angle. */
#ifndef HD_ENVIRONMENT_H
#define HD_ENVIRONMENT_H

#include "pictures.h"

/* Returns the angle of (x, y) from the x axis in turns, -1/2..1/2; 0 for (0, 0). The polynomial is
   the minimax one of atan(t) / (2 pi) on 0..1, within 6.0e-9. */
FN vreal turns_of(vreal y, vreal x) {
    vreal zero = splat(R(0.0)), wide = absolute(x), high = absolute(y);
    vreal longer = vmax(wide, high);
    longer = vselect(lt(zero, longer), longer, splat(R(1.0)));
    vreal t = quotient(vmin(wide, high), longer), square = t * t;
    vreal sum = splat(R(-0.00064530560969650791));
    sum = multiply_add(square, sum, splat(R(0.0034796021190063991)));
    sum = multiply_add(square, sum, splat(R(-0.008898729372921892)));
    sum = multiply_add(square, sum, splat(R(0.015346038212618621)));
    sum = multiply_add(square, sum, splat(R(-0.022136273243862174)));
    sum = multiply_add(square, sum, splat(R(0.031745945581399636)));
    sum = multiply_add(square, sum, splat(R(-0.053046120997848245)));
    sum = multiply_add(square, sum, splat(R(0.15915483734677521)));
    vreal turns = t * sum;
    turns = vselect(lt(wide, high), splat(R(0.25)) - turns, turns);
    turns = vselect(lt(x, zero), splat(R(0.5)) - turns, turns);
    return vselect(lt(y, zero), -turns, turns);
}

/* Returns the radiance that the environment adds in a direction of any length. */
FN Vec3 environment_at(SCENE_PARAMETERS Vec3 direction) {
    GLOBAL const Picture *picture = pictures + header->environment_picture;
    vreal flat = square_root(multiply_add(direction.x, direction.x, direction.y * direction.y));
    vreal across = splat(header->environment_start) - turns_of(direction.y, direction.x);
    vreal down = turns_of(flat, direction.z);
    Vec3 texel = sample_at(picture, texels, repeat(across, picture->width),
                           stay_within(down + down, picture->height));
    return vec3_scale(texel, splat(header->environment_factor));
}

#endif
