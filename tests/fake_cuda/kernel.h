/* SPDX-License-Identifier: MIT */
/* The interface between the fake driver (C) and the kernels that its NVRTC builds (C++). A kernel
   NAME is the object fake_kernel_NAME of its module, beside fake_thread and fake_shared. */
#ifndef HD_FAKE_CUDA_KERNEL_H
#define HD_FAKE_CUDA_KERNEL_H

enum { FAKE_ARGUMENT_BYTES = 8, FAKE_SHARED_GUARD = 64 };

typedef struct FakeIndex {
    unsigned int x, y, z;
} FakeIndex;

/* The running thread, set by the driver. */
typedef struct FakeThread {
    FakeIndex thread, block, threads, blocks;
    void (*wait)(void); /* until all threads of the block do so */
} FakeThread;

typedef struct FakeParameter {
    unsigned int bytes; /* FAKE_ARGUMENT_BYTES at most */
    int is_pointer, is_written;
} FakeParameter;

typedef struct FakeKernel {
    void (*call)(void *const *arguments); /* one thread, to its end */
    int count;
    const FakeParameter *parameters;
} FakeKernel;

/* Memory that threads of a block share; the first FAKE_SHARED_GUARD bytes belong to no kernel. */
typedef struct FakeShared {
    unsigned char *begin, *end;
} FakeShared;

#endif
