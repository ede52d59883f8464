/* SPDX-License-Identifier: MIT */
/* First hits of the eye's rays: depth, normal, number and coverage. */
#include <math.h>

#include "truths.h"
#include "verify/scene_builder.h"

enum { WIDTH = 37, HEIGHT = 29, SIDE = 3 };
static const double FLOOR_Z = -1.0, HALF_SIDE = 3.0, CUBE_HALF = 0.5;

/* Builds a cube along the axes, hovering above a square floor; they are numbers 1 and 2. */
static void build(HdScene *scene, HdCamera *camera) {
    build_scene(scene, WIDTH, HEIGHT, SIDE, 2, 1, 0);
    build_solid(scene, 0, HD_HEXAHEDRON, hd_vec3(0.0, 0.0, 0.25), CUBE_HALF * sqrt(3.0), grey(0.5),
                0);
    build_square_floor(scene, HALF_SIDE, FLOOR_Z);
    build_camera(camera, hd_vec3(2.5, -4.0, 1.75), hd_vec3(0.1, 0.2, -0.3), 65.0);
}

typedef struct Expected {
    double depth; /* 0: nothing is hit */
    HdVec3 normal;
    int object;
    bool is_near_edge; /* too near for floats to decide the hit */
} Expected;

static double component(HdVec3 a, int axis) {
    return axis == 0 ? a.x : axis == 1 ? a.y : a.z;
}

/* Intersects slab by slab. */
static void meet_cube(const HdCamera *camera, HdVec3 direction, Expected *expected) {
    const HdVec3 from = hd_sub(camera->eye, hd_vec3(0.0, 0.0, 0.25));
    double enter = 0.0, before = 0.0, leave = 1e9;
    int by = 0;
    for (int axis = 0; axis < 3; axis++) {
        const double start = component(from, axis), speed = component(direction, axis);
        const double one = (-CUBE_HALF - start) / speed, other = (CUBE_HALF - start) / speed;
        before = fmax(before, fmin(enter, fmin(one, other)));
        if (fmin(one, other) > enter) {
            enter = fmin(one, other);
            by = axis;
        }
        leave = fmin(leave, fmax(one, other));
    }
    expected->is_near_edge |= fabs(enter - leave) < 1e-3 || enter - before < 1e-3;
    if (enter >= leave || enter >= expected->depth)
        return;
    const double towards = component(direction, by) > 0.0 ? -1.0 : 1.0;
    *expected = (Expected){
        enter, hd_vec3(by == 0 ? towards : 0.0, by == 1 ? towards : 0.0, by == 2 ? towards : 0.0),
        1, expected->is_near_edge};
}

static Expected look(const HdCamera *camera, HdVec3 direction) {
    Expected expected = {.depth = 1e9};
    const double depth = (FLOOR_Z - camera->eye.z) / direction.z;
    const HdVec3 point = hd_add(camera->eye, hd_scale(direction, depth));
    const double inside = HALF_SIDE - fmax(fabs(point.x), fabs(point.y));
    expected.is_near_edge = fabs(inside) < 1e-3;
    if (depth > 0.0 && inside > 0.0)
        expected = (Expected){depth, hd_vec3(0.0, 0.0, 1.0), 2, expected.is_near_edge};
    meet_cube(camera, direction, &expected);
    if (expected.object == 0)
        expected.depth = 0.0;
    return expected;
}

/* Returns whether floats can decide. */
static bool is_clear(const HdScene *scene, const HdCamera *camera, int x, int y, double *alpha) {
    int covered = 0;
    bool is_near_edge = false;
    for (int place = 0; place < SIDE * SIDE; place++) {
        const double right = x + (place % SIDE + 0.5) / SIDE,
                     down = y + (place / SIDE + 0.5) / SIDE;
        const Expected sample = look(camera, direction_at(scene, camera, right, down));
        covered += sample.object != 0;
        is_near_edge |= sample.is_near_edge;
    }
    *alpha = (double)covered / (SIDE * SIDE);
    return !is_near_edge;
}

void check_first_hits(Check *check) {
    HdScene scene;
    HdCamera camera;
    int compared[3] = {0}, partly = 0;
    if (!check->target->first_hits)
        return;
    build(&scene, &camera);
    HdFrame frame = render(check, &scene, &camera);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const int x = i % WIDTH, y = i / WIDTH;
        const float *first = frame.first + (size_t)i * HD_MAX_FIRST_FLOATS;
        const float *normal = first + HD_FIRST_NORMAL;
        const Expected middle = look(&camera, direction_at(&scene, &camera, x + 0.5, y + 0.5));
        double alpha;
        if (!is_clear(&scene, &camera, x, y, &alpha))
            continue;
        expect(check, "alpha", x, y, (double)first[HD_FIRST_ALPHA], alpha);
        expect(check, "depth", x, y, (double)first[HD_FIRST_DEPTH], middle.depth);
        expect(check, "normal x", x, y, (double)normal[0], middle.normal.x);
        expect(check, "normal y", x, y, (double)normal[1], middle.normal.y);
        expect(check, "normal z", x, y, (double)normal[2], middle.normal.z);
        expect(check, "number", x, y, (double)first[HD_FIRST_OBJECT], middle.object);
        compared[middle.object]++;
        partly += alpha > 0.0 && alpha < 1.0;
    }
    for (int object = 0; object < 3; object++)
        expect_compared(check, "first hits", compared[object], 40);
    expect_compared(check, "partly covered pixels", partly, 20);
    hd_frame_free(&frame);
    hd_scene_free(&scene);
}
