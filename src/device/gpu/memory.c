/* SPDX-License-Identifier: MIT */
#include "device/gpu/gpu.h"

#include <stdio.h>
#include <string.h>

#include "tables/table.h"

enum { MIN_TABLE_BYTES = 16 };

HdStatus hd_gpu_refuse(const HdGpu *gpu, HdGpuPlace place, size_t bytes, const char *what,
                       const HdGpuRefusal *refusal, HdError *error) {
    char need[HD_BYTE_TEXT_SIZE], is_free[HD_BYTE_TEXT_SIZE] = "too little", all[HD_BYTE_TEXT_SIZE];
    hd_byte_text((double)bytes, need);
    hd_byte_text((double)gpu->facts.memory, all);
    if (refusal->knows_free)
        hd_byte_text(refusal->free, is_free);
    if (place == HD_GPU_HOST && !gpu->driver->counts_host_memory)
        return hd_fail(error, HD_FAILED,
                       "the system has no room for the %s, %s that stay in memory (%s: %s)", what,
                       need, refusal->function, refusal->reason);
    return hd_fail(error, HD_FAILED, "the %s need %s; %s has %s free of its %s (%s: %s); %s", what,
                   need, gpu->name, is_free, all, refusal->function, refusal->reason,
                   hd_budget_advice);
}

static HdStatus check_size(const HdGpu *gpu, size_t bytes, const char *what, HdError *error) {
    char need[HD_BYTE_TEXT_SIZE], at_once[HD_BYTE_TEXT_SIZE], all[HD_BYTE_TEXT_SIZE];
    if (gpu->facts.at_once == 0 || bytes <= gpu->facts.at_once)
        return HD_OK;
    hd_byte_text((double)bytes, need);
    hd_byte_text((double)gpu->facts.at_once, at_once);
    hd_byte_text((double)gpu->facts.memory, all);
    return hd_fail(error, HD_UNAVAILABLE, "the %s need %s in one buffer; %s allows %s of its %s",
                   what, need, gpu->name, at_once, all);
}

/* Fails with `refusal` if memory is lacking. */
static HdStatus try_to_reserve(const HdGpu *gpu, HdGpuMemory *memory, HdGpuPlace place,
                               size_t bytes, HdGpuRefusal *refusal, HdError *error) {
    if (memory->handle != NULL && memory->bytes >= bytes)
        return HD_OK;
    hd_gpu_release(gpu, memory);
    return gpu->driver->allocate(gpu->handle, memory, place, bytes, refusal, error);
}

HdStatus hd_gpu_reserve(const HdGpu *gpu, HdGpuMemory *memory, HdGpuPlace place, size_t bytes,
                        const char *what, HdError *error) {
    HdGpuRefusal refusal = {0};
    HdStatus status = check_size(gpu, bytes, what, error);
    if (status == HD_OK)
        status = try_to_reserve(gpu, memory, place, bytes, &refusal, error);
    return refusal.lacks_memory ? hd_gpu_refuse(gpu, place, bytes, what, &refusal, error) : status;
}

HdStatus hd_gpu_write_table(const HdGpu *gpu, HdGpuMemory *memory, const void *data, size_t bytes,
                            const char *what, HdError *error) {
    HdGpuRefusal refusal = {0};
    size_t capacity = bytes < MIN_TABLE_BYTES ? MIN_TABLE_BYTES : bytes;
    HdStatus status = hd_gpu_reserve(gpu, memory, HD_GPU_DEVICE, capacity, what, error);
    if (status == HD_OK && bytes > 0)
        status = gpu->driver->write(gpu->handle, memory, data, bytes, &refusal, error);
    return refusal.lacks_memory ? hd_gpu_refuse(gpu, HD_GPU_DEVICE, capacity, what, &refusal, error)
                                : status;
}

void hd_gpu_release(const HdGpu *gpu, HdGpuMemory *memory) {
    if (memory->handle != NULL && !memory->is_constant)
        gpu->driver->release(gpu->handle, memory);
    *memory = (HdGpuMemory){0};
}

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
                status = try_to_reserve(gpu, &queue->buffers[i], HD_GPU_DEVICE_AT_ONCE, bytes,
                                        &refusal, error);
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
    HD_TRY(hd_gpu_reserve(gpu, &queue->reported, HD_GPU_HOST, sizeof none, what, error));
    return hd_gpu_write_table(gpu, &queue->taken, none, sizeof none, what, error);
}

HdStatus hd_gpu_wave_queue_read(const HdGpuWaveQueue *queue, const HdGpu *gpu, unsigned *taken,
                                HdError *error) {
    HdStatus status =
        gpu->driver->read(gpu->handle, &queue->taken, queue->reported.data, sizeof *taken, error);
    if (status == HD_OK)
        memcpy(taken, queue->reported.data, sizeof *taken);
    return status;
}

void hd_gpu_wave_queue_release(HdGpuWaveQueue *queue, const HdGpu *gpu) {
    release_rays(queue, gpu);
    hd_gpu_release(gpu, &queue->taken);
    hd_gpu_release(gpu, &queue->reported);
}
