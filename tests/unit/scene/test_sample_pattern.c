/* SPDX-License-Identifier: MIT */
#include "scene/sample_pattern.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/limits.h"
#include "base/trigonometry.h"
#include "unit_test.h"

enum { MAX_SIDE = HD_MAX_SAMPLES_PER_SIDE * HD_MAX_SAMPLES_PER_SIDE };

/* Row by row of the cells, each with one sample, and one in each column and row of the lattice. */
static void expect_multijitter(int columns, int rows) {
    static int places[MAX_SIDE];
    static bool has_column[MAX_SIDE], has_row[MAX_SIDE];
    const HdScene scene = {
        .sampling = HD_SAMPLING_MULTIJITTER, .samples_per_side = columns, .sample_rows = rows};
    const int count = hd_sample_count(&scene), cells = count / columns;
    assert_int_equal(cells, rows > 0 ? rows : columns);
    assert_int_equal(hd_sample_lattice(&scene), count);
    hd_sample_places(&scene, places);
    memset(has_column, 0, sizeof has_column);
    memset(has_row, 0, sizeof has_row);
    for (int i = 0; i < count; i++) {
        const int column = places[i] & 0xffff, row = places[i] >> 16;
        assert_int_equal(column / cells, i % columns);
        assert_int_equal(row / columns, i / columns);
        assert_false(has_column[column] || has_row[row]);
        has_column[column] = has_row[row] = true;
    }
}

TEST(cells_columns_and_rows_have_one_sample_each) {
    for (int n = 1; n <= HD_MAX_SAMPLES_PER_SIDE; n++)
        for (int rows = 0; rows <= HD_MAX_SAMPLES_PER_SIDE; rows += n)
            expect_multijitter(n, rows);
}

TEST(only_multijitter_has_rows) {
    HdScene scene = {.sampling = HD_SAMPLING_GRID, .samples_per_side = 3, .sample_rows = 2};
    int places[9];
    assert_int_equal(hd_sample_count(&scene), 9);
    assert_int_equal(hd_sample_lattice(&scene), 3);
    hd_sample_places(&scene, places);
    for (int i = 0; i < 9; i++)
        assert_int_equal(places[i], i % 3 | i / 3 << 16);
}

/* Number of hd_sample_places for HD_SAMPLING_REFERENCE. */
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
static double edge_error(const HdScene *scene) {
    enum { ANGLES = 720, MOST = 1024 };
    const int count = hd_sample_count(scene);
    int places[MOST];
    double along[MOST], worst = 0.0;
    assert_true(count <= MOST);
    hd_sample_places(scene, places);
    for (int k = 0; k < ANGLES; k++) {
        double sine, cosine;
        hd_sine_cosine(6.283185307179586 * k / ANGLES, &sine, &cosine);
        const double a = fabs(cosine), b = fabs(sine), side = hd_sample_lattice(scene);
        for (int i = 0; i < count; i++)
            along[i] = cosine * (((places[i] & 0xffff) + 0.5) / side - 0.5) +
                       sine * (((places[i] >> 16) + 0.5) / side - 0.5);
        qsort(along, (size_t)count, sizeof *along, compare);
        for (int i = 0; i < count; i++) {
            const double exact = share_below(fmax(a, b), fmin(a, b), along[i]);
            worst = fmax(worst, exact - (double)i / count);
            worst = fmax(worst, (double)(i + 1) / count - exact);
        }
    }
    return 255.0 * worst;
}

/* As docs/numerics.md states. */
TEST(dense_places_are_better_than_grids) {
    const HdScene dense = {.sampling = HD_SAMPLING_REFERENCE, .samples_per_side = 32},
                  grid = {.sampling = HD_SAMPLING_GRID, .samples_per_side = 32};
    const double of_dense = edge_error(&dense), of_grid = edge_error(&grid);
    assert_true(of_dense < REFERENCE_SAMPLE_ERROR);
    assert_true(of_dense > REFERENCE_SAMPLE_ERROR / 2.0);
    assert_true(of_grid > 1.2 * of_dense);
}
