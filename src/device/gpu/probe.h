/* SPDX-License-Identifier: MIT */
/* Runs the arithmetic probe's kernel. */
#ifndef HD_DEVICE_GPU_PROBE_H
#define HD_DEVICE_GPU_PROBE_H

#include "device/gpu/program.h"

/* Computes a batch with the kernel of hd_gpu_build_probe, and waits for it. */
HdStatus hd_gpu_run_probe(const HdGpuProgram *program, const HdGpu *gpu, const HdProbeBatch *batch,
                          HdProbeResults *results, HdError *error);

#endif
