/* SPDX-License-Identifier: MIT */
/* The registry: the one place that names every backend. */
#ifndef HD_RENDER_BACKENDS_H
#define HD_RENDER_BACKENDS_H

#include "device/backend.h"

enum { HD_BACKEND_COUNT = 3 };

/* All backends, the best first: cuda, opencl, c. The last one is always there. */
extern const HdBackend hd_backend_cuda, hd_backend_opencl, hd_backend_c;
extern const HdBackend *const hd_backends[HD_BACKEND_COUNT];

/* NULL where no backend has that name. */
const HdBackend *hd_backend_find(const char *name);

/* The one that needs no driver. */
const HdBackend *hd_backend_always_there(void);

#endif
