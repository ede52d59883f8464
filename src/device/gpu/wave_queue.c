/* SPDX-License-Identifier: MIT */
#include "device/gpu/wave_queue.h"

#include <string.h>

static void release_rays(HdGpuWaveQueue *queue, const HdGpu *gpu) {
    for (int i = 0; i < HD_WAVE_BUFFERS; i++)
        hd_gpu_release(gpu, &queue->buffers[i]);
}

HdStatus hd_gpu_wave_queue_reserve(HdGpuWaveQueue *queue, const HdGpu *gpu, HdWaveNeeds *needs,
                                   int workers, HdError *error) {
    for (;;) {
        HdGpuRefusal refusal = {0};
        HdStatus status = HD_OK;
        size_t all = 0;
        queue->plan = hd_wave_plan(needs);
        for (int i = 0; i < HD_WAVE_BUFFERS; i++) {
            size_t bytes = queue->plan.bytes[i] * (size_t)workers;
            all += bytes;
            if (status == HD_OK)
                status = hd_gpu_try(gpu, &queue->buffers[i], HD_GPU_DEVICE_AT_ONCE, bytes, &refusal,
                                    error);
        }
        if (status == HD_OK)
            return HD_OK;
        release_rays(queue, gpu);
        if (!refusal.lacks_memory)
            return status;
        if (!hd_wave_halve(needs))
            return hd_gpu_refuse(gpu, HD_GPU_DEVICE, all, "rays of the queue", &refusal, error);
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
