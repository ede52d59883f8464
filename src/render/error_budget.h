/* SPDX-License-Identifier: MIT */
/* How much may be missing from a pixel's radiance before its picture is off by so many steps of
   255: on the linear curve the same everywhere, on sRGB's less where it is dark. */
#ifndef HD_RENDER_ERROR_BUDGET_H
#define HD_RENDER_ERROR_BUDGET_H

#include "image/curve.h"

/* floor + slope * radiance for a step, times the number of steps. It never exceeds what is allowed:
   the curve f grows by at most e where radiance grows by no more than e / f', for f is concave; and
   1 / f' is above the straight line (docs/numerics.md). Being linear, it holds for the mean of
   samples if it holds for each of them. */
typedef struct HdErrorBudget {
    double floor, slope;
} HdErrorBudget;

HdErrorBudget hd_error_budget(HdCurve curve);

/* The radiance that may be missing for `steps` of 255, of a pixel or sample whose darkest channel
   has `radiance`, after exposure. */
double hd_error_budget_radiance(const HdErrorBudget *budget, double steps, double radiance);

/* The way back: by how many steps at most the picture is off where `missing` is missing. */
double hd_error_budget_steps(const HdErrorBudget *budget, double missing, double radiance);

#endif
