/* SPDX-License-Identifier: MIT */
#include "device/backend.h"

HdStatus hd_backend_enumerate(const HdBackend *backend, HdDevice *devices, int capacity, int *count,
                              HdError *error) {
    HdStatus status = backend->enumerate(devices, capacity, count, error);
    for (int i = 0; i < *count; i++)
        devices[i].backend = backend;
    return status;
}

HdStatus hd_backend_render(const HdBackend *backend, void *renderer, const HdFrameTables *tables,
                           HdFrame *frame, HdError *error) {
    static const HdFrameWish radiance = {.radiance = true};
    HdStatus status = backend->submit(renderer, tables, &radiance, error);
    return status == HD_OK ? backend->collect(renderer, frame, error) : status;
}
