/* SPDX-License-Identifier: MIT */
#include "certify/golden.h"

#include "unit_test.h"

TEST(precisions_and_names_are_told_apart) {
    HdGoldenHashes hashes[2];
    for (int p = HD_PRECISION_FLOAT; p <= HD_PRECISION_DOUBLE; p++) {
        hashes[p] = (HdGoldenHashes){0};
        assert_true(hd_golden_find_hashes("tetrahedron", (HdPrecision)p, &hashes[p]));
        assert_true(hashes[p].frame != 0 && hashes[p].first_hits != 0);
        assert_true(hashes[p].frame != hashes[p].first_hits);
    }
    assert_true(hashes[0].frame != hashes[1].frame && hashes[0].first_hits != hashes[1].first_hits);
    static const char *const others[] = {"tetra", "hedron", ""};
    for (int i = 0; i < 3; i++)
        assert_false(hd_golden_find_hashes(others[i], HD_PRECISION_FLOAT, &hashes[0]));
}
