/* SPDX-License-Identifier: MIT */
#include "expect.h"
#include "render/samples.h"

static void each_place_once(void **state) {
    (void)state;
    for (int side = 1; side <= 64; side++) {
        static unsigned char seen[64][64];
        HdSampleSet set;
        HdError error;
        memset(seen, 0, sizeof seen);
        assert_int_equal(hd_sample_set_grid(&set, side, &error), HD_OK);
        assert_int_equal(set.count, side * side);
        assert_int_equal(set.grid_side, side);
        for (int i = 0; i < set.count; i++) {
            int column = set.places[i] & 0xffff, row = set.places[i] >> 16;
            assert_in_range(column, 0, side - 1);
            assert_in_range(row, 0, side - 1);
            assert_int_equal(seen[row][column]++, 0);
        }
        hd_sample_set_free(&set);
    }
}

/* The first 4^k samples of a grid: one in each cell of a grid of their own. */
static void first_samples_are_spread(void **state) {
    (void)state;
    HdSampleSet set;
    HdError error;
    assert_int_equal(hd_sample_set_grid(&set, 16, &error), HD_OK);
    for (int side = 2; side <= 16; side *= 2) {
        unsigned char seen[16][16] = {{0}};
        for (int i = 0; i < side * side; i++) {
            int column = (set.places[i] & 0xffff) * side / 16;
            int row = (set.places[i] >> 16) * side / 16;
            assert_int_equal(seen[row][column]++, 0);
        }
    }
    hd_sample_set_free(&set);
}

static void first_sample_is_next_to_the_middle(void **state) {
    (void)state;
    for (int side = 1; side <= 64; side++) {
        HdSampleSet set;
        HdError error;
        assert_int_equal(hd_sample_set_grid(&set, side, &error), HD_OK);
        assert_int_equal(set.places[0] & 0xffff, (side - 1) / 2);
        assert_int_equal(set.places[0] >> 16, (side - 1) / 2);
        hd_sample_set_free(&set);
    }
}

/* An edge along a side of the pixel, seen by a grid: off by a whole row at most. */
static void error_of_a_grid_is_known(void **state) {
    (void)state;
    HdSampleSet set;
    HdError error;
    assert_int_equal(hd_sample_set_grid(&set, 4, &error), HD_OK);
    expect_near(hd_sample_set_error(&set, 1), 255.0 / 8.0, 1e-9);
    hd_sample_set_free(&set);
}

/* What docs/numerics.md says. */
static void dense_sets_are_better_than_grids(void **state) {
    (void)state;
    HdSampleSet dense, grid;
    HdError error;
    assert_int_equal(hd_sample_set_dense(&dense, 32, &error), HD_OK);
    assert_int_equal(hd_sample_set_grid(&grid, 32, &error), HD_OK);
    assert_int_equal(dense.count, 1024);
    double of_dense = hd_sample_set_error(&dense, 720), of_grid = hd_sample_set_error(&grid, 720);
    assert_true(of_dense < HD_REFERENCE_SAMPLE_ERROR);
    assert_true(of_dense > HD_REFERENCE_SAMPLE_ERROR / 2.0);
    assert_true(of_grid > 1.2 * of_dense);
    hd_sample_set_free(&dense);
    hd_sample_set_free(&grid);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_place_once),
        cmocka_unit_test(first_samples_are_spread),
        cmocka_unit_test(first_sample_is_next_to_the_middle),
        cmocka_unit_test(error_of_a_grid_is_known),
        cmocka_unit_test(dense_sets_are_better_than_grids),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
