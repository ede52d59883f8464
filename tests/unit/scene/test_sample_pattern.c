/* SPDX-License-Identifier: MIT */
#include "scene/sample_pattern.h"

#include <string.h>

#include "base/limits.h"
#include "unit_test.h"

enum { MAX_SIDE = HD_MAX_SAMPLES_PER_SIDE * HD_MAX_SAMPLES_PER_SIDE };

/* Row by row of the cells, each with one sample, and one in each column and row of the lattice. */
TEST(cells_columns_and_rows_have_one_sample_each) {
    static int places[MAX_SIDE];
    static bool has_column[MAX_SIDE], has_row[MAX_SIDE];
    for (int n = 1; n <= HD_MAX_SAMPLES_PER_SIDE; n++) {
        hd_multijitter(n, places);
        memset(has_column, 0, sizeof has_column);
        memset(has_row, 0, sizeof has_row);
        for (int i = 0; i < n * n; i++) {
            const int column = places[i] & 0xffff, row = places[i] >> 16;
            assert_int_equal(column / n, i % n);
            assert_int_equal(row / n, i / n);
            assert_false(has_column[column] || has_row[row]);
            has_column[column] = has_row[row] = true;
        }
    }
}
