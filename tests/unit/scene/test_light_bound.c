/* SPDX-License-Identifier: MIT */
#include "scene/light_bound.h"
#include "unit_test.h"

static HdMaterial plain(void) {
    return (HdMaterial){.colour = {1.0, 0.5, 0.0},
                        .mirror_tint = {1.0, 1.0, 1.0},
                        .shininess = 1,
                        .index_of_refraction = 1.0};
}

TEST(lights_add_up) {
    HdLight lights[2] = {{.intensity = {1.0, 2.0, 3.0}}, {.intensity = {0.5, 0.0, 0.25}}};
    HdSolid solid = {.kind = HD_HEXAHEDRON,
                     .lights = {.per_edge = 2,
                                .colour_count = 2,
                                .colours = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}},
                                .intensity = 0.1}};
    HdScene scene = {.light_count = 2, .lights = lights, .solid_count = 1, .solids = &solid};
    HdVec3 bound = hd_light_bound(&scene);
    /* A cube has 12 edges: 6 of each colour, with 2 lights each. */
    expect_near(bound.x, 1.5 + 1.2, 0.06);
    expect_near(bound.y, 2.0 + 1.2, 0.07);
    expect_near(bound.z, 3.25, 0.07);
    assert_true(bound.z >= 3.25);
    solid.lights.intensity = 0.0;
    expect_near(hd_light_bound(&scene).x, 1.5, 0.04);
}

/* What a surface shows of itself, over what it does not send on. */
TEST(mirrors_multiply) {
    HdScene scene = {.floor = {.present = true, .material = plain()}, .exposure = 1.0};
    HdMaterial *material = &scene.floor.material;
    material->ambient = 0.2;
    expect_near(hd_radiance_bound(&scene).x, 0.2, 0.005);
    material->reflection = 0.5;
    material->transmission = 0.25;
    HdVec3 bound = hd_radiance_bound(&scene);
    expect_near(bound.x, 0.2 / (1.0 - 0.75), 0.02);
    expect_near(bound.y, 0.1 / (1.0 - 0.5 - 0.125), 0.01);
    expect_near(bound.z, 0.0, 1e-12);
    material->has_inner_side = true;
    material->inner_reflection = 0.9;
    expect_near(hd_radiance_bound(&scene).x, 0.2 / (1.0 - 0.9), 0.05);
    material->inner_reflection = 1.0;
    expect_near(hd_radiance_bound(&scene).x, 0.2 * (HD_MAX_DEPTH + 1), 5.0);
    scene.background.x = 7.0; /* a mirror that sends all on adds to what ends the way */
    assert_true(hd_radiance_bound(&scene).x >= 7.0 + 0.2 * (HD_MAX_DEPTH + 1));
}

/* Under total reflection the mirror, whose tint is white, takes over what would have passed. */
TEST(total_reflection_counts) {
    HdScene scene = {.floor = {.present = true, .material = plain()}, .exposure = 1.0};
    HdMaterial *material = &scene.floor.material;
    material->ambient = 0.1;
    material->colour = (HdVec3){0.01, 0.01, 0.01};
    material->reflection = 0.1;
    material->transmission = 0.8;
    expect_near(hd_radiance_bound(&scene).x, 0.001 / (1.0 - 0.108), 1e-4);
    material->index_of_refraction = 2.0;
    expect_near(hd_radiance_bound(&scene).x, 0.001 / (1.0 - 0.9), 3e-4);
}

TEST(the_brightest_counts) {
    HdSolid solid = {
        .kind = HD_TETRAHEDRON,
        .face = plain(),
        .lights = {
            .per_edge = 1, .colour_count = 1, .colours = {{0.5, 0.25, 1.0}}, .disc_radiance = 8.0}};
    HdScene scene = {.solid_count = 1, .solids = &solid, .background = {5.0, 0.0, 0.0}};
    HdVec3 bound = hd_radiance_bound(&scene);
    expect_near(bound.x, 5.0, 0.11);
    expect_near(bound.y, 2.0, 0.05);
    expect_near(bound.z, 8.0, 0.17);
}

/* A room of mirrors that is `apart` from another solid. */
static void two_solids(HdSolid solids[2], double apart) {
    solids[0] = (HdSolid){.kind = HD_HEXAHEDRON, .circumradius = 1.0, .face = plain()};
    solids[0].face.ambient = 0.1;
    solids[0].face.has_inner_side = true;
    solids[0].face.inner_reflection = 0.5;
    solids[1] = (HdSolid){.kind = HD_HEXAHEDRON, .circumradius = 1.0, .face = plain()};
    solids[1].face.ambient = 4.0;
    solids[1].centre.x = apart;
}

/* Within a room nothing is seen but the room, unless something reaches into it. */
TEST(rays_see_what_is_there) {
    HdSolid solids[2];
    HdSeen seen[4];
    HdScene scene = {.solid_count = 2, .solids = solids, .background = {0.5, 0.0, 0.0}};
    two_solids(solids, 3.0);
    hd_seen_bounds(&scene, seen);
    expect_near(seen[0].inside.x, 0.1 / (1.0 - 0.5), 0.01);
    expect_near(seen[0].outside.x, 4.0, 0.1);
    expect_near(seen[1].inside.x, 4.0, 0.1);
    expect_near(seen[1].outside.x, 0.5, 0.02); /* never itself */
    expect_near(seen[2].outside.x, 4.0, 0.1);
    assert_true(seen[0].inside.x >= 0.2 && seen[1].outside.x >= 0.5);
    two_solids(solids, 1.154); /* the faces are 1.1547 apart where they touch */
    hd_seen_bounds(&scene, seen);
    expect_near(seen[0].inside.x, 4.0, 0.1);
    two_solids(solids, 1.155);
    hd_seen_bounds(&scene, seen);
    expect_near(seen[0].inside.x, 4.0, 0.1); /* so near is in the same place */
    two_solids(solids, 3.0);
    solids[0].face.inner_transmission = 0.25;
    hd_seen_bounds(&scene, seen);
    expect_near(seen[0].inside.x, (0.1 + 0.25 * 4.0) / (1.0 - 0.5), 0.05);
    solids[0].lights = (HdEdgeLights){
        .per_edge = 1, .colour_count = 1, .colours = {{1.0, 1.0, 1.0}}, .disc_radiance = 3.0};
    hd_seen_bounds(&scene, seen);
    expect_near(seen[0].inside.x, 3.0, 0.1);
    scene.floor = (HdFloor){.present = true,
                            .corners = {{-4, 4, 0.5}, {4, 4, 0.5}, {4, -4, 0.5}, {-4, -4, 0.5}},
                            .material = plain()};
    scene.floor.material.ambient = 8.0;
    hd_seen_bounds(&scene, seen);
    expect_near(seen[0].inside.x, 8.0, 0.2);                           /* it cuts the room */
    expect_near(seen[2].outside.x, 0.1 + 0.5 * 8.0 + 0.25 * 8.0, 0.3); /* and is not met twice */
}

/* What meshes show by themselves and send on, with their own materials and with a place's. */
TEST(meshes_are_seen_from_all_sides) {
    HdMeshMaterial materials[2] = {{.material = plain(), .emission = {0.5, 6.0, 0.0}},
                                   {.material = plain(), .emission = {2.0, 0.0, 0.0}}};
    HdMesh mesh = {.material_count = 2, .materials = materials};
    HdInstance instance = {.material = plain()};
    HdSolid solids[2];
    HdSeen seen[4];
    HdScene scene = {.solid_count = 2,
                     .solids = solids,
                     .meshes = &mesh,
                     .mesh_count = 1,
                     .instances = &instance,
                     .instance_count = 1};
    two_solids(solids, 3.0);
    solids[1].face.ambient = 1.0;
    hd_seen_bounds(&scene, seen);
    for (int i = 0; i < 4; i++) {
        expect_near(seen[i].outside.x, 2.0, 0.1);
        expect_near(seen[i].outside.y, 6.0, 0.2);
        expect_near(seen[i].inside.y, 6.0, 0.2);
        assert_true(seen[i].outside.x >= 2.0 && seen[i].outside.y >= 6.0);
    }
    instance.has_material = true; /* which mirrors, so that what the mesh emits is seen again */
    instance.material.reflection = 0.5;
    hd_seen_bounds(&scene, seen);
    expect_near(seen[0].outside.y, 6.0 / (1.0 - 0.5), 0.3);
}

TEST(depth_follows_the_strongest_ray) {
    HdScene scene = {.floor = {.present = true, .material = plain()}, .exposure = 2.0};
    HdMaterial *material = &scene.floor.material;
    material->ambient = 0.5;
    assert_int_equal(hd_depth_for_bound(&scene, 0.001), 1);
    material->reflection = 0.5; /* B = 1, after exposure 2: 2^-10 < 0.001 is left at depth 11 */
    assert_int_equal(hd_depth_for_bound(&scene, 0.001), 11);
    material->reflection = 1.0;
    assert_int_equal(hd_depth_for_bound(&scene, 0.001), HD_MAX_DEPTH);
}
