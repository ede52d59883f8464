/* SPDX-License-Identifier: MIT */
/* The jobs that a measurement applies to. */
#define _XOPEN_SOURCE 700
#include "choice/measure.h"

#include "fake_backend.h"
#include "test_folder.h"

static HdError error;
static HdTeamDevice devices[2];
static HdRenderOptions options;
static HdScene scene;
static HdSolid solid;
static HdLight lights[9];
static HdMesh mesh;

static int begin(void **state) {
    (void)state;
    setenv("HEDRON_CACHE", "cache", 1);
    options = (HdRenderOptions){0};
    for (int i = 0; i < 2; i++)
        devices[i] = (HdTeamDevice){.device = fake_device(), .seconds = 0.5 + i};
    solid = (HdSolid){.kind = HD_TETRAHEDRON};
    for (int i = 0; i < 9; i++)
        lights[i] = (HdLight){.falloff.end = 1.0};
    scene = (HdScene){.width = 4,
                      .height = 4,
                      .samples_per_side = 1,
                      .depth = 1,
                      .solids = &solid,
                      .solid_count = 1,
                      .lights = lights,
                      .meshes = &mesh,
                      .mesh_count = 1};
    return 0;
}

static int end(void **state) {
    (void)state;
    return remove_folder("cache");
}

static void put(void) {
    assert_int_equal(hd_measured_put(devices, 1, &options, &scene, &error), HD_OK);
}

static void expect_alike(bool is_alike) {
    HdTeamDevice found = {.device = devices[0].device};
    assert_int_equal(hd_measured_get(&found, 1, &options, &scene), is_alike);
}

/* Remembered under one number, recalled under another: both must round up to the same power of
   two. */
TEST(numbers_count_by_powers_of_two) {
    int *const numbers[] = {&scene.width,          &scene.height,      &scene.depth,
                            &scene.instance_count, &scene.light_count, &mesh.triangle_count};
    static const int pairs[][3] = {{5, 8, true},  {5, 9, false}, {5, 6, true}, {5, 4, false},
                                   {1, 2, false}, {0, 0, true},  {0, 2, false}};
    for (size_t i = 0; i < 6; i++)
        for (size_t k = 0; k < sizeof pairs / sizeof *pairs; k++) {
            const int kept = *numbers[i];
            *numbers[i] = pairs[k][0];
            put();
            *numbers[i] = pairs[k][1];
            expect_alike(pairs[k][2]);
            *numbers[i] = kept;
            remove_folder("cache");
        }
    scene.samples_per_side = 4;
    put();
    scene.samples_per_side = 2;
    expect_alike(false);
    scene.width *= 4;
    expect_alike(true);
}

/* Of 4, 6, 8 and 12. */
TEST(planes_count_by_powers_of_two) {
    static const HdSolidKind kinds[] = {HD_TETRAHEDRON, HD_HEXAHEDRON, HD_OCTAHEDRON,
                                        HD_DODECAHEDRON};
    solid.kind = HD_HEXAHEDRON;
    put();
    for (int k = 0; k < 4; k++) {
        solid.kind = kinds[k];
        expect_alike(k == 1 || k == 2);
    }
}

TEST(endless_lights_and_the_floor_count) {
    scene.light_count = 9;
    put();
    lights[3].falloff.end = lights[5].falloff.end = 0.0;
    expect_alike(false);
    put();
    scene.exposure = 2.0;
    lights[0].position.x = 0.75;
    expect_alike(true);
    scene.floor.present = true;
    expect_alike(false);
}

TEST(each_option_counts) {
    static const HdRenderOptions others[] = {{.precision = HD_PRECISION_DOUBLE},
                                             {.math = HD_MATH_FAST},
                                             {.pipeline = HD_PIPELINE_MEGA},
                                             {.lanes = 4},
                                             {.threads = 1},
                                             {.block = 64},
                                             {.grid = 2},
                                             {.has_deep_trees = true},
                                             {.launch_ms = 1.0}};
    put();
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        options = others[i];
        expect_alike(false);
    }
}

/* Not their numbers. */
TEST(all_devices_count_by_name_and_driver) {
    HdTeamDevice found[2] = {devices[0], devices[1]};
    devices[1].options = (HdRenderOptions){.pipeline = HD_PIPELINE_WAVEFRONT, .block = 64};
    devices[0].seconds = (double)INFINITY;
    assert_int_equal(hd_measured_put(devices, 2, &options, &scene, &error), HD_OK);
    found[0].device.index = 7;
    assert_true(hd_measured_get(found, 2, &options, &scene));
    assert_true(isinf(found[0].seconds) && found[1].seconds == 1.5);
    assert_memory_equal(&found[1].options, &devices[1].options, sizeof options);
    assert_false(hd_measured_get(found, 1, &options, &scene));
    snprintf(found[1].device.driver, sizeof found[1].device.driver, "driver 8");
    assert_false(hd_measured_get(found, 2, &options, &scene));
}

EACH(begin, end)
