/* SPDX-License-Identifier: MIT */
/* Equilateral triangles at random places and in random directions, for measurements: a hierarchy
   cannot profit from similar neighbours. */
#include "model.h"

#include <math.h>

#include "random.h"

/* Size of the circle about each triangle, times the cube root of their number. */
static const double size = 0.7;

static const double root_of_3 = 1.7320508075688772;

/* Fills a point in the ball of radius 1, not too close to its centre. */
static void random_point(uint64_t *state, double point[3]) {
    double square;
    do {
        square = 0;
        for (int axis = 0; axis < 3; axis++) {
            point[axis] = random_between(state, -1, 1);
            square += point[axis] * point[axis];
        }
    } while (square > 1 || square < 0.01);
}

static void normalise(double vector[3]) {
    double length = sqrt(vector[0] * vector[0] + vector[1] * vector[1] + vector[2] * vector[2]);
    for (int axis = 0; axis < 3; axis++)
        vector[axis] /= length;
}

/* Fills two directions at a right angle. */
static void random_plane(uint64_t *state, double u[3], double v[3]) {
    double other[3];
    random_point(state, u);
    normalise(u);
    do {
        random_point(state, other);
        v[0] = u[1] * other[2] - u[2] * other[1];
        v[1] = u[2] * other[0] - u[0] * other[2];
        v[2] = u[0] * other[1] - u[1] * other[0];
    } while (v[0] * v[0] + v[1] * v[1] + v[2] * v[2] < 0.0001);
    normalise(v);
}

/* Newton's method: the same bytes everywhere, unlike cbrt. */
static double cube_root(double value) {
    double root = value;
    for (int i = 0; i < 60; i++)
        root -= (root - value / (root * root)) / 3;
    return root;
}

static int count_triangles(int wanted) {
    return wanted;
}

static void write(HdObjWriter *writer, int wanted) {
    uint64_t state = 0;
    double radius = size / cube_root(wanted);
    for (int i = 0; i < wanted; i++) {
        double centre[3], u[3], v[3], corners[3][3];
        random_point(&state, centre);
        random_plane(&state, u, v);
        for (int axis = 0; axis < 3; axis++) {
            double along = radius / 2 * u[axis], across = radius / 2 * root_of_3 * v[axis];
            corners[0][axis] = centre[axis] + radius * u[axis];
            corners[1][axis] = centre[axis] - along + across;
            corners[2][axis] = centre[axis] - along - across;
        }
        for (int corner = 0; corner < 3; corner++)
            hd_obj_vertex(writer, corners[corner]);
    }
    for (int i = 0; i < wanted; i++)
        hd_obj_triangle(writer, 3 * i, 3 * i + 1, 3 * i + 2);
}

const HdModel hd_model_soup = {
    .name = "soup",
    .summary = "single triangles at random, not closed",
    .triangles = count_triangles,
    .write = write,
};
