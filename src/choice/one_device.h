/* SPDX-License-Identifier: MIT */
/* From what the user asked for to one device. */
#ifndef HD_CHOICE_ONE_DEVICE_H
#define HD_CHOICE_ONE_DEVICE_H

#include "choice/trial.h"

typedef enum HdDeviceKind {
    HD_WANT_ANY,   /* a GPU or plain C, whichever is faster */
    HD_PREFER_GPU, /* a GPU, else any backend's CPU, which is worth a note */
    HD_ONLY_CPU    /* only a CPU will do: plain C, unless a backend is named */
} HdDeviceKind;

typedef struct HdDeviceWish {
    const char *backend; /* NULL: any */
    const char *device; /* number within the backend, BACKEND:NUMBER or part of a name; NULL: any */
    HdDeviceKind kind;
    const HdRenderOptions *options; /* what it must be able to do */
    const HdJob *job;               /* what it is to be the fastest at */
} HdDeviceWish;

/* Whether the device is "all" or a list (devices.h). */
bool hd_wish_is_for_several(const HdDeviceWish *wish);

typedef struct HdDeviceReason {
    char note[4096]; /* worth telling unasked; empty: nothing is */
    char why[8192];  /* why this device, and why others were passed over */
} HdDeviceReason;

/* Opens a device that can do what the wish's options ask. Where a backend or a device is named, or
   only a CPU will do, it is the best that fits: GPUs come before CPUs, then backends in the order
   of hd_backends, then the device with the most compute units times clock. Otherwise all that fit
   are candidates, CPUs of other backends than plain C only where a GPU is preferred, and
   hd_auto_open chooses: among GPUs where one is preferred, else among GPUs and plain C. A job that
   plain C does in less than HD_AUTO_SMALL_SECONDS is its own unless a GPU is preferred; no
   driver is asked then. Where a GPU was preferred, no backend was named and there is none, the
   reason has a note that says so in a sentence. HD_UNAVAILABLE with every reason where nothing
   fits; HD_BAD_INPUT where several devices are asked for. */
HdStatus hd_open_device(HdRenderer **renderer, HdDevice *device, const HdDeviceWish *wish,
                        HdDeviceReason *reason, HdError *error);

#endif
