/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700

#include "image/heat_map.h"
#include "image/picture.h"
#include "test_folder.h"

static void check_colour(double error, int red, int green, int blue) {
    uint8_t rgb[3];
    hd_heat_colour(error, rgb);
    assert_int_equal(rgb[0], red);
    assert_int_equal(rgb[1], green);
    assert_int_equal(rgb[2], blue);
}

TEST(named_errors_have_named_colours) {
    check_colour(0.0, 0, 0, 0);
    check_colour(0.2499, 0, 0, 0);
    check_colour(0.25, 53, 10, 90);
    check_colour(1.0, 127, 31, 106);
    check_colour(4.0, 198, 63, 76);
    check_colour(sqrt(0.5), 108, 24, 107); /* halfway from 1/2, 89 17 107, to 1 */
    check_colour(16.0, 243, 120, 25);
    check_colour(32.0, 250, 155, 13);
    check_colour(64.0, 249, 191, 41);
    check_colour(128.0, 247, 223, 90);
    check_colour(256.0, 252, 252, 156);
    check_colour(1e9, 252, 252, 156);
    check_colour((double)INFINITY, 252, 252, 156);
    check_colour((double)NAN, 0, 255, 255);
}

/* CIE L*, 0..100, of a colour on the sRGB curve. */
static double lightness(double error) {
    uint8_t rgb[3];
    const double weights[] = {0.2126, 0.7152, 0.0722};
    double luminance = 0.0;
    hd_heat_colour(error, rgb);
    for (int c = 0; c < 3; c++)
        luminance += weights[c] * hd_curve_to_linear(HD_CURVE_SRGB, rgb[c] / 255.0);
    return luminance > 216.0 / 24389.0 ? 116.0 * cbrt(luminance) - 16.0
                                       : luminance * 24389.0 / 27.0;
}

TEST(every_doubling_is_lighter_by_the_same) {
    double last = 0.0;
    for (int i = 0; i <= 160; i++) {
        const double now = lightness(0.25 * exp2(i / 16.0));
        expect_near(now, 14.0 + 8.3 * i / 16.0, 1.5);
        if (!(now > last))
            fail_msg("step %d is not lighter than the one before", i);
        last = now;
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
