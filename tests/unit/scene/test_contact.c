/* SPDX-License-Identifier: MIT */
/* Depths of overlap between solids and with the floor, and the handling of contacts. */
#include "scene/contact.h"
#include "unit_test.h"

/* Returns a cube with edges `edge` long. */
static HdSolid cube_at(double x, double y, double z, double edge) {
    return (HdSolid){
        .kind = HD_HEXAHEDRON, .centre = {x, y, z}, .circumradius = edge * sqrt(3.0) / 2.0};
}

/* Returns a square floor about (0, 0, z). */
static HdFloor floor_at(double z, double half_side) {
    const double h = half_side;
    return (HdFloor){.present = true, .corners = {{-h, -h, z}, {-h, h, z}, {h, h, z}, {h, -h, z}}};
}

/* A cube with edges 2 long at the origin, and another. */
TEST(test_cubes) {
    const double root2 = sqrt(2.0);
    const struct {
        double x, y, z, edge, turn; /* about z, in degrees */
        double depth;
    } rows[] = {{1.5, 0.0, 0.0, 2.0, 0.0, 0.5},
                {1.5, -1.75, 1.875, 2.0, 0.0, 0.125},
                {2.1, 0.0, 0.0, 2.0, 0.0, 0.0}, /* spheres overlap, solids do not */
                {1.0, -2.1, 1.0, 2.0, 0.0, 0.0},
                {0.0, 0.0, 0.0, 2.0, 0.0, 2.0}, /* through the nearest face, not to the centre */
                {0.25, 0.0, 0.0, 0.5, 0.0, 1.0},
                {2.0, 1.0, 0.5, 2.0, 0.0, 0.0},          /* touching: part of a face */
                {2.0, 2.0, 2.0, 2.0, 0.0, 0.0},          /* a corner */
                {1.0 + root2, 0.0, 0.0, 2.0, 45.0, 0.0}, /* an edge in a face */
                {0.875 + root2, 0.0, 0.0, 2.0, 45.0, 0.125}};
    const HdSolid cube = cube_at(0.0, 0.0, 0.0, 2.0);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        HdSolid other = cube_at(rows[i].x, rows[i].y, rows[i].z, rows[i].edge);
        other.rotation_degrees.z = rows[i].turn;
        expect_near(hd_solid_overlap(&cube, &other), rows[i].depth, 1e-14);
        expect_near(hd_solid_overlap(&other, &cube), rows[i].depth, 1e-14);
    }
    /* Edges that cross at a right angle: the separating axis is no face's normal. */
    for (int i = -1; i <= 1; i++) {
        HdSolid a = cube, b = cube_at(2.0 * root2 + 0.0625 * i, 0.0, 0.0, 2.0);
        a.rotation_degrees.z = 45.0;
        b.rotation_degrees.y = 45.0;
        expect_near(hd_solid_overlap(&a, &b), i < 0 ? 0.0625 : 0.0, 1e-14);
        expect_near(hd_solid_overlap(&b, &a), i < 0 ? 0.0625 : 0.0, 1e-14);
    }
}

TEST(test_contact_threshold) {
    for (double size = 1e-12; size < 1e12; size *= 10.0) {
        const HdSolid cube = cube_at(0.0, 0.0, 0.0, 2.0 * size);
        const HdSolid just = cube_at((2.0 - 1.7e-9) * size, 0.0, 0.0, 2.0 * size);
        const HdSolid more = cube_at((2.0 - 1.8e-9) * size, 0.0, 0.0, 2.0 * size);
        assert_true(hd_solid_overlap(&cube, &just) == 0.0);
        assert_true(hd_solid_overlap(&cube, &more) > 0.0);
        /* The smaller one's size counts. */
        const HdSolid small = cube_at((1.001 - 1.8e-12) * size, 0.0, 0.0, 0.002 * size);
        assert_true(hd_solid_overlap(&cube, &small) > 0.0);
    }
    /* Far from the origin, rounding alone makes neighbours overlap. */
    for (int i = 0; i < 100; i++) {
        const double x = 1e9 + 0.1 * i, side = 0.002;
        const HdSolid a = cube_at(x, 0.1, 1e8, side), b = cube_at(x + side, 0.1, 1e8, side);
        const HdSolid deep = cube_at(x + side / 2.0, 0.1, 1e8, side);
        assert_true(hd_solid_overlap(&a, &b) == 0.0 && hd_solid_overlap(&a, &deep) > 0.0);
    }
}

TEST(test_depths_of_the_floor) {
    const double corner = 5.0 + sqrt(0.5), nearer = corner - 0.125;
    const HdFloor floor = floor_at(0.0, 5.0);
    const struct {
        double x, y, turn, depth;
    } rows[] = {{0.0, 0.0, 0.0, 1.0},
                {5.75, 0.0, 0.0, 0.25},
                {6.5, 3.0, 0.0, 0.0}, /* within the sphere about the floor, at the same height */
                {corner, corner, 45.0, 0.0}, /* a face before the floor's corner */
                {nearer, nearer, 45.0, 0.125 * sqrt(2.0)}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        HdSolid cube = cube_at(rows[i].x, rows[i].y, 0.0, 2.0);
        cube.rotation_degrees.z = rows[i].turn;
        expect_near(hd_floor_depth(&cube, &floor, 0.0), rows[i].depth, 1e-14);
    }
}

static double random_between(double low, double high) {
    static uint64_t random_state = 1;
    random_state = random_state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return low + (high - low) * ldexp((double)(random_state >> 11), -53);
}

/* Returns a point in a cube of sides 2 * `reach`. */
static HdVec3 random_vector(double reach) {
    return hd_vec3(random_between(-reach, reach), random_between(-reach, reach),
                   random_between(-reach, reach));
}

static HdSolid random_solid(void) {
    return (HdSolid){.kind = (HdSolidKind)random_between(0.0, HD_SOLID_KIND_COUNT),
                     .centre = random_vector(1.0),
                     .rotation_degrees = random_vector(180.0),
                     .circumradius = random_between(0.5, 1.5)};
}

/* Tests the planes of its faces, independently of its vertices. */
static bool is_inside(const HdSolid *solid, const HdPlatonic *shape, HdVec3 point) {
    const HdVec3 from_centre = hd_sub(point, solid->centre);
    for (int f = 0; f < shape->face_count; f++)
        if (hd_dot(shape->face_normal[f], from_centre) >= shape->inradius * solid->circumradius)
            return false;
    return true;
}

/* Some of many random points hit a deep overlap, none hits separate solids. */
TEST(test_random_points) {
    enum { PAIRS = 100, POINTS = 20000 };
    int deep = 0, apart = 0;
    for (int i = 0; i < PAIRS; i++) {
        const HdSolid a = random_solid(), b = random_solid();
        const HdPlatonic of_a = hd_solid_shape(&a), of_b = hd_solid_shape(&b);
        const double depth = hd_solid_overlap(&a, &b);
        bool found = false;
        for (int k = 0; k < POINTS && !found; k++) {
            const HdVec3 point = hd_add(b.centre, random_vector(b.circumradius));
            found = is_inside(&b, &of_b, point) && is_inside(&a, &of_a, point);
        }
        assert_true(found ? depth > 0.0 : depth <= 0.2);
        deep += depth > 0.2;
        apart += depth == 0.0;
    }
    assert_true(deep > PAIRS / 10 && apart > PAIRS / 5);
}

static void expect_contact(HdSolid a, HdSolid b, HdContact contact) {
    assert_int_equal(hd_solids_contact(&a, &b), contact);
    assert_int_equal(hd_solids_contact(&b, &a), contact);
}

TEST(contacts_of_solids) {
    const HdSolid cube = cube_at(0.0, 0.0, 0.0, 2.0);
    expect_contact(cube, cube_at(2.0, 2.0, 0.5, 2.0), HD_CONTACT_TOUCHES); /* an edge */
    expect_contact(cube, cube_at(2.0, 2.0, 2.0, 2.0), HD_CONTACT_TOUCHES); /* a corner */
    expect_contact(cube, cube_at(2.0 + 2e-7, 0.0, 0.0, 2.0), HD_CONTACT_TOUCHES);
    expect_contact(cube, cube_at(2.0 - 2e-7, 0.0, 0.0, 2.0), HD_CONTACT_TOUCHES);
    expect_contact(cube, cube_at(2.0 + 3e-6, 0.0, 0.0, 2.0), HD_CONTACT_NONE);
    expect_contact(cube, cube_at(2.0 - 3e-6, 0.5, 0.5, 2.0), HD_CONTACT_OVERLAPS);
    expect_contact(cube, cube_at(1.0, 0.5, 0.5, 2.0), HD_CONTACT_OVERLAPS);
    expect_contact(cube, cube_at(1.0, 0.5, 0.0, 2.0), HD_CONTACT_SHARES); /* top and bottom */
    expect_contact(cube, cube_at(1.9, 0.5, 0.0, 2.0), HD_CONTACT_SHARES); /* a strip of them */
    expect_contact(cube, cube_at(0.5, 0.0, 0.0, 1.0), HD_CONTACT_SHARES); /* nested */
    HdSolid turned = cube_at(0.0, 0.0, 0.0, 2.0);
    turned.rotation_degrees.z = 30.0;
    expect_contact(cube, turned, HD_CONTACT_SHARES);
    turned.rotation_degrees.x = 1e-3;
    expect_contact(cube, turned, HD_CONTACT_OVERLAPS);
}

TEST(contacts_of_floors_and_lights) {
    const HdSolid cube = cube_at(0.0, 0.0, 1.0, 2.0);
    const HdFloor below = floor_at(0.0, 9.0), under = floor_at(-0.1, 9.0);
    const HdFloor within = floor_at(0.5, 9.0);
    assert_int_equal(hd_floor_contact(&cube, &below), HD_CONTACT_TOUCHES);
    assert_int_equal(hd_floor_contact(&cube, &under), HD_CONTACT_NONE);
    assert_int_equal(hd_floor_contact(&cube, &within), HD_CONTACT_OVERLAPS);
    const HdLight lights[] = {
        {.position = {1.0, 1.5, 0.5}},        {.position = {0.0, 0.0, 1.0}},
        {.position = {1.0, 0.5, 0.5}},        {.position = {0.5, 0.5, 0.3}},
        {.position = {1.0, 1.0, 2.0}},        {.position = {1.0 + 3e-6, 0.0, 1.0}},
        {.position = {0.0, 1.0 - 2e-7, 1.0}}, {.position = {9.0, 0.0, 1.0}}};
    int first = -1;
    assert_int_equal(hd_touching_lights(&cube, lights, 8, &first), 3);
    assert_int_equal(first, 2);
    assert_int_equal(hd_touching_lights(&cube, lights, 2, &first), 0);
}

/* Expects that nothing coincides any more, and nothing has moved by more than a few millionths. */
static void expect_parted(HdScene *scene) {
    double before[8];
    for (int i = 0; i < scene->solid_count; i++)
        before[i] = scene->solids[i].circumradius;
    hd_scene_separate_contacts(scene);
    for (int i = 0; i < scene->solid_count; i++) {
        const HdSolid *solid = &scene->solids[i];
        assert_true(solid->circumradius <= before[i]);
        expect_near(solid->circumradius, before[i], 4e-5 * before[i]);
        assert_false(hd_contact_coincides(hd_floor_contact(solid, &scene->floor)));
        for (int j = 0; j < i; j++)
            assert_false(hd_contact_coincides(hd_solids_contact(&scene->solids[j], solid)));
        int first;
        assert_int_equal(hd_touching_lights(solid, scene->lights, scene->light_count, &first), 0);
    }
}

TEST(all_contacts_are_separated) {
    HdSolid stack[] = {cube_at(0.0, 0.0, 1.0, 2.0),  cube_at(0.5, 0.25, 2.5, 1.0),
                       cube_at(2.0, 0.0, 1.0, 2.0),  cube_at(0.5, 0.0, 1.0, 1.0),
                       cube_at(-0.5, 0.0, 0.5, 1.0), cube_at(4.0, 0.0, 4.0, 0.5)};
    HdLight light = {.position = {4.25, 0.125, 4.0}};
    HdScene scene = {.solid_count = 6,
                     .solids = stack,
                     .floor = floor_at(0.0, 9.0),
                     .light_count = 1,
                     .lights = &light};
    expect_parted(&scene);
    /* With half the size, a step moves its faces as far as two steps move the larger one's. */
    HdSolid nested[] = {cube_at(0.0, 0.0, 1.0, 2.0), cube_at(0.5, 0.5, 0.5, 1.0),
                        cube_at(-0.5, 0.5, 0.5, 1.0), cube_at(0.0, 0.5, 0.25, 0.5)};
    scene.solids = nested;
    scene.solid_count = 4;
    expect_parted(&scene);
    /* Separate solids stay, and so does the earlier one of two. */
    HdSolid two[] = {cube_at(0.0, 0.0, 1.5, 2.0), cube_at(0.5, 0.25, 2.75, 2.0)};
    const double radius = two[0].circumradius;
    scene = (HdScene){.solid_count = 2, .solids = two, .floor = floor_at(0.0, 9.0)};
    hd_scene_separate_contacts(&scene);
    assert_true(two[0].circumradius == radius && two[1].circumradius == radius);
    two[1].centre.z = 3.5;
    hd_scene_separate_contacts(&scene);
    assert_true(two[0].circumradius == radius && two[1].circumradius < radius);
}

/* Steps are as long as the greatest of the group, even if two of it do not touch its owner. */
TEST(chains_of_contacts_are_separated_by_equal_steps) {
    HdSolid solids[] = {cube_at(0.0, 0.0, 4.0, 8.0), cube_at(4.5, 0.0, 4.0, 1.0),
                        cube_at(5.5, 0.0, 4.0, 1.0), cube_at(5.0, 0.0, 4.75, 0.5)};
    const double before = solids[1].circumradius, small = solids[3].circumradius;
    HdScene scene = {.solid_count = 4, .solids = solids};
    hd_scene_separate_contacts(&scene);
    const double step = before - solids[1].circumradius;
    assert_true(step > 0.0);
    assert_true(solids[2].circumradius == before);
    expect_near(small - solids[3].circumradius, 2.0 * step, 1e-3 * step);
}

TEST(meshes_placed_twice_count_once) {
    HdInstance instances[] = {{.mesh = 0},
                              {.mesh = 1},
                              {.mesh = 0, .position.x = -0.0},
                              {.mesh = 0, .scale.z = 2.0},
                              {.mesh = 0, .rotation_degrees.y = 1e-300},
                              {.mesh = 0, .up = HD_UP_Y},
                              {.mesh = 1}};
    HdScene scene = {.instance_count = 7, .instances = instances};
    int dropped;
    assert_int_equal(hd_scene_drop_second_instances(&scene, &dropped, NULL), HD_OK);
    assert_true(dropped == 2 && scene.instance_count == 5 && instances[1].mesh == 1 &&
                instances[2].scale.z == 2.0 && instances[3].rotation_degrees.y == 1e-300 &&
                instances[4].up == HD_UP_Y);
}
