/* SPDX-License-Identifier: MIT */
/* From the lists of kernels/common/kernel_arguments.h to the arguments of a launch. */
#ifndef HD_DEVICE_GPU_ARGUMENTS_H
#define HD_DEVICE_GPU_ARGUMENTS_H

#include "device/gpu/driver.h"

static inline void hd_gpu_add(HdGpuLaunch *launch, const void *value, size_t bytes) {
    launch->arguments[launch->argument_count++] = (HdGpuArgument){value, bytes};
}

static inline void hd_gpu_add_memory(HdGpuLaunch *launch, const HdGpuMemory *memory) {
    hd_gpu_add(launch, &memory->handle, sizeof memory->handle);
}

#define HD_MEMBER_INPUT(type, name)  const HdGpuMemory *name;
#define HD_MEMBER_BUFFER(type, name) const HdGpuMemory *name;
#define HD_MEMBER_NUMBER(type, name) type name;
#define HD_MEMBER(kind, type, name)  HD_MEMBER_##kind(type, name)
#define HD_ADD_INPUT(name)           hd_gpu_add_memory(launch, from->name);
#define HD_ADD_BUFFER(name)          hd_gpu_add_memory(launch, from->name);
#define HD_ADD_NUMBER(name)          hd_gpu_add(launch, &from->name, sizeof from->name);
#define HD_ADD(kind, type, name)     HD_ADD_##kind(name)

/* A struct with a member for each entry of a list of arguments, and a function that adds them all
   in the kernel's order; it must live until the launch. */
#define HD_GPU_ARGUMENTS(Struct, function, LIST)                                                   \
    typedef struct Struct {                                                                        \
        LIST(HD_MEMBER, HD_MEMBER)                                                                 \
    } Struct;                                                                                      \
    static void function(HdGpuLaunch *launch, const Struct *from) {                                \
        LIST(HD_ADD, HD_ADD)                                                                       \
    }

#endif
