/* SPDX-License-Identifier: MIT */
/* The arithmetic probe: whether a device computes what strict arithmetic needs, measured in place
   of asked for. Every primitive of the kernels' dialect runs on operands that are hard by
   construction, and its results are compared with plain C's; of NaN only that it is one. */
#ifndef HD_DEVICE_PROBE_H
#define HD_DEVICE_PROBE_H

#include <stdbool.h>

#include "device/backend.h"
#include "device/probe_batch.h"

enum {
    HD_PROBE_QUICK = 1 << 13, /* tuples of operands before a device's kernels are compiled first */
    HD_PROBE_WHOLE = 1 << 20  /* of `hedron selftest` */
};

typedef struct HdProbeReport {
    int tuples;           /* that were compared */
    uint64_t hash;        /* of all results */
    uint64_t expected;    /* likewise of plain C's */
    bool rounds_by_fma;   /* division and roots are right only if they are made of fma */
    char difference[512]; /* the first one, in words; empty: there is none */
} HdProbeReport;

/* Probes an open renderer that compiles its kernels, with strict arithmetic, in its precision and
   with its lanes. Where division or roots alone are wrong, they are made of fused operations, for
   the renderer's kernels too, and all is probed anew. What differs is told by the report, not by
   the status. The renderer has no scene afterwards. */
HdStatus hd_probe(const HdBackend *backend, void *renderer, int tuples, HdProbeReport *report,
                  HdError *error);

/* Keeps what a probe found for hd_probe_settle and, of float, for hd_backend_enumerate. */
void hd_probe_remember(const HdBackend *backend, void *renderer, const HdDevice *device,
                       const HdProbeReport *report);

/* Has it probed quickly, unless the cache folder remembers what came of it with this driver and
   this program. HD_UNAVAILABLE, with the first difference, where the device computes wrongly. */
HdStatus hd_probe_settle(const HdBackend *backend, void *renderer, const HdDevice *device,
                         HdError *error);

#endif
