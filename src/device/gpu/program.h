/* SPDX-License-Identifier: MIT */
/* A GPU's kernels: from the cache, or compiled for a scene. */
#ifndef HD_DEVICE_GPU_PROGRAM_H
#define HD_DEVICE_GPU_PROGRAM_H

#include "device/gpu/memory.h"
#include "device/kernel_cache.h"

typedef struct HdGpuProgram {
    HdKernelCache cache;
    bool is_built;      /* for the cache's shape */
    bool probes_by_fma; /* so is the probe's kernel, if there is one */
    int block;          /* threads of a group, as asked for; 0: as many as the kernels allow */
    int registers;      /* of a thread, as asked for; 0: what suits */
    int nvidia_arch;    /* as HdDevice has it */
    int group_size;     /* of a launch: 1 where threads do not work in groups */
} HdGpuProgram;

/* Has kernels that do what a scene needs. They are read by the cache later, so that `gpu` must stay
   where it is. */
HdStatus hd_gpu_build(HdGpuProgram *program, const HdGpu *gpu, const HdKernelNeeds *needs,
                      HdError *error);

/* Has the kernel of the arithmetic probe, for the same shape, in place of those for a scene. */
HdStatus hd_gpu_build_probe(HdGpuProgram *program, const HdGpu *gpu, HdError *error);

/* All that this kernel depends on; "" where that is too much. */
void hd_gpu_probe_key(const HdGpuProgram *program, const HdGpu *gpu, char *text, size_t capacity);

#endif
