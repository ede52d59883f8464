/* SPDX-License-Identifier: MIT */
#include "scene/triangulate.h"

#include <stdlib.h>

#include "unit_test.h"

static HdError error;
static HdScene scene;

static HdTexture texture_of(uint16_t first) {
    HdTexture texture = {.width = 2, .height = 1, .texels = calloc(6, sizeof(uint16_t))};
    for (int i = 0; i < 6; i++)
        texture.texels[i] = (uint16_t)(first + i);
    return texture;
}

/* Two solids, two meshes in three places, two pictures. */
static int begin(void **state) {
    (void)state;
    static const int placed[] = {1, 0, 1};
    scene = (HdScene){.solid_count = 2, .mesh_count = 2, .instance_count = 3, .picture_count = 2};
    scene.solids = calloc(2, sizeof *scene.solids);
    scene.meshes = calloc(2, sizeof *scene.meshes);
    scene.instances = calloc(3, sizeof *scene.instances);
    scene.pictures = calloc(2, sizeof *scene.pictures);
    for (int i = 0; i < 2; i++) {
        scene.solids[i] = (HdSolid){.kind = i == 0 ? HD_TETRAHEDRON : HD_HEXAHEDRON,
                                    .centre = {10.0 + i, 2.0, 3.0},
                                    .circumradius = 1.0,
                                    .lights = {.colour_count = 1}};
        HdMesh *mesh = &scene.meshes[i];
        assert_true(hd_mesh_allocate(mesh, 3, 1));
        mesh->materials = calloc(1, sizeof *mesh->materials);
        mesh->vertex_count = 3;
        mesh->triangle_count = mesh->material_count = 1;
        mesh->materials[0].picture = 1 - i;
        scene.pictures[i].texture = texture_of((uint16_t)(10 * i));
    }
    for (int i = 0; i < 3; i++)
        scene.instances[i] = (HdInstance){.mesh = placed[i], .position = {-1.0 - i, 0.0, 0.0}};
    return 0;
}

static int end(void **state) {
    (void)state;
    hd_scene_free(&scene);
    return 0;
}

static void add_floor(void) {
    scene.floor = (HdFloor){.present = true,
                            .corners = {{-4, 4, 1}, {4, 4, 1}, {4, -4, 1}, {-4, -4, 1}},
                            .texture = texture_of(100)};
}

/* The scene's own come after `made` others, and name each other as before. */
static void expect_own(int made) {
    assert_int_equal(scene.mesh_count, made + 2);
    assert_int_equal(scene.instance_count, made + 3);
    for (int i = 0; i < 3; i++) {
        assert_int_equal(scene.instances[made + i].mesh, made + (i == 1 ? 0 : 1));
        assert_true(scene.instances[made + i].position.x == -1.0 - i);
    }
    for (int i = 0; i < 2; i++) {
        assert_int_equal(scene.meshes[made + i].materials[0].picture, 1 - i);
        assert_int_equal(scene.pictures[i].texture.texels[0], 10 * i);
        assert_false(scene.pictures[i].is_clamped);
    }
}

TEST(solids_and_the_floor_precede_the_scenes_own) {
    add_floor();
    assert_int_equal(hd_scene_triangulate(&scene, 8, 2, &error), HD_OK);
    expect_own(3);
    assert_int_equal(scene.geometry, HD_GEOMETRY_TRIANGLES);
    for (int i = 0; i < 2; i++) {
        const HdInstance *instance = &scene.instances[i];
        assert_int_equal(instance->mesh, i);
        assert_true(instance->position.x == 10.0 + i && instance->position.y == 2.0);
        assert_true(instance->scale.x == 1.0 && instance->scale.z == 1.0);
        assert_int_equal(scene.meshes[i].triangle_count, i == 0 ? 16 : 48);
        assert_true(scene.meshes[i].tree.node_count > 0);
    }
    const HdInstance *floor = &scene.instances[2];
    assert_int_equal(floor->mesh, 2);
    assert_true(floor->position.x == 0.0 && floor->position.z == 1.0);
    assert_int_equal(scene.meshes[2].triangle_count, 8);
    assert_int_equal(scene.meshes[2].materials[0].picture, 2);
    assert_true(scene.meshes[2].materials[0].is_opaque_to_shadows);
    assert_int_equal(scene.picture_count, 3);
    assert_true(scene.pictures[2].is_clamped);
    assert_int_equal(scene.pictures[2].texture.width, 2);
    for (int i = 0; i < 6; i++)
        assert_int_equal(scene.pictures[2].texture.texels[i], 100 + i);
    assert_ptr_not_equal(scene.pictures[2].texture.texels, scene.floor.texture.texels);
}

TEST(a_failure_leaves_it_unchanged) {
    add_floor();
    hd_texture_clear(&scene.floor.texture);
    assert_int_equal(hd_scene_triangulate(&scene, 8, 8000, &error), HD_BAD_INPUT);
    expect_own(0);
    assert_int_equal(scene.geometry, HD_GEOMETRY_SOLIDS);
    assert_int_equal(hd_scene_triangulate(&scene, 8, 1, &error), HD_OK);
    expect_own(3);
    assert_int_equal(scene.picture_count, 2);
    assert_int_equal(scene.meshes[2].materials[0].picture, -1); /* a bare floor has none */
}

EACH(begin, end)
