/* SPDX-License-Identifier: MIT */
/* The arithmetic probe: whether a device computes what strict arithmetic needs, measured in place
   of asked for. Every primitive of the kernels' dialect runs on operands that are hard by
   construction, and its results are compared with plain C's; of NaN only that it is one. */
#ifndef HD_VERIFY_PROBE_H
#define HD_VERIFY_PROBE_H

#include <stdbool.h>

#include "device/kernel_cache.h"
#include "device/renderer.h"

enum {
    HD_PROBE_QUICK = 1 << 13, /* tuples of operands before a device's kernels are compiled first */
    HD_PROBE_WHOLE = 1 << 20  /* of `hedron selftest` */
};

typedef struct HdProbeReport {
    int tuples;    /* that were compared */
    uint64_t hash; /* of all results */
    HdArithmetic found;
} HdProbeReport;

/* Probes a renderer that compiles its kernels, with strict arithmetic, in its precision and with
   its lanes. Where division or roots alone are wrong, they are made of fused operations, for the
   renderer's kernels too, and all is probed anew. What differs is told by the report, not by the
   status, and remembered (kernel_cache.h). The renderer has no scene afterwards. */
HdStatus hd_probe(HdRenderer *renderer, int tuples, HdProbeReport *report, HdError *error);

/* Has the renderer probed quickly, unless it was or need not be, or what came of it is remembered.
   HD_UNAVAILABLE, with the first difference, where the device computes wrongly. */
HdStatus hd_probe_settle(HdRenderer *renderer, HdError *error);

#endif
