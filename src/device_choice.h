/* SPDX-License-Identifier: MIT */
/* From what the user asked for to one device. */
#ifndef HD_DEVICE_CHOICE_H
#define HD_DEVICE_CHOICE_H

#include "backend.h"

typedef enum HdDeviceKind {
    HD_WANT_ANY,   /* a GPU, else plain C */
    HD_PREFER_GPU, /* a GPU, else any backend's CPU, which is worth a note */
    HD_ONLY_CPU    /* only a CPU will do: plain C, unless a backend is named */
} HdDeviceKind;

typedef struct HdDeviceWish {
    const char *backend; /* NULL: any */
    const char *device; /* number within the backend, BACKEND:NUMBER or part of a name; NULL: any */
    HdDeviceKind kind;
} HdDeviceWish;

typedef struct HdDeviceReason {
    char note[512]; /* worth telling unasked; empty: nothing is */
    char why[8192]; /* why this device, and why others were passed over */
} HdDeviceReason;

/* Chooses a device that can do what `options` ask. GPUs come before CPUs, then backends in the
   order of hd_backends, then the device with the most compute units times clock. CPUs of other
   backends than plain C count only where the backend or a device is named, or a GPU is preferred.
   Where one was preferred, no backend was named and there is none, the reason has a note that says
   so in a sentence. HD_UNAVAILABLE with every reason where nothing fits. */
HdStatus hd_choose_device(HdDevice *device, const HdDeviceWish *wish,
                          const HdRenderOptions *options, HdDeviceReason *reason, HdError *error);

#endif
