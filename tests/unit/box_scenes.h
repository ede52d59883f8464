/* SPDX-License-Identifier: MIT */
/* Boxes and rays for the tests of hierarchies. */
#ifndef HD_BOX_SCENES_H
#define HD_BOX_SCENES_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>

#include "mesh/hierarchy.h"

/* The next of a fixed row of numbers, from 0 to below 1. */
static inline double next_number(uint64_t *state) {
    *state = *state * 6364136223846793005U + 1442695040888963407U;
    return (double)(*state >> 40) * 0x1p-24;
}

/* Boxes with corners within `size` of a place in the cube of +-1, everything times `scale`. */
static inline HdBox *random_boxes(int count, double size, double scale, uint64_t seed) {
    HdBox *boxes = malloc((size_t)count * sizeof *boxes);
    for (int i = 0; i < count; i++)
        for (int axis = 0; axis < 3; axis++) {
            const double at = 2.0 * next_number(&seed) - 1.0;
            const double extent = size * next_number(&seed);
            boxes[i].lower[axis] = (float)(scale * at);
            boxes[i].upper[axis] = (float)(scale * (at + extent));
        }
    return boxes;
}

/* Small boxes in few dense places of very different sizes. */
static inline HdBox *clustered_boxes(int count) {
    enum { CLUSTERS = 7 };
    HdBox *boxes = malloc((size_t)count * sizeof *boxes);
    uint64_t seed = 77;
    for (int i = 0; i < count; i++) {
        const int cluster = i % CLUSTERS;
        const double spread = pow(0.2, cluster);
        for (int axis = 0; axis < 3; axis++) {
            uint64_t of_cluster = (uint64_t)(cluster * 3 + axis + 1) * 0x9E3779B97F4A7C15U;
            const double centre = 2.0 * next_number(&of_cluster) - 1.0;
            const double at = centre + spread * (next_number(&seed) - 0.5);
            boxes[i].lower[axis] = (float)at;
            boxes[i].upper[axis] = (float)(at + 0.05 * spread * next_number(&seed));
        }
    }
    return boxes;
}

enum { DEEP_BOXES = 17 * 6 };

/* Points on the axes, each 64 times nearer to the origin than the last: the outermost point is in a
   bin of its own and all others share one, so that each split takes one point away. */
static inline void fill_deep(HdBox boxes[DEEP_BOXES]) {
    for (int i = 0; i < DEEP_BOXES; i++) {
        const int axis = i % 6 / 2;
        const float place = ldexpf(i % 2 == 0 ? 1.0F : -1.0F, -6 * (i / 6));
        boxes[i] = (HdBox){{0}, {0}};
        boxes[i].lower[axis] = boxes[i].upper[axis] = place;
    }
}

typedef struct TestRay {
    double origin[3], direction[3];
} TestRay;

/* Through a point in the cube of +-`scale`; one of four runs along an axis. */
static inline TestRay random_ray(double scale, uint64_t *seed) {
    TestRay ray;
    for (int axis = 0; axis < 3; axis++) {
        ray.origin[axis] = scale * (2.0 * next_number(seed) - 1.0);
        ray.direction[axis] = 2.0 * next_number(seed) - 1.0;
    }
    const int axis = (int)(12.0 * next_number(seed));
    if (axis < 3)
        ray.direction[axis] = ray.direction[(axis + 1) % 3] = 0.0;
    return ray;
}

/* Rounding keeps the order of numbers, so what is in a box is never met where the box is not. */
static inline bool ray_meets(const TestRay *ray, const float lower[3], const float upper[3]) {
    double from = -HUGE_VAL, to = HUGE_VAL;
    for (int axis = 0; axis < 3; axis++) {
        const double origin = ray->origin[axis], direction = ray->direction[axis];
        if (direction == 0.0) {
            if (origin < (double)lower[axis] || origin > (double)upper[axis])
                return false;
            continue;
        }
        const double a = ((double)lower[axis] - origin) / direction;
        const double b = ((double)upper[axis] - origin) / direction;
        from = fmax(from, fmin(a, b));
        to = fmin(to, fmax(a, b));
    }
    return from <= to;
}

#endif
