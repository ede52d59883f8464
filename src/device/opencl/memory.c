/* SPDX-License-Identifier: MIT */
#include "device/opencl/memory.h"

#include "tables/room.h"

bool hd_opencl_is_lack_of_memory(cl_int code) {
    return code == CL_MEM_OBJECT_ALLOCATION_FAILURE || code == CL_OUT_OF_RESOURCES ||
           code == CL_OUT_OF_HOST_MEMORY;
}

HdStatus hd_opencl_check_room(const HdOpenclOwner *owner, size_t bytes, const char *what,
                              const char *function, cl_int code, HdError *error) {
    char need[HD_BYTE_TEXT_SIZE], memory[HD_BYTE_TEXT_SIZE];
    if (code == CL_SUCCESS)
        return HD_OK;
    if (!hd_opencl_is_lack_of_memory(code))
        return hd_opencl_fail(error, function, code);
    hd_byte_text((double)bytes, need);
    hd_byte_text((double)owner->device->memory, memory);
    return hd_fail(error, HD_FAILED,
                   "the %s need %s; %s has too little free of its %s (%s: %s); %s", what, need,
                   owner->name, memory, function, hd_opencl_error_name(code), hd_room_advice);
}

HdStatus hd_opencl_reserve(const HdOpenclOwner *owner, HdOpenclBuffer *buffer, size_t bytes,
                           cl_mem_flags flags, const char *what, HdError *error) {
    if (buffer->memory && buffer->bytes >= bytes)
        return HD_OK;
    hd_opencl_release(buffer);
    if (bytes > owner->device->max_allocation) {
        char need[HD_BYTE_TEXT_SIZE], at_once[HD_BYTE_TEXT_SIZE], memory[HD_BYTE_TEXT_SIZE];
        hd_byte_text((double)bytes, need);
        hd_byte_text((double)owner->device->max_allocation, at_once);
        hd_byte_text((double)owner->device->memory, memory);
        return hd_fail(error, HD_UNAVAILABLE,
                       "the %s need %s in one buffer; %s allows %s of its %s", what, need,
                       owner->name, at_once, memory);
    }
    cl_int code = CL_SUCCESS;
    buffer->memory = clCreateBuffer(owner->context, flags, bytes, NULL, &code);
    buffer->bytes = bytes;
    return hd_opencl_check_room(owner, bytes, what, "clCreateBuffer", code, error);
}

void hd_opencl_release(HdOpenclBuffer *buffer) {
    if (buffer->memory)
        clReleaseMemObject(buffer->memory);
    *buffer = (HdOpenclBuffer){0};
}

HdStatus hd_opencl_reserve_host(const HdOpenclOwner *owner, HdOpenclHostMemory *memory,
                                size_t bytes, cl_command_queue queue, HdError *error) {
    if (memory->data && memory->buffer.bytes >= bytes)
        return HD_OK;
    hd_opencl_release_host(memory, queue);
    HdStatus status =
        hd_opencl_reserve(owner, &memory->buffer, bytes, CL_MEM_READ_WRITE | CL_MEM_ALLOC_HOST_PTR,
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
