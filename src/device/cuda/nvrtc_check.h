/* SPDX-License-Identifier: MIT */
/* Whether there is an NVRTC for a device, without loading it each time. */
#ifndef HD_DEVICE_CUDA_NVRTC_CHECK_H
#define HD_DEVICE_CUDA_NVRTC_CHECK_H

#include "base/error.h"

/* Fails as hd_nvrtc_open does where nothing compiles for sm_`arch`. A library that did once is
   remembered in the cache folder (cache_folder.h); as long as the same file lies there and
   HEDRON_NVRTC names what it named, it is not loaded. */
HdStatus hd_nvrtc_check(const char *device, int arch, int driver_major, HdError *error);

/* Remembers that the library compiles for sm_`arch`. What cannot be remembered is not. */
void hd_nvrtc_remember(const char *library, int arch, int driver_major);

#endif
