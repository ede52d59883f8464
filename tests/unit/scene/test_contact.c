/* SPDX-License-Identifier: MIT */
#include <stdlib.h>

#include "scene/contact.h"
#include "scene/overlap.h"
#include "unit_test.h"

/* A cube with edges `edge` long. */
static HdSolid cube_at(double x, double y, double z, double edge) {
    return (HdSolid){
        .kind = HD_HEXAHEDRON, .centre = {x, y, z}, .circumradius = edge * sqrt(3.0) / 2.0};
}

static HdFloor floor_at(double z) {
    return (HdFloor){.present = true,
                     .corners = {{-9.0, -9.0, z}, {-9.0, 9.0, z}, {9.0, 9.0, z}, {9.0, -9.0, z}}};
}

static void expect_contact(HdSolid a, HdSolid b, HdContact contact) {
    assert_int_equal(hd_solids_contact(&a, &b), contact);
    assert_int_equal(hd_solids_contact(&b, &a), contact);
}

TEST(contacts_of_solids) {
    const HdSolid cube = cube_at(0.0, 0.0, 0.0, 2.0);
    expect_contact(cube, cube_at(2.0, 0.0, 0.0, 2.0), HD_CONTACT_TOUCHES); /* a face */
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
    const HdFloor below = floor_at(0.0), under = floor_at(-0.1), within = floor_at(0.5);
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

/* Nothing coincides any more, and nothing has moved by more than a few millionths. */
static void expect_parted(HdScene *scene) {
    double before[8];
    for (int i = 0; i < scene->solid_count; i++)
        before[i] = scene->solids[i].circumradius;
    hd_scene_part_contacts(scene);
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

TEST(everything_is_parted) {
    HdSolid stack[] = {cube_at(0.0, 0.0, 1.0, 2.0),  cube_at(0.5, 0.25, 2.5, 1.0),
                       cube_at(2.0, 0.0, 1.0, 2.0),  cube_at(0.5, 0.0, 1.0, 1.0),
                       cube_at(-0.5, 0.0, 0.5, 1.0), cube_at(4.0, 0.0, 4.0, 0.5)};
    HdLight light = {.position = {4.25, 0.125, 4.0}};
    HdScene scene = {.solid_count = 6,
                     .solids = stack,
                     .floor = floor_at(0.0),
                     .light_count = 1,
                     .lights = &light};
    expect_parted(&scene);
    /* By half the size, a step moves its faces as far as two steps move the larger one's. */
    HdSolid nested[] = {cube_at(0.0, 0.0, 1.0, 2.0), cube_at(0.5, 0.5, 0.5, 1.0),
                        cube_at(-0.5, 0.5, 0.5, 1.0), cube_at(0.0, 0.5, 0.25, 0.5)};
    scene.solids = nested;
    scene.solid_count = 4;
    expect_parted(&scene);
}

TEST(what_lies_apart_stays) {
    HdSolid solids[] = {cube_at(0.0, 0.0, 1.5, 2.0), cube_at(0.5, 0.25, 2.75, 2.0)};
    const double radius = solids[0].circumradius;
    HdScene scene = {.solid_count = 2, .solids = solids, .floor = floor_at(0.0)};
    hd_scene_part_contacts(&scene);
    assert_true(solids[0].circumradius == radius && solids[1].circumradius == radius);
    solids[1].centre.z = 3.5; /* the earlier one stays */
    hd_scene_part_contacts(&scene);
    assert_true(solids[0].circumradius == radius && solids[1].circumradius < radius);
}

/* Steps are as long as the greatest of the group, though two of it do not touch what that comes
   from. */
TEST(what_touches_in_turn_is_parted_by_equal_steps) {
    HdSolid solids[] = {cube_at(0.0, 0.0, 4.0, 8.0), cube_at(4.5, 0.0, 4.0, 1.0),
                        cube_at(5.5, 0.0, 4.0, 1.0), cube_at(5.0, 0.0, 4.75, 0.5)};
    const double before = solids[1].circumradius, small = solids[3].circumradius;
    HdScene scene = {.solid_count = 4, .solids = solids};
    hd_scene_part_contacts(&scene);
    const double step = before - solids[1].circumradius;
    assert_true(step > 0.0);
    assert_true(solids[2].circumradius == before);
    expect_near(small - solids[3].circumradius, 2.0 * step, 1e-3 * step);
}
