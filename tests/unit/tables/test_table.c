/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L /* setenv */
#include "render/backends.h"
#include "tables/table.h"

#include <limits.h>
#include <stdlib.h>

#include "device/renderer.h"
#include "kernels/host/shared.h"
#include "small_scene.h"
#include "unit_test.h"
#include "wrapped.h"

static size_t max_allowed = SIZE_MAX;

static void *allocate(size_t bytes) {
    return bytes <= max_allowed ? real_hd_large_allocate(bytes) : NULL;
}

REPLACE(hd_large_allocate, allocate)

static HdError error;
static const HdMemoryBudget device = {
    .name = "Device", .advice = "do this", .memory = 4e9, .at_once = 1e9};

TEST(bytes_are_printed_briefly) {
    static const struct {
        double bytes;
        const char *text;
    } rows[] = {{999.0, "999 bytes"}, {1000.0, "1.00 kB"},  {99960.0, "100 kB"},
                {48e6, "48.0 MB"},    {999.7e6, "1.00 GB"}, {12e12, "12.0 TB"}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char text[HD_BYTE_TEXT_SIZE];
        hd_byte_text(rows[i].bytes, text);
        assert_string_equal(text, rows[i].text);
    }
}

static void expect_room(size_t triangles, size_t nodes, const HdMemoryBudget *room,
                        const char *message) {
    HdSceneTables tables = {.table_count = HD_SCENE_TABLE_COUNT};
    tables.table[HD_TABLE_triangles].bytes = triangles;
    tables.table[HD_TABLE_mesh_nodes].bytes = nodes;
    const HdStatus status = hd_check_budget(&tables, room, &error);
    assert_int_equal(status, message == NULL ? HD_OK : HD_UNAVAILABLE);
    if (message != NULL)
        assert_string_equal(error.message, message);
}

TEST(tables_may_be_too_large) {
    const HdMemoryBudget unknown = {.name = "Device", .advice = ""};
    expect_room(1000000000, 1000000000, &device, NULL);
    expect_room(SIZE_MAX / 2, 0, &unknown, NULL);
    expect_room(900000000, 1000000001, &device,
                "the scene's nodes over triangles need 1.00 GB in one buffer; Device allows 1.00 "
                "GB of its 4.00 GB; do this");
    expect_room(2500000000, 1500000001, &device,
                "the scene's tables need 4.00 GB, 2.50 GB of them for its triangles; Device has "
                "4.00 GB; do this");
}

static HdScene scene_with_meshes(void) {
    HdScene scene;
    assert_int_equal(small_scene(&scene, "plain-instances", &error), HD_OK);
    return scene;
}

TEST(every_table_has_a_name) {
    for (int i = 0; i < HD_SCENE_TABLE_COUNT; i++) {
        assert_non_null(hd_scene_table_content(i));
        for (int k = 0; k < i; k++)
            assert_string_not_equal(hd_scene_table_content(i), hd_scene_table_content(k));
    }
}

/* The meshes' claimed contents are never read. */
TEST(a_scene_may_be_too_large_for_the_machine) {
    enum { MANY = 1000 };
    HdScene scene = scene_with_meshes();
    HdSceneTables tables;
    HdMesh many[MANY], *own = scene.meshes;
    for (int i = 0; i < MANY; i++) {
        many[i] = own[0];
        many[i].normal_count = INT_MAX / 4 * 3;
    }
    int count = scene.mesh_count;
    scene.meshes = many;
    scene.mesh_count = MANY;
    assert_int_equal(hd_compile_scene(&tables, &scene, HD_PRECISION_DOUBLE, 1, &error),
                     HD_UNAVAILABLE);
    expect_contains(error.message,
                    "the scene's tables need 51.5 TB, 51.5 TB of them for its normals; "
                    "this machine has ");
    expect_contains(error.message, "fewer triangles need less");
    scene.meshes = own;
    scene.mesh_count = count;
    /* An allocation within the capacity succeeds. */
    const int triangles = own[1].triangle_count;
    scene.accel = HD_ACCEL_BRUTE;
    own[1].triangle_count = 20000000;
    max_allowed = 900000000;
    const HdStatus status = hd_compile_scene(&tables, &scene, HD_PRECISION_FLOAT, 1, &error);
    max_allowed = SIZE_MAX;
    own[1].triangle_count = triangles;
    hd_scene_free(&scene);
    assert_int_equal(status, HD_FAILED);
    assert_string_equal(error.message, "out of memory: the scene's triangles need 960 MB");
}

/* PoCL reports as little memory as requested, and allows a quarter of it at once. */
TEST(opencl_reports_too_large_tables) {
    HdDevice devices[HD_MAX_DEVICES];
    HdRenderOptions options = {.lanes = 1};
    HdRenderer *renderer;
    HdSceneTables tables;
    int count = 0, found = -1;
    setenv("POCL_MEMORY_LIMIT", "1", 1);
    hd_backend_enumerate(&hd_backend_opencl, devices, HD_MAX_DEVICES, &count, &error);
    for (int i = 0; i < count; i++)
        if (strstr(devices[i].driver, "PoCL") != NULL ||
            strstr(devices[i].driver, "Portable Computing") != NULL)
            found = i;
    if (found < 0)
        skip();
    HdScene scene = scene_with_meshes();
    assert_int_equal(hd_compile_scene(&tables, &scene, HD_PRECISION_FLOAT, 1, &error), HD_OK);
    assert_int_equal(hd_renderer_open(&renderer, &devices[found], &options, &error), HD_OK);
    tables.table[HD_TABLE_triangles].bytes = 300000000; /* never read */
    HdStatus status = hd_renderer_upload(renderer, &tables, &error);
    hd_renderer_close(renderer);
    hd_scene_tables_free(&tables);
    hd_scene_free(&scene);
    assert_int_equal(status, HD_UNAVAILABLE);
    expect_contains(error.message, "opencl: the scene's triangles need 300 MB in one buffer; ");
    expect_contains(error.message, " allows 268 MB of its 1.07 GB; try fewer triangles, ");
}

TEST(textures_end_where_kernels_count_no_further) {
    HdPicture pictures[] = {{.texture = {.width = 1 << 15, .height = 1 << 14}},
                            {.texture = {.width = 1 << 15, .height = 1 << 14}}};
    HdScene scene = {.picture_count = 2, .pictures = pictures};
    HdSceneTables tables;
    assert_int_equal(hd_compile_scene(&tables, &scene, HD_PRECISION_FLOAT, 1, &error),
                     HD_BAD_INPUT);
    assert_string_equal(error.message, "the scene's textures have 1073840130 texels, expected at "
                                       "most 1073741822");
}

/* Each level of a ray's tree adds the light on a surface, and the exposure scales all. */
TEST(deeper_trees_leave_out_more) {
    HdScene scene = scene_with_meshes();
    scene.exposure = 1.0;
    scene.depth = 0;
    const double flat = hd_max_left_out(&scene);
    scene.depth = 1;
    const double level = hd_max_left_out(&scene) - flat;
    assert_true(level > 0.0 && flat >= level);
    scene.depth = 10;
    scene.exposure = 4.0;
    expect_near(hd_max_left_out(&scene), 4.0 * (flat + 10.0 * level), 1e-9 * flat);
    hd_scene_free(&scene);
}
