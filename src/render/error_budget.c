/* SPDX-License-Identifier: MIT */
#include "render/error_budget.h"

/* sRGB: 1 / f' is 1 / 12.92 = 0.0774 up to 0.0031308, and then 2.2749 v^0.5833, which is concave:
   the line 0.0705 + 2.2 v is below both at their ends, 0.0774 at 0.0031308 and 2.2749 at 1. */
HdErrorBudget hd_error_budget(HdCurve curve) {
    return curve == HD_CURVE_SRGB ? (HdErrorBudget){0.0705 / 255.0, 2.2 / 255.0}
                                  : (HdErrorBudget){1.0 / 255.0, 0.0};
}

static double of_one_step(const HdErrorBudget *budget, double radiance) {
    return budget->floor + budget->slope * (radiance > 0.0 ? radiance : 0.0);
}

double hd_error_budget_radiance(const HdErrorBudget *budget, double steps, double radiance) {
    return steps * of_one_step(budget, radiance);
}

double hd_error_budget_steps(const HdErrorBudget *budget, double missing, double radiance) {
    return missing / of_one_step(budget, radiance);
}
