/* SPDX-License-Identifier: MIT */
#include "truths.h"

void check_truths(const Target *target, int *checked, int *failed) {
    Check check = {.target = target,
                   .tolerance = target->precision == HD_PRECISION_FLOAT ? 3e-5 : 3e-7};
    check_first_hits(&check);
    check_geometry(&check);
    check_shading(&check);
    check_lights(&check);
    check_rotation(&check);
    check_refraction(&check);
    check_sides(&check);
    check_invariance(&check);
    *checked += check.checked;
    *failed += check.failed;
}
