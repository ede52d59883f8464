/* SPDX-License-Identifier: MIT */
/* The dialect of the kernels (../common/dialect.h) in CUDA C++: packets of one lane. */
#ifndef HD_CUDA_DIALECT_H
#define HD_CUDA_DIALECT_H

#define FN          static __device__ __forceinline__
#define FN_NOINLINE static __device__ __forceinline__
#define GLOBAL
#define LOCAL
#define BARRIER()    __syncthreads()
#define RESTRICT     __restrict__
#define ALIGNED_16   __align__(16)
#define UNROLL_TWICE _Pragma("unroll 2")
typedef unsigned int uint;
typedef unsigned long long uint64;
typedef long long fixed64;

#include "../common/lanes.h"

#if HD_DOUBLE
#define HD_AS_BITS __double_as_longlong
#define HD_AS_REAL __longlong_as_double
#define HD_FMA     __fma_rn
#else
#define HD_AS_BITS __float_as_int
#define HD_AS_REAL __int_as_float
#define HD_FMA     __fmaf_rn
#endif

FN vbits bits_of(vreal a) {
    return HD_AS_BITS(a);
}
FN vreal from_bits(vbits a) {
    return HD_AS_REAL(a);
}
FN vreal multiply_add(vreal a, vreal b, vreal c) {
    return HD_FMA(a, b, c);
}
FN vreal built_in_root(vreal a) {
    return sqrt(a); /* overloaded */
}
FN vreal absolute(vreal a) {
    return fabs(a); /* overloaded */
}
FN int lowest_bit(uint bits) {
    return __ffs((int)bits) - 1;
}
FN int count_bits(uint bits) {
    return __popc(bits);
}

/* Threads that the compiler lets diverge belong to other sets: each set has a highest number. */
#define HD_OWN_HIGHEST
FN int is_highest_of_warp(int number, int limit) {
    uint together = __activemask();
#if __CUDA_ARCH__ >= 800
    (void)limit;
    return __reduce_max_sync(together, (uint)number) == (uint)number;
#else
    int bit = 1, highest = 1;
    while (2 * bit < limit)
        bit *= 2;
    for (; bit > 0; bit /= 2) {
        uint have = __ballot_sync(together, highest && number & bit);
        highest = highest && (number & bit || !have);
    }
    return highest;
#endif
}

#if HD_GROUP_SIZE
FN void add_shared(fixed64 *sum, fixed64 amount) {
    atomicAdd((uint64 *)sum, (uint64)amount);
}
FN uint take_shared(uint *counter, uint amount) {
    return atomicAdd(counter, amount);
}
#endif

#endif
