/* SPDX-License-Identifier: MIT */
/* The operands of the arithmetic probe, and what plain C makes of them: the hard cases of each
   primitive by construction. Built for float and for double. */
#ifndef HD_VERIFY_PROBE_OPERANDS_H
#define HD_VERIFY_PROBE_OPERANDS_H

#include "device/backend.h"

/* Fills a batch of that precision with tuples number `start` and so on of an endless list. */
void hd_probe_operands_float(HdProbeBatch *batch, uint64_t start);
void hd_probe_operands_double(HdProbeBatch *batch, uint64_t start);

/* What the primitives make of a batch, in the C language's own words. Sums and counters, which
   must be 0 before the first batch, go on. */
void hd_probe_expect_float(const HdProbeBatch *batch, HdProbeResults *results);
void hd_probe_expect_double(const HdProbeBatch *batch, HdProbeResults *results);

#endif
