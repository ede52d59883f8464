/* SPDX-License-Identifier: MIT */
/* What the probe found of a device's arithmetic (verify/probe.h), kept in the cache folder by the
   device's name, its driver, the kernels and the version of this program. */
#ifndef HD_DEVICE_ARITHMETIC_H
#define HD_DEVICE_ARITHMETIC_H

#include <stdbool.h>

#include "tables/table.h"

typedef struct HdArithmetic {
    bool rounds_by_fma;   /* division and roots are right only if they are made of fma */
    char difference[512]; /* what was wrong first; "": nothing was */
} HdArithmetic;

void hd_arithmetic_remember(const char *device, const char *driver, HdPrecision precision,
                            const HdArithmetic *found);

/* False where nothing is remembered. */
bool hd_arithmetic_recall(const char *device, const char *driver, HdPrecision precision,
                          HdArithmetic *known);

#endif
