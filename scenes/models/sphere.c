/* SPDX-License-Identifier: MIT */
/* A sphere with bumps, for measurements: the six sides of a cube, cut into n x n cells each and
   projected, so that triangles have about the same size everywhere. */
#include "model.h"

#include <math.h>

#include "base/trigonometry.h"

/* Bumps about the directions in which all three waves are high or low. */
static const double bump_height = 0.08, bump_frequency = 8;

static int count_cells(int wanted) {
    int n = (int)lround(sqrt(wanted / 12.0));
    return n < 1 ? 1 : n;
}

static int count_triangles(int wanted) {
    int n = count_cells(wanted);
    return 12 * n * n;
}

/* Returns a coordinate on the cube -1..1. Equal angles, not equal lengths, make cells of about the
   same size. */
static double cube_coordinate(int index, int n) {
    double sine, cosine;
    if (index == 0 || index == n)
        return index == 0 ? -1 : 1;
    hd_sine_cosine((2.0 * index / n - 1) * HD_PI / 4, &sine, &cosine);
    return sine / cosine;
}

static void write_vertex(HdObjWriter *writer, double x, double y, double z) {
    double point[3] = {x, y, z}, wave = 1;
    double length = sqrt(x * x + y * y + z * z);
    for (int axis = 0; axis < 3; axis++) {
        double sine, cosine;
        point[axis] /= length;
        hd_sine_cosine(bump_frequency * point[axis] + axis, &sine, &cosine);
        wave *= sine;
    }
    for (int axis = 0; axis < 3; axis++)
        point[axis] *= 1 + bump_height * wave;
    hd_obj_vertex(writer, point);
}

/* Vertices are ordered by layer, then by row. Between the lowest and the highest layer, of each row
   but the first and the last, only both ends are on the surface. */
static void write_vertices(HdObjWriter *writer, int n) {
    for (int k = 0; k <= n; k++) {
        double z = cube_coordinate(k, n);
        for (int j = 0; j <= n; j++) {
            double y = cube_coordinate(j, n);
            int step = k == 0 || k == n || j == 0 || j == n ? 1 : n;
            for (int i = 0; i <= n; i += step)
                write_vertex(writer, cube_coordinate(i, n), y, z);
        }
    }
}

/* Returns the number of a vertex by its place on the cube. */
static int vertex_number(const int place[3], int n) {
    int i = place[0], j = place[1], k = place[2], side = n + 1;
    if (k == 0)
        return j * side + i;
    int before = side * side + (k - 1) * 4 * n;
    if (k == n || j == 0)
        return before + j * side + i;
    if (j == n)
        return before + side + 2 * (n - 1) + i;
    return before + side + 2 * (j - 1) + (i == n);
}

/* Writes a side of the cube; the two axes of its cells turn counterclockwise as seen from
   outside. */
static void write_side(HdObjWriter *writer, int n, int across, int up, int fixed, int level) {
    for (int j = 0; j < n; j++) {
        for (int i = 0; i < n; i++) {
            int corners[4];
            for (int corner = 0; corner < 4; corner++) {
                int place[3];
                place[fixed] = level;
                place[across] = i + (corner == 1 || corner == 2);
                place[up] = j + (corner >= 2);
                corners[corner] = vertex_number(place, n);
            }
            hd_obj_quad(writer, corners[0], corners[1], corners[2], corners[3]);
        }
    }
}

static void write(HdObjWriter *writer, int wanted) {
    int n = count_cells(wanted);
    write_vertices(writer, n);
    for (int axis = 0; axis < 3; axis++) {
        int next = (axis + 1) % 3, last = (axis + 2) % 3;
        write_side(writer, n, last, next, axis, 0);
        write_side(writer, n, next, last, axis, n);
    }
}

const HdModel hd_model_sphere = {
    .name = "sphere",
    .summary = "a sphere with bumps, its triangles of about the same size",
    .triangles = count_triangles,
    .write = write,
};
