/* SPDX-License-Identifier: MIT */
/* Renders on one device behind a driver of GPUs: the functions of HdBackend, for any HdGpuDriver.
 */
#ifndef HD_DEVICE_GPU_RENDERER_H
#define HD_DEVICE_GPU_RENDERER_H

#include "device/gpu/driver.h"

HdStatus hd_gpu_open(const HdGpuDriver *driver, const HdDevice *device,
                     const HdRenderOptions *options, void **renderer, HdError *error);

/* All but the name, `enumerate` and `open`. */
#define HD_GPU_FUNCTIONS                                                                           \
    .upload = hd_gpu_upload, .submit = hd_gpu_submit, .collect = hd_gpu_collect,                   \
    .longest_launch = hd_gpu_longest_launch, .drop = hd_gpu_drop, .kernels = hd_gpu_kernels,       \
    .be_cautious = hd_gpu_be_cautious, .lanes = hd_gpu_lanes, .describe = hd_gpu_describe,         \
    .close = hd_gpu_close

HdStatus hd_gpu_upload(void *renderer, const HdSceneTables *tables, HdError *error);
HdStatus hd_gpu_submit(void *renderer, const HdFrameTables *tables, const HdFrameWish *wish,
                       HdError *error);
HdStatus hd_gpu_collect(void *renderer, const HdFrameTables *tables, HdFrame *frame,
                        HdError *error);
double hd_gpu_longest_launch(const void *renderer);
void hd_gpu_drop(void *renderer);
HdKernelCache *hd_gpu_kernels(void *renderer);
bool hd_gpu_be_cautious(void *renderer);
int hd_gpu_lanes(const void *renderer);
void hd_gpu_describe(const void *renderer, char *text, int capacity);
void hd_gpu_close(void *renderer);

#endif
