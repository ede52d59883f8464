/* SPDX-License-Identifier: MIT */
#include "scene/overlap.h"
#include "unit_test.h"

static HdSolid solid_at(HdSolidKind kind, double x, double y, double z, double circumradius) {
    return (HdSolid){.kind = kind, .centre = {x, y, z}, .circumradius = circumradius};
}

/* A cube with edges `edge` long. */
static HdSolid cube_at(double x, double y, double z, double edge) {
    return solid_at(HD_HEXAHEDRON, x, y, z, edge * sqrt(3.0) / 2.0);
}

/* A square floor about (0, 0, z). */
static HdFloor floor_at(double z, double half_side) {
    const double h = half_side;
    return (HdFloor){.present = true, .corners = {{-h, -h, z}, {-h, h, z}, {h, h, z}, {h, -h, z}}};
}

static void expect_overlap(HdSolid a, HdSolid b, double depth) {
    expect_near(hd_solid_overlap(&a, &b), depth, 1e-14);
    expect_near(hd_solid_overlap(&b, &a), depth, 1e-14);
}

static void expect_floor_overlap(HdSolid solid, HdFloor floor, double depth) {
    expect_near(hd_floor_overlap(&solid, &floor), depth, 1e-14);
}

TEST(test_cubes) {
    const HdSolid cube = cube_at(0.0, 0.0, 0.0, 2.0);
    expect_overlap(cube, cube_at(1.5, 0.0, 0.0, 2.0), 0.5);
    expect_overlap(cube, cube_at(1.5, -1.75, 1.875, 2.0), 0.125);
    expect_overlap(cube, cube_at(2.5, 0.0, 0.0, 2.0), 0.0);
    /* Within each other's spheres, and apart all the same. */
    expect_overlap(cube, cube_at(2.1, 0.0, 0.0, 2.0), 0.0);
    expect_overlap(cube, cube_at(1.0, -2.1, 1.0, 2.0), 0.0);
    /* The way out leads through the nearest face, not to the centre. */
    expect_overlap(cube, cube_at(0.0, 0.0, 0.0, 2.0), 2.0);
    expect_overlap(cube, cube_at(0.25, 0.0, 0.0, 0.5), 1.0);
}

TEST(test_touching) {
    const HdSolid cube = cube_at(0.0, 0.0, 0.0, 2.0);
    expect_overlap(cube, cube_at(2.0, 0.0, 0.0, 2.0), 0.0); /* a face */
    expect_overlap(cube, cube_at(2.0, 1.0, 0.5, 2.0), 0.0); /* part of a face */
    expect_overlap(cube, cube_at(2.0, 2.0, 0.0, 2.0), 0.0); /* an edge */
    expect_overlap(cube, cube_at(2.0, 2.0, 2.0, 2.0), 0.0); /* a corner */
    expect_overlap(cube, cube_at(1.5, 0.0, 0.0, 1.0), 0.0);
    HdSolid turned = cube_at(1.0 + sqrt(2.0), 0.0, 0.0, 2.0); /* an edge in a face */
    turned.rotation_degrees.z = 45.0;
    expect_overlap(cube, turned, 0.0);
    turned.centre.x -= 0.125;
    expect_overlap(cube, turned, 0.125);
}

/* Edges that cross at a right angle: the axis that tells them apart is no face's normal. */
TEST(test_crossed_edges) {
    HdSolid a = cube_at(0.0, 0.0, 0.0, 2.0), b = cube_at(2.0 * sqrt(2.0), 0.0, 0.0, 2.0);
    a.rotation_degrees.z = 45.0;
    b.rotation_degrees.y = 45.0;
    expect_overlap(a, b, 0.0);
    b.centre.x -= 0.0625;
    expect_overlap(a, b, 0.0625);
    b.centre.x += 0.125;
    expect_overlap(a, b, 0.0);
}

TEST(test_what_counts_as_touching) {
    for (double size = 1e-12; size < 1e12; size *= 10.0) {
        const HdSolid cube = cube_at(0.0, 0.0, 0.0, 2.0 * size);
        const HdSolid just = cube_at((2.0 - 1.7e-9) * size, 0.0, 0.0, 2.0 * size);
        const HdSolid more = cube_at((2.0 - 1.8e-9) * size, 0.0, 0.0, 2.0 * size);
        assert_true(hd_solid_overlap(&cube, &just) == 0.0);
        assert_true(hd_solid_overlap(&cube, &more) > 0.0);
        /* The smaller one's size is what counts. */
        const HdSolid small = cube_at((1.001 - 1.8e-12) * size, 0.0, 0.0, 0.002 * size);
        assert_true(hd_solid_overlap(&cube, &small) > 0.0);
    }
}

/* Decimal places far from the origin: their rounding alone makes neighbours overlap. */
TEST(test_touching_far_away) {
    for (int i = 0; i < 1000; i++) {
        const double x = 1e9 + 0.1 * i, side = 0.002;
        const HdSolid a = cube_at(x, 0.1, 1e8, side), b = cube_at(x + side, 0.1, 1e8, side);
        const HdSolid deep = cube_at(x + side / 2.0, 0.1, 1e8, side);
        assert_true(hd_solid_overlap(&a, &b) == 0.0);
        assert_true(hd_solid_overlap(&a, &deep) > 0.0);
    }
}

/* At every angle: on a corner, on an edge or on a face. */
static const HdVec3 rotations[] = {
    {0.0, 0.0, 0.0}, {45.0, 0.0, 0.0}, {0.0, 90.0, 45.0}, {10.0, 20.0, 30.0}, {-70.0, 5.0, 200.0}};
enum { ROTATIONS = sizeof rotations / sizeof rotations[0] };

static void expect_standing(HdSolid solid, double lowest, double highest) {
    const HdFloor floor = floor_at(-1.0, 10.0);
    const double sunk = 0.01 * solid.circumradius;
    solid.centre.z = -1.0 - lowest;
    expect_floor_overlap(solid, floor, 0.0);
    solid.centre.z -= sunk;
    expect_floor_overlap(solid, floor, sunk);
    solid.centre.z = -1.0 - highest; /* hanging below it */
    expect_floor_overlap(solid, floor, 0.0);
    solid.centre.z += sunk;
    expect_floor_overlap(solid, floor, sunk);
}

TEST(test_standing_on_the_floor) {
    for (HdSolidKind kind = HD_TETRAHEDRON; kind < HD_SOLID_KIND_COUNT; kind++)
        for (int i = 0; i < ROTATIONS; i++)
            for (double radius = 1e-3; radius < 5.0; radius *= 7.0) {
                HdPlatonic shape;
                hd_platonic(kind, &shape);
                hd_platonic_rotate(&shape, rotations[i]);
                double lowest = 0.0, highest = 0.0;
                for (int v = 0; v < shape.vertex_count; v++) {
                    lowest = fmin(lowest, shape.vertex[v].z * radius);
                    highest = fmax(highest, shape.vertex[v].z * radius);
                }
                HdSolid solid = solid_at(kind, 0.5, -1.25, 0.0, radius);
                solid.rotation_degrees = rotations[i];
                expect_standing(solid, lowest, highest);
            }
}

TEST(test_beside_the_floor) {
    const HdFloor floor = floor_at(0.0, 5.0);
    expect_floor_overlap(cube_at(0.0, 0.0, 0.0, 2.0), floor, 1.0);
    expect_floor_overlap(cube_at(5.75, 0.0, 0.0, 2.0), floor, 0.25);
    expect_floor_overlap(cube_at(6.0, 0.0, 0.0, 2.0), floor, 0.0);
    expect_floor_overlap(cube_at(6.0, 6.0, 0.0, 2.0), floor, 0.0);
    expect_floor_overlap(cube_at(6.25, 0.0, 0.0, 2.0), floor, 0.0);
    /* Within the sphere about the floor, and at the same height. */
    expect_floor_overlap(cube_at(6.5, 3.0, 0.0, 2.0), floor, 0.0);
    /* A face before the floor's corner. */
    HdSolid turned = cube_at(5.0 + sqrt(0.5), 5.0 + sqrt(0.5), 0.0, 2.0);
    turned.rotation_degrees.z = 45.0;
    expect_floor_overlap(turned, floor, 0.0);
    turned.centre = hd_vec3(5.0 + sqrt(0.5) - 0.125, 5.0 + sqrt(0.5) - 0.125, 0.0);
    expect_floor_overlap(turned, floor, 0.125 * sqrt(2.0));
}

/* Opposite corners 1e-5 of the diagonal above the others: the plane passes half way between. */
TEST(test_a_floor_that_is_not_quite_flat) {
    HdFloor floor = floor_at(0.0, 5.0);
    floor.corners[0].z = floor.corners[2].z = 1e-4;
    expect_floor_overlap(cube_at(0.0, 0.0, 1.00005, 2.0), floor, 0.0);
    expect_floor_overlap(cube_at(0.0, 0.0, 1.00004, 2.0), floor, 1e-5);
}

static uint64_t random_state;

static double random_between(double low, double high) {
    random_state = random_state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return low + (high - low) * ldexp((double)(random_state >> 11), -53);
}

static HdSolid random_solid(double spread) {
    HdSolid solid = {.kind = (HdSolidKind)random_between(0.0, HD_SOLID_KIND_COUNT)};
    solid.centre = hd_vec3(random_between(-spread, spread), random_between(-spread, spread),
                           random_between(-spread, spread));
    solid.rotation_degrees = hd_vec3(random_between(-180.0, 180.0), random_between(-180.0, 180.0),
                                     random_between(-180.0, 180.0));
    solid.circumradius = random_between(0.5, 1.5);
    return solid;
}

/* A solid as its faces' planes, which is another way to describe it than by its vertices. */
typedef struct Planes {
    HdPlatonic shape;
    HdVec3 centre;
    double distance;
} Planes;

static Planes planes_of(const HdSolid *solid) {
    Planes planes = {.centre = solid->centre};
    hd_platonic(solid->kind, &planes.shape);
    hd_platonic_rotate(&planes.shape, solid->rotation_degrees);
    planes.distance = planes.shape.inradius * solid->circumradius;
    return planes;
}

static bool is_inside(const Planes *planes, HdVec3 point) {
    const HdVec3 from_centre = hd_sub(point, planes->centre);
    for (int f = 0; f < planes->shape.face_count; f++)
        if (hd_dot(planes->shape.face_normal[f], from_centre) >= planes->distance)
            return false;
    return true;
}

static HdVec3 random_point_about(const HdSolid *solid) {
    const double r = solid->circumradius;
    return hd_add(solid->centre,
                  hd_vec3(random_between(-r, r), random_between(-r, r), random_between(-r, r)));
}

enum { PAIRS = 500, POINTS = 20000 };

/* What is deep is hit by some of many random points, what does not overlap by none. */
static void expect_samples_agree(double depth, bool found, int *deep, int *apart) {
    if (found)
        assert_true(depth > 0.0);
    if (depth > 0.2)
        assert_true(found);
    *deep += depth > 0.2;
    *apart += depth == 0.0;
}

TEST(test_solids_against_random_points) {
    int deep = 0, apart = 0;
    random_state = 1;
    for (int i = 0; i < PAIRS; i++) {
        const HdSolid a = random_solid(1.0), b = random_solid(1.0);
        const Planes of_a = planes_of(&a), of_b = planes_of(&b);
        bool found = false;
        for (int k = 0; k < POINTS && !found; k++) {
            const HdVec3 point = random_point_about(&a);
            found = is_inside(&of_a, point) && is_inside(&of_b, point);
        }
        expect_samples_agree(hd_solid_overlap(&a, &b), found, &deep, &apart);
    }
    assert_true(deep > PAIRS / 5 && apart > PAIRS / 5);
}

static HdVec3 random_point_on(const HdFloor *floor) {
    const double u = random_between(0.0, 1.0), v = random_between(0.0, 1.0);
    const HdVec3 near =
        hd_add(hd_scale(floor->corners[0], 1.0 - u), hd_scale(floor->corners[1], u));
    const HdVec3 far = hd_add(hd_scale(floor->corners[3], 1.0 - u), hd_scale(floor->corners[2], u));
    return hd_add(hd_scale(near, 1.0 - v), hd_scale(far, v));
}

TEST(test_floors_against_random_points) {
    HdFloor floor = floor_at(0.0, 1.5);
    int deep = 0, apart = 0;
    floor.corners[2] = hd_vec3(0.5, 0.75, 0.0);
    for (int i = 0; i < 4; i++)
        floor.corners[i].z = 0.5 * floor.corners[i].x - 0.25 * floor.corners[i].y;
    random_state = 2;
    for (int i = 0; i < PAIRS; i++) {
        const HdSolid solid = random_solid(2.0);
        const Planes planes = planes_of(&solid);
        bool found = false;
        for (int k = 0; k < POINTS && !found; k++)
            found = is_inside(&planes, random_point_on(&floor));
        expect_samples_agree(hd_floor_overlap(&solid, &floor), found, &deep, &apart);
    }
    assert_true(deep > PAIRS / 10 && apart > PAIRS / 5);
}

/* The depth is the length of the shortest way out: no shorter move parts the two, and some move
   that is hardly longer does. */
TEST(test_the_depth_is_the_shortest_way_out) {
    random_state = 3;
    for (int i = 0; i < 20; i++) {
        const HdSolid a = random_solid(0.5), b = random_solid(0.5);
        const double depth = hd_solid_overlap(&a, &b);
        bool parted = false;
        for (int k = 0; k < 2000 && depth > 0.0; k++) {
            HdSolid moved = b;
            const HdVec3 way = hd_normalize(hd_vec3(
                random_between(-1.0, 1.0), random_between(-1.0, 1.0), random_between(-1.0, 1.0)));
            moved.centre = hd_add(b.centre, hd_scale(way, 0.999 * depth));
            assert_true(hd_solid_overlap(&a, &moved) > 0.0);
            moved.centre = hd_add(b.centre, hd_scale(way, 1.02 * depth));
            parted = parted || hd_solid_overlap(&a, &moved) == 0.0;
        }
        assert_true(depth == 0.0 || parted);
    }
}
