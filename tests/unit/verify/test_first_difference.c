/* SPDX-License-Identifier: MIT */
/* A device that is plain C with one fault. */
#define HD_DOUBLE 0
#include "render/backends.h"
#include "verify/first_difference.h"

#include "kernels/host/shared.h"
#include "unit_test.h"
#include "verify/golden.h"

static HdError error;
static void (*tamper)(const HdSceneTables *tables);

static HdStatus wrong_upload(void *renderer, const HdSceneTables *tables, HdError *e) {
    tamper(tables);
    return hd_backend_c.functions->upload(renderer, tables, e);
}

static void with_nothing(const HdSceneTables *tables) {
    (void)tables;
}

static void with_other_light(const HdSceneTables *tables) {
    Light *light = (Light *)tables->table[HD_TABLE_lights].data + 1;
    light->intensity[1] *= 1.125F;
}

static void with_other_mirrors(const HdSceneTables *tables) {
    ((Material *)tables->table[HD_TABLE_materials].data)->reflection *= 0.5F;
}

static void with_other_sky(const HdSceneTables *tables) {
    ((Header *)tables->table[HD_TABLE_header].data)->background[2] *= 2.0F;
}

static HdStatus build(const void *what, HdScene *scene, HdCamera *camera, HdError *e) {
    return hd_golden_build(what, scene, camera, e);
}

static const char *difference(const char *frame, void (*how)(const HdSceneTables *)) {
    static char text[512];
    HdRendererFunctions functions = *hd_backend_c.functions;
    HdBackend backend = hd_backend_c;
    HdDevice device;
    int count;
    tamper = how;
    functions.upload = wrong_upload;
    backend.functions = &functions;
    assert_int_equal(hd_backend_enumerate(&hd_backend_c, &device, 1, &count, &error), HD_OK);
    device.backend = &backend;
    const HdRenderOptions options = {.pipeline = HD_PIPELINE_MEGA};
    const HdMismatch mismatch = {&device, &options, &hd_golden_needs, build, hd_golden_find(frame)};
    assert_int_equal(hd_first_difference(&mismatch, text, sizeof text, &error), HD_OK);
    return text;
}

/* A fault of mirrors shows only after a reflection; one of the sky at once, in the corner. */
TEST(pixel_sample_and_depth_are_reported) {
    assert_string_equal(difference("tetrahedron", with_nothing),
                        "a second rendering equals that of plain C");
    expect_contains(difference("tetrahedron", with_other_mirrors), "depth 1 of the ray: ");
    assert_string_equal(difference("tetrahedron", with_other_sky),
                        "pixel 0, 0, sample 0, 0 of 2 x 2, depth 0 of the ray: "
                        "blue is 0x1.47ae14p-4, expected 0x1.47ae14p-5");
    expect_contains(difference("tetrahedron", with_other_light), "depth 0 of the ray: green is ");
    expect_contains(difference("one-pixel", with_other_mirrors), "pixel 0, 0, sample ");
    expect_contains(difference("crop-of-reference", with_other_light), "pixel ");
}

TEST(hashes_are_found_by_name_and_precision) {
    HdGoldenHashes one = {0}, two = {0};
    assert_true(hd_golden_find_hashes("tetrahedron", HD_PRECISION_FLOAT, &one));
    assert_true(hd_golden_find_hashes("tetrahedron", HD_PRECISION_DOUBLE, &two));
    assert_true(one.frame != 0 && one.first_hits != 0 && one.frame != one.first_hits);
    assert_true(one.frame != two.frame && one.first_hits != two.first_hits);
    assert_false(hd_golden_find_hashes("tetra", HD_PRECISION_FLOAT, &one));
    assert_false(hd_golden_find_hashes("", HD_PRECISION_FLOAT, &one));
}
