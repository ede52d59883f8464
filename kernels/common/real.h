/* SPDX-License-Identifier: MIT */
/* Lanes and precision of a build. A source includes a language before any file of this folder:
   kernels/NAME/dialect.h, cpu/dialect.h or, on hosts, kernels/host/. */
#ifndef HD_REAL_H
#define HD_REAL_H

#ifndef FN
#error "include the dialect of a language before kernels/common/"
#endif

#ifndef HD_LANES
#define HD_LANES 1
#endif
#ifndef HD_DOUBLE
#define HD_DOUBLE 0
#endif

#define HD_PASTE_(a, b) a##b
#define HD_PASTE(a, b)  HD_PASTE_(a, b)

/* Makes a literal of type `real`: a plain one is a double, which slows the float build. */
#if HD_DOUBLE
typedef double real;
#define R(literal) literal
#else
typedef float real;
#define R(literal) HD_PASTE(literal, f)
#endif

/* Larger than any distance of a scene; means "none" in searches for a minimum. */
#define REAL_LARGE R(1e30)

#endif
