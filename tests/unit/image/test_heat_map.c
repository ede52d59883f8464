/* SPDX-License-Identifier: MIT */
#include "image/difference.h"
#include "unit_test.h"

/* Each doubling is lighter by 8.3 of CIE L*. */
TEST(errors_have_colours) {
    static const struct {
        double error;
        uint8_t rgb[3];
    } cases[] = {
        {0.2499, {0, 0, 0}},          {0.70710678118654752, {108, 24, 107}}, /* halfway to 1 */
        {2.0, {164, 45, 95}},         {16.0, {243, 120, 25}},
        {128.0, {247, 223, 90}},      {1e9, {252, 252, 156}},
        {(double)NAN, {0, 255, 255}}, {(double)INFINITY, {252, 252, 156}}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        uint8_t rgb[3];
        hd_heat_colour(cases[i].error, rgb);
        if (memcmp(rgb, cases[i].rgb, 3) != 0)
            fail_msg("%g has the colour %d %d %d", cases[i].error, rgb[0], rgb[1], rgb[2]);
    }
}
