/* SPDX-License-Identifier: MIT */
/* A wavefront's queue in the memory of a GPU. */
#ifndef HD_DEVICE_GPU_WAVE_QUEUE_H
#define HD_DEVICE_GPU_WAVE_QUEUE_H

#include "device/gpu/memory.h"
#include "device/wave_plan.h"

typedef struct HdGpuWaveQueue {
    HdGpuMemory buffers[HD_WAVE_BUFFERS];
    HdGpuMemory taken; /* the counter of taken places */
    HdGpuMemory told;  /* of the host: what it reads of that */
    HdWavePlan plan;
    size_t bytes; /* that it may use, for each of its workers */
    bool is_cut;  /* the device refused more */
} HdGpuWaveQueue;

/* Takes memory for what the needs of each of the workers come to; where the device has too little
   left, for less. */
HdStatus hd_gpu_wave_queue_reserve(HdGpuWaveQueue *queue, const HdGpu *gpu, HdWaveNeeds *needs,
                                   int workers, HdError *error);

/* Queues that no place is taken. */
HdStatus hd_gpu_wave_queue_empty(HdGpuWaveQueue *queue, const HdGpu *gpu, HdError *error);

/* Waits, and tells how many places are taken. */
HdStatus hd_gpu_wave_queue_read(const HdGpuWaveQueue *queue, const HdGpu *gpu, unsigned *taken,
                                HdError *error);

void hd_gpu_wave_queue_release(HdGpuWaveQueue *queue, const HdGpu *gpu);

#endif
