/* SPDX-License-Identifier: MIT */
/* From what the user asked for to one device. */
#ifndef HD_DEVICE_CHOICE_H
#define HD_DEVICE_CHOICE_H

#include "backend.h"

typedef struct HdDeviceWish {
    const char *backend; /* NULL: any */
    const char *device;  /* number within the backend or part of a name; NULL: any */
    bool gpu;            /* a GPU is wanted; without one the fastest OpenCL device will do */
    bool cpu;            /* only a CPU will do */
} HdDeviceWish;

/* Chooses a device that can do what `options` ask. Without a named backend: a CUDA device, else a
   GPU under OpenCL, else plain C. With `gpu` and no GPU: the OpenCL device with the most compute
   units times clock, else plain C; `note` then says so in a sentence, and is empty otherwise.
   HD_UNAVAILABLE with every reason where nothing fits. */
HdStatus hd_choose_device(HdDevice *device, const HdDeviceWish *wish,
                          const HdRenderOptions *options, char note[512], HdError *error);

#endif
