/* SPDX-License-Identifier: MIT */
/* Memory of an OpenCL device, and memory of the host that it copies to and from quickly. */
#ifndef HD_DEVICE_OPENCL_MEMORY_H
#define HD_DEVICE_OPENCL_MEMORY_H

#include "device/opencl/devices.h"

/* Whose memory; for messages as well. */
typedef struct HdOpenclOwner {
    cl_context context;
    const HdOpenclDevice *device;
    const char *name;
} HdOpenclOwner;

typedef struct HdOpenclBuffer {
    cl_mem memory; /* NULL: there is none */
    size_t bytes;
} HdOpenclBuffer;

/* Makes it a buffer of at least `bytes`, unless it is one; its contents are lost if not. What is
   queued may still use the old one. It never shrinks, for to take memory anew takes as long as a
   small frame. `what` is for messages: "pixels". */
HdStatus hd_opencl_reserve(const HdOpenclOwner *owner, HdOpenclBuffer *buffer, size_t bytes,
                           cl_mem_flags flags, const char *what, HdError *error);

/* True for what a driver says where memory is lacking. */
bool hd_opencl_is_lack_of_memory(cl_int code);

void hd_opencl_release(HdOpenclBuffer *buffer);

/* Turns the result of a function that makes a buffer, or first touches it, into a status; where
   memory is lacking the message tells how much `what` needs. */
HdStatus hd_opencl_check_room(const HdOpenclOwner *owner, size_t bytes, const char *what,
                              const char *function, cl_int code, HdError *error);

/* Memory of the host that stays where it is, so that the device copies to it by itself. */
typedef struct HdOpenclHostMemory {
    HdOpenclBuffer buffer;
    void *data;
} HdOpenclHostMemory;

/* As above, but waits for the queue. No copy to the old memory may be under way. */
HdStatus hd_opencl_reserve_host(const HdOpenclOwner *owner, HdOpenclHostMemory *memory,
                                size_t bytes, cl_command_queue queue, HdError *error);
void hd_opencl_release_host(HdOpenclHostMemory *memory, cl_command_queue queue);

#endif
