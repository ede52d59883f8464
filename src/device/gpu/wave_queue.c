/* SPDX-License-Identifier: MIT */
#include "device/gpu/wave_queue.h"

#include <string.h>

static void release_rays(HdGpuWaveQueue *queue, const HdGpu *gpu) {
    hd_gpu_release(gpu, &queue->reals);
    hd_gpu_release(gpu, &queue->ints);
    hd_gpu_release(gpu, &queue->sums);
}

static HdStatus take(HdGpuMemory *memory, const HdGpu *gpu, size_t bytes, HdGpuRefusal *refusal,
                     HdError *error) {
    return hd_gpu_try(gpu, memory, HD_GPU_DEVICE_AT_ONCE, bytes, refusal, error);
}

HdStatus hd_gpu_wave_queue_reserve(HdGpuWaveQueue *queue, const HdGpu *gpu, HdWaveNeeds *needs,
                                   int workers, HdError *error) {
    size_t all = (size_t)workers;
    for (;;) {
        HdGpuRefusal refusal = {0};
        HdWavePlan plan = queue->plan = hd_wave_plan(needs);
        size_t bytes = (plan.real_bytes + plan.int_bytes + plan.sum_bytes) * all;
        HdStatus status = take(&queue->reals, gpu, plan.real_bytes * all, &refusal, error);
        if (status == HD_OK)
            status = take(&queue->ints, gpu, plan.int_bytes * all, &refusal, error);
        if (status == HD_OK)
            status = take(&queue->sums, gpu, plan.sum_bytes * all, &refusal, error);
        if (status == HD_OK)
            return HD_OK;
        release_rays(queue, gpu);
        if (!refusal.lacks_memory)
            return status;
        if (!hd_wave_halve(needs))
            return hd_gpu_refuse(gpu, HD_GPU_DEVICE, bytes, "rays of the queue", &refusal, error);
        queue->bytes = needs->bytes;
        queue->is_cut = true;
    }
}

HdStatus hd_gpu_wave_queue_empty(HdGpuWaveQueue *queue, const HdGpu *gpu, HdError *error) {
    static const unsigned none[4] = {0};
    static const char what[] = "counter of the queue";
    HdStatus status = hd_gpu_reserve(gpu, &queue->told, HD_GPU_HOST, sizeof none, what, error);
    if (status == HD_OK)
        status = hd_gpu_write_table(gpu, &queue->taken, none, sizeof none, what, error);
    return status;
}

HdStatus hd_gpu_wave_queue_read(const HdGpuWaveQueue *queue, const HdGpu *gpu, unsigned *taken,
                                HdError *error) {
    HdStatus status =
        gpu->driver->read(gpu->handle, &queue->taken, queue->told.data, sizeof *taken, error);
    if (status == HD_OK)
        memcpy(taken, queue->told.data, sizeof *taken);
    return status;
}

void hd_gpu_wave_queue_release(HdGpuWaveQueue *queue, const HdGpu *gpu) {
    release_rays(queue, gpu);
    hd_gpu_release(gpu, &queue->taken);
    hd_gpu_release(gpu, &queue->told);
}
