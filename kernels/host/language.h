/* SPDX-License-Identifier: MIT */
/* What kernels/common/ asks of C beside primitives: qualifiers and integers. */
#ifndef HD_HOST_LANGUAGE_H
#define HD_HOST_LANGUAGE_H

#if defined(__FAST_MATH__) || (defined(__FLT_EVAL_METHOD__) && __FLT_EVAL_METHOD__ != 0)
#error "hedron needs IEEE 754 arithmetic in the declared precision: no -ffast-math, no x87"
#endif
#include <stdint.h>

#define FN       static inline __attribute__((always_inline, unused))
#define FN_APART static __attribute__((noinline, unused))
#define GLOBAL
#define LOCAL
#define BARRIER()  ((void)0) /* there is one work item in a group */
#define RESTRICT   restrict
#define ALIGNED_16 __attribute__((aligned(16)))
typedef uint32_t uint;
typedef uint64_t uint64;
typedef int64_t fixed64;

#endif
