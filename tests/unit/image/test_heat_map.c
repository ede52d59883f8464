/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700

#include "image/difference.h"
#include "image/picture.h"
#include "test_folder.h"

/* Each doubling is lighter by 8.3 of CIE L*. */
TEST(errors_have_colours) {
    static const struct {
        double error;
        uint8_t rgb[3];
    } cases[] = {{0.2499, {0, 0, 0}},
                 {0.70710678118654752, {108, 24, 107}}, /* halfway to 1 */
                 {2.0, {164, 45, 95}},
                 {16.0, {243, 120, 25}},
                 {128.0, {247, 223, 90}},
                 {1e9, {252, 252, 156}},
                 {(double)INFINITY, {252, 252, 156}}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        uint8_t rgb[3];
        hd_heat_colour(cases[i].error, rgb);
        if (memcmp(rgb, cases[i].rgb, 3) != 0)
            fail_msg("%g has the colour %d %d %d", cases[i].error, rgb[0], rgb[1], rgb[2]);
    }
}

TEST(maps_are_pictures) {
    HdError error = {0};
    HdHeatMap *map;
    HdTexture texture;
    const double rows[2][3] = {{0.0, 1.0, 256.0}, {(double)NAN, 0.25, 4.0}};
    const int expected[] = {0, 0,   0,   127, 31, 106, 252, 252, 156, /* from the top */
                            0, 255, 255, 53,  10, 90,  198, 63,  76};
    assert_int_equal(hd_heat_map_open(&map, "maps/heat.png", 3, 2, &error), HD_OK);
    assert_int_equal(hd_heat_map_add_row(map, rows[0], &error), HD_OK);
    assert_int_equal(hd_heat_map_add_row(map, rows[1], &error), HD_OK);
    assert_int_equal(hd_heat_map_commit(map, &error), HD_OK);
    assert_int_equal(hd_texture_read(&texture, "maps/heat.png", HD_CURVE_LINEAR, &error), HD_OK);
    assert_int_equal(texture.width, 3);
    assert_int_equal(texture.height, 2);
    for (int i = 0; i < 18; i++)
        assert_int_equal(texture.texels[i], expected[i] * 257);
    hd_texture_clear(&texture);
    assert_int_equal(count_entries("maps"), 1);
}

TEST(maps_that_fail_leave_nothing) {
    HdError error = {0};
    HdHeatMap *map;
    assert_int_equal(hd_heat_map_open(&map, "none/heat.png", 2, 2, &error), HD_OK);
    assert_int_equal(count_entries("none"), 1);
    hd_heat_map_discard(map);
    hd_heat_map_discard(NULL);
    assert_int_equal(count_entries("none"), 0);
    write_bytes("file", "x", 1);
    assert_int_equal(hd_heat_map_open(&map, "file/heat.png", 2, 2, &error), HD_FAILED);
    expect_contains(error.message, "file/heat.png");
}
