/* SPDX-License-Identifier: MIT */
/* What hosts share with the kernels: the qualifiers and integers that kernels/common/ needs of C,
   table rows, the kernels' arguments and the plan of a wavefront's queue. HD_DOUBLE is 0 or 1 in
   files that use reals. */
#ifndef HD_HOST_SHARED_H
#define HD_HOST_SHARED_H

#if defined(__FAST_MATH__) || (defined(__FLT_EVAL_METHOD__) && __FLT_EVAL_METHOD__ != 0)
#error "hedron needs IEEE 754 arithmetic in the declared precision: no -ffast-math, no x87"
#endif
#include <stdint.h>

#define FN          static inline __attribute__((always_inline, unused))
#define FN_NOINLINE static __attribute__((noinline, unused))
#define GLOBAL
#define RESTRICT   restrict
#define ALIGNED_16 __attribute__((aligned(16)))
typedef uint32_t uint;
typedef uint64_t uint64;
typedef int64_t fixed64;

#include "kernels/common/kernel_arguments.h"
#include "kernels/common/scene_tables.h"
#include "kernels/common/wave_stack.h"

#endif
