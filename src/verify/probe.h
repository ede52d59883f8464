/* SPDX-License-Identifier: MIT */
/* Measures whether a device's arithmetic is strict. Runs every primitive of the kernels' dialect on
   operands that are hard by construction, and compares the results with plain C's; all NaNs are
   equal. */
#ifndef HD_VERIFY_PROBE_H
#define HD_VERIFY_PROBE_H

#include <stdbool.h>

#include "device/kernel_cache.h"
#include "device/renderer.h"

enum {
    HD_PROBE_QUICK = 1 << 13, /* tuples of operands before a device's kernels are first compiled */
    HD_PROBE_WHOLE = 1 << 20  /* of `hedron selftest` */
};

typedef struct HdProbeReport {
    int tuples;    /* tuples compared */
    uint64_t hash; /* of all results */
    HdArithmetic found;
} HdProbeReport;

/* Probes a renderer that compiles its kernels, with strict arithmetic, in its precision and with
   its lanes. If only division or roots are wrong, makes them of fma, also for the renderer's
   kernels, and probes again. The report, not the status, holds the difference, which is remembered
   (kernel_cache.h). Discards the scene. */
HdStatus hd_probe(HdRenderer *renderer, int tuples, HdProbeReport *report, HdError *error);

/* Probes the renderer quickly, unless it was probed, need not be, or its result is remembered.
   HD_UNAVAILABLE, with the first difference, if the device computes wrongly. */
HdStatus hd_probe_settle(HdRenderer *renderer, HdError *error);

#endif
