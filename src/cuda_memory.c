/* SPDX-License-Identifier: MIT */
#include "cuda_memory.h"

HdStatus hd_cuda_check(const HdCudaDriver *driver, HdCuResult code, const char *function,
                       HdError *error) {
    return code == HD_CU_SUCCESS ? HD_OK : hd_cuda_fail(driver, function, code, error);
}

HdStatus hd_cuda_resize(const HdCudaOwner *owner, HdCudaMemory *memory, size_t bytes,
                        const char *what, HdError *error) {
    if (memory->pointer && memory->bytes == bytes)
        return HD_OK;
    hd_cuda_release(owner, memory);
    HdCuPointer pointer = 0;
    HdCuResult code = owner->driver->memory_alloc(&pointer, bytes);
    if (code == HD_CU_SUCCESS) {
        *memory = (HdCudaMemory){pointer, bytes};
        return HD_OK;
    }
    size_t available = 0, total = 0;
    owner->driver->memory_info(&available, &total);
    return hd_fail(error, HD_FAILED,
                   "the %s need %zu bytes; %s has %zu free of %zu (cuMemAlloc: %s)", what, bytes,
                   owner->name, available, total, hd_cuda_error_name(owner->driver, code));
}

void hd_cuda_release(const HdCudaOwner *owner, HdCudaMemory *memory) {
    if (memory->pointer) {
        owner->driver->context_synchronize();
        owner->driver->memory_free(memory->pointer);
    }
    *memory = (HdCudaMemory){0};
}

HdStatus hd_cuda_resize_host(const HdCudaOwner *owner, HdCudaHostMemory *memory, size_t bytes,
                             const char *what, HdError *error) {
    if (memory->data && memory->bytes == bytes)
        return HD_OK;
    hd_cuda_release_host(owner, memory);
    void *data = NULL;
    HdCuResult code = owner->driver->host_alloc(&data, bytes, 0);
    if (code != HD_CU_SUCCESS)
        return hd_fail(error, HD_FAILED,
                       "the system has no room for the %s, %zu bytes that stay in memory "
                       "(cuMemHostAlloc: %s)",
                       what, bytes, hd_cuda_error_name(owner->driver, code));
    *memory = (HdCudaHostMemory){data, bytes};
    return HD_OK;
}

void hd_cuda_release_host(const HdCudaOwner *owner, HdCudaHostMemory *memory) {
    if (memory->data) {
        owner->driver->context_synchronize();
        owner->driver->host_free(memory->data);
    }
    *memory = (HdCudaHostMemory){0};
}
