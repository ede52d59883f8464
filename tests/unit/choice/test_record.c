/* SPDX-License-Identifier: MIT */
/* Which jobs a measurement serves. */
#define _XOPEN_SOURCE 700
#include "choice/record.h"

#include "test_folder.h"

static HdError error;
static HdRenderOptions options;
static HdScene scene;
static HdSolid solid;
static HdLight lights[9];
static HdMesh mesh;

static int begin(void **state) {
    (void)state;
    setenv("HEDRON_CACHE", "cache", 1);
    options = (HdRenderOptions){0};
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
    remove_folder("cache");
    return 0;
}

static void put(void) {
    assert_int_equal(hd_record_put("test", &scene, &options, "", "x", &error), HD_OK);
}

static void expect_alike(bool is_alike) {
    char text[16];
    assert_int_equal(hd_record_get("test", &scene, &options, "", text, sizeof text), is_alike);
}

/* Remembered under the number `from`, recalled under others: the powers of two that they are
   rounded up to decide. */
static void expect_rounded(int *number) {
    const int kept = *number;
    static const struct {
        int from, alike, other;
    } cases[] = {{5, 8, 9}, {5, 6, 4}, {1, 1, 2}, {0, 0, 2}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        *number = cases[i].from;
        put();
        expect_alike(true);
        *number = cases[i].alike;
        expect_alike(true);
        *number = cases[i].other;
        expect_alike(false);
        *number = kept;
        remove_folder("cache");
    }
}

TEST(numbers_count_by_powers_of_two) {
    expect_rounded(&scene.width);
    expect_rounded(&scene.height);
    expect_rounded(&scene.depth);
    expect_rounded(&scene.instance_count);
    expect_rounded(&scene.light_count);
    expect_rounded(&mesh.triangle_count);
}

TEST(samples_are_squares) {
    scene.samples_per_side = 4;
    put();
    scene.samples_per_side = 2;
    expect_alike(false);
    scene.width *= 4;
    expect_alike(true);
}

TEST(planes_count_by_powers_of_two) {
    static const HdSolidKind kinds[] = {HD_TETRAHEDRON, HD_HEXAHEDRON, HD_OCTAHEDRON,
                                        HD_DODECAHEDRON};
    static const int powers[] = {2, 3, 3, 4}; /* of 4, 6, 8, 12 planes */
    for (int i = 0; i < 4; i++) {
        solid.kind = kinds[i];
        put();
        for (int k = 0; k < 4; k++) {
            solid.kind = kinds[k];
            expect_alike(powers[i] == powers[k]);
        }
        remove_folder("cache");
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

TEST(devices_and_kinds_are_told_apart) {
    char text[16], lines[3000];
    memset(lines, 'a', sizeof lines);
    lines[sizeof lines - 1] = '\0';
    assert_int_equal(hd_record_put("test", &scene, &options, lines, "x", &error), HD_OK);
    assert_true(hd_record_get("test", &scene, &options, lines, text, sizeof text));
    assert_string_equal(text, "x");
    assert_false(hd_record_get("tests", &scene, &options, lines, text, sizeof text));
    lines[sizeof lines - 2] = 'b';
    assert_false(hd_record_get("test", &scene, &options, lines, text, sizeof text));
}

EACH(begin, end)
