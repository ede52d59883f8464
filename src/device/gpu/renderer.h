/* SPDX-License-Identifier: MIT */
/* Renders on one device behind a driver of GPUs, for any HdGpuDriver: that of the device's backend.
 */
#ifndef HD_DEVICE_GPU_RENDERER_H
#define HD_DEVICE_GPU_RENDERER_H

#include "device/gpu/driver.h"

extern const HdRendererFunctions hd_gpu_functions;

#endif
