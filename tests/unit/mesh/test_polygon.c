/* SPDX-License-Identifier: MIT */
#include <stdlib.h>

#include "base/trigonometry.h"
#include "mesh/mesh.h"
#include "unit_test.h"

enum { MOST = HD_MAX_CONCAVE_CORNERS };

static HdVec3 corners[MOST];
static int32_t triangles[MOST][3];

/* Returns a vector of twice its area's length. */
static HdVec3 normal_of(const int32_t triangle[3]) {
    const HdVec3 a = corners[triangle[0]];
    return hd_cross(hd_sub(corners[triangle[1]], a), hd_sub(corners[triangle[2]], a));
}

static double area_of(int count) {
    double sum = 0.0;
    for (int i = 0; i < count; i++)
        sum += hd_length(normal_of(triangles[i])) / 2.0;
    return sum;
}

/* Puts a flat outline, begun at its corner `first`, into a plane, rotated so that each axis has its
   turn. */
static void set_outline(const double (*outline)[2], int count, int first, int turn,
                        bool is_reversed) {
    for (int i = 0; i < count; i++) {
        const int k = (i + first) % count;
        const double *at = outline[is_reversed ? count - 1 - k : k];
        const HdVec3 flat[3] = {
            {at[0], at[1], 0.1 * at[0]}, {0.1 * at[0], at[0], at[1]}, {at[1], 0.1 * at[0], at[0]}};
        corners[i] = flat[turn];
    }
}

/* Expects every triangle to have the polygon's orientation, and all together its area: so they do
   not overlap. */
static void expect_cut_from(const double (*outline)[2], int count, int first, double area) {
    for (int i = 0; i < 6; i++) {
        const int turn = i / 2;
        const bool is_reversed = i % 2 != 0;
        set_outline(outline, count, first, turn, is_reversed);
        assert_true(hd_polygon_cut(corners, count, triangles));
        expect_near(area_of(count - 2), area * sqrt(1.01), 1e-12 * area);
        for (int k = 0; k < count - 2; k++) {
            const HdVec3 normal = normal_of(triangles[k]);
            const double sense = turn == 0 ? normal.z : turn == 1 ? normal.x : normal.y;
            assert_true(is_reversed ? sense < 0.0 : sense > 0.0);
        }
    }
}

static void expect_cut(const double (*outline)[2], int count) {
    double area = 0.0;
    for (int i = 0; i < count; i++) {
        const double *a = outline[i], *b = outline[(i + 1) % count];
        area += (a[0] * b[1] - a[1] * b[0]) / 2.0;
    }
    for (int first = 0; first < count && first < (count <= 20 ? 20 : 1); first++)
        expect_cut_from(outline, count, first, area);
}

/* x and y of each corner; the first two are convex. */
static const char *const outlines[] = {
    "0 0  2 0  2 2  0 2",
    "1 0  3 0  4 2  3 4  1 4  0 2",
    /* An arrow, a U, a spiral. */
    "0 0  4 -2  1 0  4 2",
    "0 0  3 0  3 3  2 3  2 1  1 1  1 3  0 3",
    "0 0  7 0  7 7  0 7  0 6  6 6  6 1  1 1  1 4  4 4  4 3  2 3  2 2  5 2  5 5  0 5",
    /* A square with a square hole, to which a bridge leads: two places come up twice. */
    "0 0  4 0  4 4  0 4  0 0  1 1  1 3  3 3  3 1  1 1",
    /* A bridge whose ends bend inwards. */
    "0 0  2 24  19 5  20 1  18 11  10 17  3 25  6 22  10 17  18 11  30 0  0 30  1 14",
    /* A corner in the middle of a side: no triangle may be flat. */
    "0 0  1 0  2 0  2 2  0 2",
    "0 0  1.5 0  3 0  3 3  2 3  2 1  1 1  1 3  0 3",
};

TEST(polygons_are_cut_and_convex_ones_become_fans) {
    for (size_t i = 0; i < sizeof outlines / sizeof *outlines; i++) {
        double outline[16][2];
        int count = 0;
        for (char *at = (char *)outlines[i]; *at != '\0'; count++) {
            outline[count][0] = strtod(at, &at);
            outline[count][1] = strtod(at, &at);
        }
        expect_cut((const double(*)[2])outline, count);
        set_outline((const double(*)[2])outline, count, 0, 0, false);
        assert_true(hd_polygon_cut(corners, count, triangles));
        for (int k = 0; k < count - 2 && i < 2; k++) {
            const int32_t expected[3] = {0, k + 1, k + 2};
            assert_memory_equal(triangles[k], expected, sizeof expected);
        }
    }
}

/* Stars of few and of the most corners, whose radius alternates: they are fans of no corner. */
TEST(large_stars_are_cut) {
    static double outline[MOST][2];
    for (int count = 10; count <= MOST; count += MOST - 10) {
        for (int i = 0; i < count; i++) {
            const double angle = 2.0 * HD_PI * i / count, radius = i % 2 ? 1.0 : 2.0;
            outline[i][0] = radius * cos(angle);
            outline[i][1] = radius * sin(angle);
        }
        expect_cut((const double(*)[2])outline, count);
    }
}

/* For any corners the number of triangles is right, and their corners exist. */
TEST(degenerate_polygons_are_cut_somehow) {
    uint32_t seed = 1;
    for (int round = 0; round < 3000; round++) {
        const int count = 4 + round % 40, size = 2 + round % 7;
        for (int i = 0; i < count; i++) {
            double at[3];
            for (int k = 0; k < 3; k++) {
                seed = seed * 1664525u + 1013904223u;
                at[k] = (double)((seed >> 16) % (uint32_t)size);
            }
            corners[i] = hd_vec3(at[0], at[1], round % 2 ? at[2] : 0.0);
        }
        memset(triangles, -1, sizeof triangles);
        assert_true(hd_polygon_cut(corners, count, triangles));
        for (int i = 0; i < count - 2; i++)
            for (int k = 0; k < 3; k++)
                assert_in_range(triangles[i][k], 0, count - 1);
        assert_int_equal(triangles[count - 2][0], -1);
    }
}
