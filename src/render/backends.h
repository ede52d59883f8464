/* SPDX-License-Identifier: MIT */
/* The registry: the one place that names every backend. */
#ifndef HD_RENDER_BACKENDS_H
#define HD_RENDER_BACKENDS_H

#include "device/backend.h"

/* X(name): all backends in order of preference; the last one is always available. */
#define HD_BACKENDS(X) X(cuda) X(opencl) X(c)

#define HD_BACKEND_DECLARED(name) extern const HdBackend hd_backend_##name;
#define HD_BACKEND_COUNTED(name)  +1
#define HD_BACKEND_ADDRESS(name)  &hd_backend_##name,
enum { HD_BACKEND_COUNT = 0 HD_BACKENDS(HD_BACKEND_COUNTED) };
HD_BACKENDS(HD_BACKEND_DECLARED)
extern const HdBackend *const hd_backends[HD_BACKEND_COUNT];

/* Returns the backend of that name, or NULL. */
const HdBackend *hd_backend_find(const char *name);

/* Returns the backend that needs no driver. */
const HdBackend *hd_backend_always_there(void);

/* Finds the device of that backend: plain C. */
static inline HdStatus hd_find_plain_device(HdDevice *device, HdError *error) {
    int count;
    return hd_backend_enumerate(hd_backend_always_there(), device, 1, &count, error);
}

#endif
