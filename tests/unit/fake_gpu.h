/* SPDX-License-Identifier: MIT */
/* An open GPU for tests, with memory that runs out and kernels that are numbers. */
#ifndef HD_TEST_FAKE_GPU_H
#define HD_TEST_FAKE_GPU_H

#include <stdio.h>
#include <stdlib.h>

#include "device/gpu/program.h"
#include "unit_test.h"

static struct {
    size_t room;       /* what may still be taken */
    bool breaks;       /* taking and compiling fail, not for want of memory */
    int taken, living; /* memories */
    size_t most;       /* threads of a group that its kernels allow */
    bool refuses;      /* to load */
    bool has_kernels;
    int compiled, loaded;
} gpu_state;

static HdStatus fake_allocate(void *gpu, HdGpuMemory *memory, HdGpuPlace place, size_t bytes,
                              HdGpuRefusal *refusal, HdError *error) {
    (void)gpu, (void)place;
    assert_null(memory->handle);
    if (gpu_state.breaks)
        return hd_fail(error, HD_UNAVAILABLE, "it is broken");
    if (bytes > gpu_state.room) {
        *refusal = (HdGpuRefusal){true, "take", "NO_ROOM", true, (double)gpu_state.room};
        return HD_FAILED;
    }
    gpu_state.room -= bytes;
    gpu_state.taken++;
    gpu_state.living++;
    memory->data = memory->handle = malloc(bytes);
    memory->bytes = bytes;
    return HD_OK;
}

static void fake_release(void *gpu, HdGpuMemory *memory) {
    (void)gpu;
    gpu_state.room += memory->bytes;
    gpu_state.living--;
    free(memory->handle);
}

static HdStatus fake_write(void *gpu, const HdGpuMemory *memory, const void *data, size_t bytes,
                           HdGpuRefusal *refusal, HdError *error) {
    (void)gpu, (void)refusal, (void)error;
    assert_true(bytes > 0 && bytes <= memory->bytes);
    memcpy(memory->handle, data, bytes);
    return HD_OK;
}

static HdStatus fake_read(void *gpu, const HdGpuMemory *memory, void *to, size_t bytes,
                          HdError *error) {
    (void)gpu, (void)error;
    memcpy(to, memory->handle, bytes);
    return HD_OK;
}

static void fake_write_options(void *gpu, const HdKernelShape *shape, char *text, size_t capacity) {
    (void)gpu;
    snprintf(text, capacity, "planes %d probe %d", shape->needs.plane_bound, shape->is_probe);
}

static void fake_write_version(void *gpu, char *text, size_t capacity) {
    (void)gpu;
    snprintf(text, capacity, "1");
}

static HdStatus fake_compile(void *gpu, const HdKernelShape *shape, const char *options,
                             char *maker, size_t capacity, HdError *error) {
    (void)gpu, (void)shape, (void)options;
    assert_false(gpu_state.has_kernels);
    gpu_state.compiled++;
    if (gpu_state.breaks)
        return hd_fail(error, HD_UNAVAILABLE, "it is broken");
    snprintf(maker, capacity, "somebody");
    gpu_state.has_kernels = true;
    return HD_OK;
}

static HdStatus fake_load(void *gpu, const HdKernelShape *shape, const char *options,
                          const unsigned char *binary, size_t size, const char *maker,
                          HdError *error) {
    (void)gpu, (void)shape, (void)options, (void)maker;
    assert_true(size == 1 && binary[0] == 'k');
    if (gpu_state.refuses)
        return hd_fail(error, HD_FAILED, "it is too old");
    gpu_state.loaded++;
    gpu_state.has_kernels = true;
    return HD_OK;
}

static unsigned char *fake_binary(const void *gpu, size_t *size) {
    (void)gpu;
    unsigned char *binary = malloc(1);
    assert_non_null(binary);
    *binary = 'k';
    *size = 1;
    return binary;
}

static void fake_unload(void *gpu) {
    (void)gpu;
    gpu_state.has_kernels = false;
}

static HdStatus fake_most_threads(void *gpu, size_t *threads, HdError *error) {
    (void)gpu, (void)error;
    *threads = gpu_state.most;
    return HD_OK;
}

static const unsigned char fake_source[] = "text";
static const size_t fake_source_size = 4;

static const HdGpuDriver fake_gpu_driver = {
    .groups = "blocks",
    .source = fake_source,
    .source_size = &fake_source_size,
    .allocate = fake_allocate,
    .release = fake_release,
    .write = fake_write,
    .read = fake_read,
    .write_options = fake_write_options,
    .write_version = fake_write_version,
    .compile = fake_compile,
    .load = fake_load,
    .binary = fake_binary,
    .unload = fake_unload,
    .most_threads = fake_most_threads,
};

static const HdGpu fake_gpu = {
    .driver = &fake_gpu_driver, .name = "a GPU", .facts.memory = 3000000};

#endif
