/* SPDX-License-Identifier: MIT */
/* Makes the operands of the arithmetic probe, the hard cases of each primitive, and their results
   in plain C. Built for float and for double. */
#ifndef HD_VERIFY_PROBE_OPERANDS_H
#define HD_VERIFY_PROBE_OPERANDS_H

#include "device/backend.h"

/* Fills a batch of that precision with the tuples from number `start` on of an endless list. */
void hd_probe_operands_float(HdProbeBatch *batch, uint64_t start);
void hd_probe_operands_double(HdProbeBatch *batch, uint64_t start);

/* Computes the primitives of a batch in plain C. Accumulates sums and counters, which must be 0
   before the first batch. */
void hd_probe_expect_float(const HdProbeBatch *batch, HdProbeResults *results);
void hd_probe_expect_double(const HdProbeBatch *batch, HdProbeResults *results);

#endif
