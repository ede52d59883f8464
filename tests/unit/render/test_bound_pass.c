/* SPDX-License-Identifier: MIT */
#include <math.h>

#include "render/bound_pass.h"
#include "unit_test.h"

static double srgb(double v) {
    v = v < 0.0 ? 0.0 : v > 1.0 ? 1.0 : v;
    return v <= 0.0031308 ? 12.92 * v : 1.055 * pow(v, 1.0 / 2.4) - 0.055;
}

static double linear(double v) {
    return v > 1.0 ? 1.0 : v;
}

/* A pixel's missing light within the budget shows by no more steps than that. */
TEST(budget_is_kept) {
    double (*const curves[])(double) = {[HD_CURVE_LINEAR] = linear, [HD_CURVE_SRGB] = srgb};
    for (int curve = 0; curve < 2; curve++) {
        double closest = 0.0;
        for (int trial = 0; trial < 19; trial++)
            for (int i = 0; i <= 20000; i++) {
                double steps = 0.01 * pow(1.7, trial);
                double v = i / 10000.0;
                double missing = hd_missing_allowed((HdCurve)curve, steps, v);
                double off = 255.0 * (curves[curve](v + missing) - curves[curve](v));
                assert_true(off <= steps * (1.0 + 1e-9));
                closest = off > closest * steps ? off / steps : closest;
                expect_near(hd_missing_steps((HdCurve)curve, missing, v), off, 1e-4);
            }
        assert_true(closest > 0.9); /* nor is it far too strict */
    }
}
