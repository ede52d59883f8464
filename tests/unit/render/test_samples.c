/* SPDX-License-Identifier: MIT */
#include <stdlib.h>

#include "base/trigonometry.h"
#include "render/bound_pass.h"
#include "unit_test.h"

static HdError error;

/* Number of hd_sample_set_dense (mean.h). */
#define REFERENCE_SAMPLE_ERROR 2.2

static int compare(const void *a, const void *b) {
    const double *first = a, *second = b;
    return (*first > *second) - (*first < *second);
}

static double part(double a) {
    return a > 0.0 ? a * a : 0.0;
}

/* Returns the share of the unit square about 0 with a x + b y <= d, for a >= b >= 0, a > 0. */
static double share_below(double a, double b, double d) {
    double outer = 0.5 * (a + b), inner = 0.5 * (a - b);
    if (b < 1e-9)
        return d <= -outer ? 0.0 : d >= outer ? 1.0 : d / a + 0.5;
    double area = part(d + outer) - part(d + inner) - part(d - inner) + part(d - outer);
    return area / (2.0 * a * b);
}

/* Returns the set's greatest error on an edge between black and white at any place and angle, in
   steps of 255 on the linear curve. It tries many directions of the edge, a full turn, each at
   every place where the share changes. */
static double edge_error(const HdSampleSet *set) {
    enum { ANGLES = 720, MOST = 1024 };
    double along[MOST], worst = 0.0;
    assert_true(set->count <= MOST);
    for (int k = 0; k < ANGLES; k++) {
        double sine, cosine;
        hd_sine_cosine(6.283185307179586 * k / ANGLES, &sine, &cosine);
        const double a = fabs(cosine), b = fabs(sine), side = set->grid_side;
        for (int i = 0; i < set->count; i++)
            along[i] = cosine * (((set->places[i] & 0xffff) + 0.5) / side - 0.5) +
                       sine * (((set->places[i] >> 16) + 0.5) / side - 0.5);
        qsort(along, (size_t)set->count, sizeof *along, compare);
        for (int i = 0; i < set->count; i++) {
            const double exact = share_below(fmax(a, b), fmin(a, b), along[i]);
            worst = fmax(worst, exact - (double)i / set->count);
            worst = fmax(worst, (double)(i + 1) / set->count - exact);
        }
    }
    return 255.0 * worst;
}

TEST(a_grid_has_each_place_once_and_begins_next_to_the_middle) {
    for (int side = 1; side <= 64; side++) {
        static unsigned char seen[64][64];
        HdSampleSet set;
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
        assert_int_equal(set.places[0], (side - 1) / 2 * 0x10001);
        /* The first 4^k samples: one in each cell of a grid of their own. */
        for (int cells = 2; side == 16 && cells <= side; cells *= 2) {
            memset(seen, 0, sizeof seen);
            for (int i = 0; i < cells * cells; i++)
                assert_int_equal(seen[(set.places[i] >> 16) * cells / side]
                                     [(set.places[i] & 0xffff) * cells / side]++,
                                 0);
        }
        hd_sample_set_free(&set);
    }
}

/* As docs/numerics.md states. */
TEST(dense_sets_are_better_than_grids) {
    HdSampleSet dense, grid;
    assert_int_equal(hd_sample_set_dense(&dense, 32, &error), HD_OK);
    assert_int_equal(hd_sample_set_grid(&grid, 32, &error), HD_OK);
    assert_int_equal(dense.count, 1024);
    double of_dense = edge_error(&dense), of_grid = edge_error(&grid);
    assert_true(of_dense < REFERENCE_SAMPLE_ERROR);
    assert_true(of_dense > REFERENCE_SAMPLE_ERROR / 2.0);
    assert_true(of_grid > 1.2 * of_dense);
    hd_sample_set_free(&dense);
    hd_sample_set_free(&grid);
}
