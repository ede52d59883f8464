/* SPDX-License-Identifier: MIT */
/* A torus knot: a closed tube whose section is fluted and turns along the way. The grid's lines run
   along the flutes, so that few triangles show them too. */
#include "model.h"

#include <math.h>

#include "base/trigonometry.h"

/* The curve goes TURNS times about the axis and WINDINGS times about the ring while t goes once
   from 0 to 2 pi. */
enum { TURNS = 2, WINDINGS = 3, FLUTES = 5, TWISTS = 4 };
static const double ring = 0.62, winding_radius = 0.26; /* of the curve */
static const double tube = 0.17, flute_depth = 0.22;    /* of the section */

static const double length_to_girth = 7; /* approximate, so that cells are about square */

typedef struct Grid {
    int along, around;
} Grid;

static Grid choose_grid(int wanted) {
    Grid grid;
    int step = wanted < 40 * FLUTES ? 1 : 2 * FLUTES; /* a line on each ridge and in each groove */
    int cells = (int)lround(sqrt(wanted / (2 * length_to_girth)) / step);
    grid.around = step * cells;
    if (grid.around < 3)
        grid.around = 3;
    grid.along = (int)lround(wanted / (2.0 * grid.around));
    if (grid.along < 3)
        grid.along = 3;
    return grid;
}

static int count_triangles(int wanted) {
    Grid grid = choose_grid(wanted);
    return 2 * grid.along * grid.around;
}

/* A point of the curve, and two directions across it at right angles. */
typedef struct Frame {
    double centre[3], outward[3], sideways[3];
} Frame;

/* The curve lies on a torus, whose normal is one of the directions: so the frame closes. */
static Frame curve_frame(double t) {
    double sin_turn, cos_turn, sin_winding, cos_winding;
    hd_sine_cosine(TURNS * t, &sin_turn, &cos_turn);
    hd_sine_cosine(WINDINGS * t, &sin_winding, &cos_winding);
    double radius = ring + winding_radius * cos_winding;
    double about = TURNS * radius, over = WINDINGS * winding_radius; /* the speed's two parts */
    double speed = sqrt(about * about + over * over);
    Frame frame = {
        .centre = {radius * cos_turn, radius * sin_turn, winding_radius * sin_winding},
        .outward = {cos_winding * cos_turn, cos_winding * sin_turn, sin_winding},
    };
    const double around[3] = {-sin_turn, cos_turn, 0};
    const double upward[3] = {-sin_winding * cos_turn, -sin_winding * sin_turn, cos_winding};
    for (int axis = 0; axis < 3; axis++)
        frame.sideways[axis] = (over * around[axis] - about * upward[axis]) / speed;
    return frame;
}

static void write_ring(HdObjWriter *writer, double t, int around) {
    Frame frame = curve_frame(t);
    for (int j = 0; j < around; j++) {
        double angle = 2 * HD_PI * j / around;
        double sine, cosine, wave, unused, point[3];
        hd_sine_cosine(FLUTES * angle, &unused, &wave);
        hd_sine_cosine(angle + TWISTS * t, &sine, &cosine);
        double radius = tube * (1 + flute_depth * wave);
        for (int axis = 0; axis < 3; axis++)
            point[axis] = frame.centre[axis] +
                          radius * (cosine * frame.outward[axis] + sine * frame.sideways[axis]);
        hd_obj_vertex(writer, point);
    }
}

static void write(HdObjWriter *writer, int wanted) {
    Grid grid = choose_grid(wanted);
    for (int i = 0; i < grid.along; i++)
        write_ring(writer, 2 * HD_PI * i / grid.along, grid.around);
    for (int i = 0; i < grid.along; i++) {
        int here = i * grid.around, next = (i + 1) % grid.along * grid.around;
        for (int j = 0; j < grid.around; j++) {
            int right = (j + 1) % grid.around;
            hd_obj_quad(writer, here + j, here + right, next + right, next + j);
        }
    }
}

const HdModel hd_model_knot = {
    .name = "knot",
    .summary = "a trefoil knot of a fluted and twisted tube",
    .triangles = count_triangles,
    .write = write,
};
