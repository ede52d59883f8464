/* SPDX-License-Identifier: MIT */
/* Finds, among the NVRTC libraries of this machine, the one to compile for a device with. */
#ifndef HD_DEVICE_CUDA_NVRTC_H
#define HD_DEVICE_CUDA_NVRTC_H

#include <stdbool.h>

#include "device/cuda/api.h"

typedef struct HdNvrtc {
    HdNvrtcFunctions functions;
    int major, minor;
    void *library; /* owned */
} HdNvrtc;

/* Takes the newest library that compiles for sm_`arch`, one that is not newer than the driver
   (`driver_major`, 0: unknown) before one that is. Looked at: the file `path`; if that is NULL, the
   file that HEDRON_NVRTC names, or nothing where it is "off"; otherwise the folders that
   docs/backends.md lists. Where
   there is none, the message says what was found and what to install for that device and driver.
   `device` is its name. */
HdStatus hd_nvrtc_open(HdNvrtc *nvrtc, const char *device, int arch, int driver_major,
                       const char *path, HdError *error);
void hd_nvrtc_close(HdNvrtc *nvrtc);

/* Whether HEDRON_NVRTC names a file, so that nothing else will do. */
bool hd_nvrtc_is_named(void);

/* The package for Python whose NVRTC compiles for sm_`arch` what a driver for that CUDA takes. */
const char *hd_nvrtc_package(int arch, int driver_major);

/* Fails as hd_nvrtc_open does where nothing compiles for sm_`arch`. A library that did once is
   remembered in the cache folder (cache_folder.h); as long as the same file lies there and
   HEDRON_NVRTC names what it named, it is not loaded. */
HdStatus hd_nvrtc_check(const char *device, int arch, int driver_major, HdError *error);

/* Remembers that the library compiles for sm_`arch`. What cannot be remembered is not. */
void hd_nvrtc_remember(const char *library, int arch, int driver_major);

#endif
