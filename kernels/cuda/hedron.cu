/* SPDX-License-Identifier: MIT */
/* The kernels in CUDA. */
#include "dialect.h"

#define KERNEL  extern "C" __global__ void
#define SHARED  __shared__
#define WORKER  ((int)(blockIdx.x * blockDim.x + threadIdx.x))
#define WORKERS ((int)(gridDim.x * blockDim.x))
#define GROUP   ((int)blockIdx.x)
#define GROUPS  ((int)gridDim.x)
#define THREAD  ((int)threadIdx.x)
#define THREADS ((int)blockDim.x)

/* Kernels read small tables from constant memory; these names hide the parameters of the same
   names. */
#define DEFINE_CONSTANT(type, name, rows)                                                          \
    extern "C" {                                                                                   \
    __constant__ type hedron_constant_##name[rows];                                                \
    }
#define USE_CONSTANT(type, name, rows) const type *const name = hedron_constant_##name;
#if HD_SMALL_TABLES
#define SMALL_TABLES(X) HD_SMALL_SCENE_TABLES(X) HD_SMALL_FRAME_TABLES(X)
#else
#define SMALL_TABLES(X)
#endif

#include "../common/entries.h"
