/* SPDX-License-Identifier: MIT */
#include "device/cuda/memory.h"

#include "tables/room.h"

HdStatus hd_cuda_check(const HdCudaDriver *driver, HdCuResult code, const char *function,
                       HdError *error) {
    return code == HD_CU_SUCCESS ? HD_OK : hd_cuda_fail(driver, function, code, error);
}

HdCuResult hd_cuda_try(const HdCudaOwner *owner, HdCudaMemory *memory, size_t bytes) {
    if (memory->pointer && memory->bytes >= bytes)
        return HD_CU_SUCCESS;
    hd_cuda_release(owner, memory);
    HdCuPointer pointer = 0;
    HdCuResult code = owner->driver->memory_alloc(&pointer, bytes);
    if (code == HD_CU_SUCCESS)
        *memory = (HdCudaMemory){pointer, bytes};
    return code;
}

HdStatus hd_cuda_refuse(const HdCudaOwner *owner, size_t bytes, const char *what, HdCuResult code,
                        HdError *error) {
    if (code != HD_CU_ERROR_OUT_OF_MEMORY)
        return hd_cuda_fail(owner->driver, "cuMemAlloc", code, error);
    size_t available = 0, total = 0;
    owner->driver->memory_info(&available, &total);
    char need[HD_BYTE_TEXT_SIZE], is_free[HD_BYTE_TEXT_SIZE], all[HD_BYTE_TEXT_SIZE];
    hd_byte_text((double)bytes, need);
    hd_byte_text((double)available, is_free);
    hd_byte_text((double)total, all);
    return hd_fail(
        error, HD_FAILED, "the %s need %s; %s has %s free of its %s (cuMemAlloc: %s); %s", what,
        need, owner->name, is_free, all, hd_cuda_error_name(owner->driver, code), hd_room_advice);
}

HdStatus hd_cuda_reserve(const HdCudaOwner *owner, HdCudaMemory *memory, size_t bytes,
                         const char *what, HdError *error) {
    HdCuResult code = hd_cuda_try(owner, memory, bytes);
    return code == HD_CU_SUCCESS ? HD_OK : hd_cuda_refuse(owner, bytes, what, code, error);
}

void hd_cuda_release(const HdCudaOwner *owner, HdCudaMemory *memory) {
    if (memory->pointer) {
        owner->driver->context_synchronize();
        owner->driver->memory_free(memory->pointer);
    }
    *memory = (HdCudaMemory){0};
}

HdStatus hd_cuda_reserve_host(const HdCudaOwner *owner, HdCudaHostMemory *memory, size_t bytes,
                              const char *what, HdError *error) {
    if (memory->data && memory->bytes >= bytes)
        return HD_OK;
    hd_cuda_release_host(owner, memory);
    void *data = NULL;
    HdCuResult code = owner->driver->host_alloc(&data, bytes, 0);
    if (code != HD_CU_SUCCESS) {
        char need[HD_BYTE_TEXT_SIZE];
        hd_byte_text((double)bytes, need);
        return hd_fail(error, HD_FAILED,
                       "the system has no room for the %s, %s that stay in memory "
                       "(cuMemHostAlloc: %s)",
                       what, need, hd_cuda_error_name(owner->driver, code));
    }
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
