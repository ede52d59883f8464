/* SPDX-License-Identifier: MIT */
#include "opencl_memory.h"

HdStatus hd_opencl_resize(const HdOpenclOwner *owner, HdOpenclBuffer *buffer, size_t bytes,
                          cl_mem_flags flags, const char *what, HdError *error) {
    if (buffer->memory && buffer->bytes == bytes)
        return HD_OK;
    hd_opencl_release(buffer);
    if (bytes > owner->device->max_allocation)
        return hd_fail(error, HD_UNAVAILABLE,
                       "the %s need %zu bytes in one buffer; %s allows %llu of its %llu", what,
                       bytes, owner->name, (unsigned long long)owner->device->max_allocation,
                       (unsigned long long)owner->device->memory);
    cl_int code;
    buffer->memory = clCreateBuffer(owner->context, flags, bytes, NULL, &code);
    if (!buffer->memory)
        return hd_fail(error, HD_FAILED,
                       "%s has no room for the %s, %zu bytes (clCreateBuffer: %s)", owner->name,
                       what, bytes, hd_opencl_error_name(code));
    buffer->bytes = bytes;
    return HD_OK;
}

void hd_opencl_release(HdOpenclBuffer *buffer) {
    if (buffer->memory)
        clReleaseMemObject(buffer->memory);
    *buffer = (HdOpenclBuffer){0};
}

HdStatus hd_opencl_resize_host(const HdOpenclOwner *owner, HdOpenclHostMemory *memory, size_t bytes,
                               cl_command_queue queue, HdError *error) {
    if (memory->data && memory->buffer.bytes == bytes)
        return HD_OK;
    hd_opencl_release_host(memory, queue);
    HdStatus status =
        hd_opencl_resize(owner, &memory->buffer, bytes, CL_MEM_READ_WRITE | CL_MEM_ALLOC_HOST_PTR,
                         "pixels on their way to the host", error);
    if (status != HD_OK)
        return status;
    cl_int code;
    memory->data = clEnqueueMapBuffer(queue, memory->buffer.memory, CL_TRUE,
                                      CL_MAP_READ | CL_MAP_WRITE, 0, bytes, 0, NULL, NULL, &code);
    return memory->data ? HD_OK : hd_opencl_fail(error, "clEnqueueMapBuffer", code);
}

void hd_opencl_release_host(HdOpenclHostMemory *memory, cl_command_queue queue) {
    if (memory->data && clEnqueueUnmapMemObject(queue, memory->buffer.memory, memory->data, 0, NULL,
                                                NULL) == CL_SUCCESS)
        clFinish(queue);
    memory->data = NULL;
    hd_opencl_release(&memory->buffer);
}
