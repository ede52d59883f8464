/* SPDX-License-Identifier: MIT */
#include "scene/light_bound.h"
#include "unit_test.h"

static HdMaterial plain(void) {
    return (HdMaterial){.colour = {1.0, 0.5, 0.0},
                        .mirror_tint = {1.0, 1.0, 1.0},
                        .shininess = 1,
                        .index_of_refraction = 1.0};
}

/* Expects a bound of at least the radiance, and not much more. */
static void expect_bound(HdVec3 bound, double x, double y, double z) {
    const double bounds[3] = {bound.x, bound.y, bound.z}, least[3] = {x, y, z};
    for (int i = 0; i < 3; i++)
        if (!(bounds[i] >= least[i] - 1e-12 && bounds[i] <= 1.021 * least[i]))
            fail_msg("channel %d: %.9g is no bound of %.9g", i, bounds[i], least[i]);
}

TEST(lights_add_up) {
    HdLight lights[2] = {{.intensity = {1.0, 2.0, 3.0}}, {.intensity = {0.5, 0.0, 0.25}}};
    HdSolid solid = {.kind = HD_HEXAHEDRON,
                     .lights = {.per_edge = 2,
                                .colour_count = 2,
                                .colours = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}},
                                .intensity = 0.1}};
    HdScene scene = {.light_count = 2, .lights = lights, .solid_count = 1, .solids = &solid};
    /* A cube has 12 edges: 6 of each colour, with 2 lights each. */
    expect_bound(hd_light_bound(&scene), 1.5 + 1.2, 2.0 + 1.2, 3.25);
    solid.lights.intensity = 0.0;
    expect_bound(hd_light_bound(&scene), 1.5, 2.0, 3.25);
    /* The brightest visible radiance counts. */
    solid.face = plain();
    solid.lights.disc_radiance = 8.0;
    solid.lights.colours[1] = (HdVec3){0.0, 0.25, 0.0};
    scene = (HdScene){.solid_count = 1, .solids = &solid, .background = {5.0, 0.0, 9.0}};
    expect_bound(hd_radiance_bound(&scene), 8.0, 2.0, 9.0);
    scene.environment = (HdEnvironment){.intensity = 2.0, .top = 3.0, .texture.width = 1};
    expect_bound(hd_radiance_bound(&scene), 11.0, 6.0, 15.0);
}

/* A surface's emission, by the share that it absorbs. */
TEST(mirrors_multiply) {
    HdScene scene = {.floor = {.present = true, .material = plain()}, .exposure = 1.0};
    HdMaterial *material = &scene.floor.material;
    material->ambient = 0.2;
    expect_bound(hd_radiance_bound(&scene), 0.2, 0.1, 0.0);
    material->reflection = 0.5;
    material->transmission = 0.25;
    expect_bound(hd_radiance_bound(&scene), 0.2 / (1.0 - 0.75), 0.1 / (1.0 - 0.5 - 0.125), 0.0);
    material->has_inner_side = true;
    material->inner_reflection = 0.9;
    expect_bound(hd_radiance_bound(&scene), 0.2 / (1.0 - 0.9), 0.1 / (1.0 - 0.9), 0.0);
    material->inner_reflection = 1.0; /* a mirror that reflects everything adds to the emission at
                                         the path's end */
    scene.background.x = 7.0;
    const double levels = HD_MAX_DEPTH + 1;
    expect_bound(hd_radiance_bound(&scene), 7.0 + 0.2 * levels, 0.1 * levels, 0.0);
    /* Under total reflection the mirror, whose tint is white, also reflects the transmitted
       part. */
    scene = (HdScene){.floor = {.present = true, .material = plain()}, .exposure = 1.0};
    material->ambient = 0.1;
    material->colour = (HdVec3){0.01, 0.01, 0.01};
    material->reflection = 0.1;
    material->transmission = 0.8;
    for (int i = 0; i < 2; i++) {
        const double bound = 0.001 / (1.0 - (i == 0 ? 0.108 : 0.9));
        expect_bound(hd_radiance_bound(&scene), bound, bound, bound);
        material->index_of_refraction = 2.0;
    }
}

/* Finds the bounds of a room of mirrors that is `apart` from another solid. */
static void see_two(HdScene *scene, double apart, HdSeen seen[4]) {
    scene->solid_count = 2;
    scene->solids[0] = (HdSolid){.kind = HD_HEXAHEDRON, .circumradius = 1.0, .face = plain()};
    scene->solids[0].face.ambient = 0.1;
    scene->solids[0].face.has_inner_side = true;
    scene->solids[0].face.inner_reflection = 0.5;
    scene->solids[1] = (HdSolid){.kind = HD_HEXAHEDRON, .circumradius = 1.0, .face = plain()};
    scene->solids[1].face.ambient = 4.0;
    scene->solids[1].centre.x = apart;
    hd_seen_bounds(scene, seen);
}

/* Inside a room only the room is visible, unless something reaches into it. */
TEST(bounds_cover_visible_radiance) {
    HdSolid solids[2];
    HdSeen seen[4];
    HdScene scene = {.solids = solids, .background = {0.5, 0.0, 0.0}};
    see_two(&scene, 1.154, seen); /* the faces are 1.1547 apart at the contact */
    expect_bound(seen[0].inside, 4.0, 2.0, 0.0);
    see_two(&scene, 1.155, seen);
    expect_bound(seen[0].inside, 4.0, 2.0, 0.0); /* this distance counts as the same place */
    see_two(&scene, 3.0, seen);
    expect_bound(seen[0].inside, 0.1 / (1.0 - 0.5), 0.05 / (1.0 - 0.5), 0.0);
    expect_bound(seen[0].outside, 4.0, 2.0, 0.0);
    expect_bound(seen[1].inside, 4.0, 2.0, 0.0);
    expect_bound(seen[1].outside, 0.5, 0.05, 0.0); /* never itself */
    scene.environment = (HdEnvironment){.intensity = 0.5, .top = 0.5, .texture.width = 1};
    hd_seen_bounds(&scene, seen);
    expect_bound(seen[1].outside, 0.75, 0.25, 0.25);
    scene.environment.texture.width = 0;
    hd_seen_bounds(&scene, seen);
    expect_bound(seen[2].outside, 4.0, 2.0, 0.0);
    solids[0].face.inner_transmission = 0.25;
    hd_seen_bounds(&scene, seen);
    expect_near(seen[0].inside.x, (0.1 + 0.25 * 4.0) / (1.0 - 0.5), 0.05);
    solids[0].lights = (HdEdgeLights){
        .per_edge = 1, .colour_count = 1, .colours = {{1.0, 1.0, 1.0}}, .disc_radiance = 3.0};
    hd_seen_bounds(&scene, seen);
    expect_bound(seen[0].inside, 3.0, 3.0, 3.0);
    scene.floor = (HdFloor){.present = true,
                            .corners = {{-4, 4, 0.5}, {4, 4, 0.5}, {4, -4, 0.5}, {-4, -4, 0.5}},
                            .material = plain()};
    scene.floor.material.ambient = 8.0;
    hd_seen_bounds(&scene, seen);
    expect_near(seen[0].inside.x, 8.0, 0.2);                           /* it cuts the room */
    expect_near(seen[2].outside.x, 0.1 + 0.5 * 8.0 + 0.25 * 8.0, 0.3); /* and is not hit twice */
}

/* Emission and reflection of meshes, with their own materials and with a place's. */
TEST(meshes_are_seen_from_all_sides) {
    HdMeshMaterial materials[2] = {{.material = plain(), .emission = {0.5, 6.0, 0.0}},
                                   {.material = plain(), .emission = {2.0, 0.0, 0.0}}};
    HdMesh mesh = {.material_count = 2, .materials = materials};
    HdInstance instance = {.material = plain()};
    HdSolid solids[2];
    HdSeen seen[4];
    HdScene scene = {.solids = solids,
                     .meshes = &mesh,
                     .mesh_count = 1,
                     .instances = &instance,
                     .instance_count = 1};
    see_two(&scene, 3.0, seen);
    solids[1].face.ambient = 1.0;
    hd_seen_bounds(&scene, seen);
    for (int i = 0; i < 4; i++) {
        expect_near(seen[i].outside.x, 2.0, 0.1);
        expect_bound(hd_vec3(0.0, seen[i].outside.y, seen[i].inside.y), 0.0, 6.0, 6.0);
    }
    instance.has_material = true; /* which mirrors, so that the mesh's emission is visible again */
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
