/* SPDX-License-Identifier: MIT */
#include "certify/golden.h"

#include "unit_test.h"

static HdError error;

TEST(every_frame_has_one_line) {
    int lines = 0;
    for (const char *at = hd_golden_text(); *at != '\0'; at++)
        lines += *at == '\n';
    assert_int_equal(lines, hd_golden_frame_count);
    for (int i = 0; i < hd_golden_frame_count; i++)
        for (int p = HD_PRECISION_FLOAT; p <= HD_PRECISION_DOUBLE; p++) {
            HdGoldenHashes hashes = {0};
            assert_true(hd_golden_find_hashes(hd_golden_frames[i].name, (HdPrecision)p, &hashes));
            assert_int_not_equal(hashes.frame, 0);
            assert_int_not_equal(hashes.first_hits, 0);
        }
}

TEST(precisions_and_names_are_told_apart) {
    HdGoldenHashes single, both, unknown;
    assert_true(hd_golden_find_hashes("tetrahedron", HD_PRECISION_FLOAT, &single));
    assert_true(hd_golden_find_hashes("tetrahedron", HD_PRECISION_DOUBLE, &both));
    assert_true(single.frame != both.frame && single.first_hits != both.first_hits);
    assert_true(single.frame != single.first_hits);
    assert_false(hd_golden_find_hashes("tetra", HD_PRECISION_FLOAT, &unknown));
    assert_false(hd_golden_find_hashes("hedron", HD_PRECISION_FLOAT, &unknown));
    assert_false(hd_golden_find_hashes("", HD_PRECISION_FLOAT, &unknown));
}

TEST(every_frame_is_built) {
    for (int i = 0; i < hd_golden_frame_count; i++) {
        HdScene scene;
        HdCamera camera;
        assert_int_equal(hd_golden_build(&hd_golden_frames[i], &scene, &camera, &error), HD_OK);
        assert_true(scene.width > 0);
        hd_scene_free(&scene);
    }
}
