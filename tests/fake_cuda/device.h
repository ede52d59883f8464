/* SPDX-License-Identifier: MIT */
/* The part of CUDA's device language that the kernels use, as C++ for one processor: threads are
   fibers of the driver (fibers.c). The fake NVRTC includes it before the kernels' text, after which
   it appends a FAKE_KERNEL for each entry point. */
#include "kernel.h"

#define __device__
#define __global__
#define __constant__
#define __forceinline__  inline
#define __align__(bytes) __attribute__((aligned(bytes)))
#define __shared__       static __attribute__((section("fake_shared_memory"), aligned(16)))

#define threadIdx fake_thread.thread
#define blockIdx  fake_thread.block
#define blockDim  fake_thread.threads
#define gridDim   fake_thread.blocks

extern "C" {
FakeThread fake_thread;
extern unsigned char __start_fake_shared_memory[] __attribute__((visibility("hidden")));
extern unsigned char __stop_fake_shared_memory[] __attribute__((visibility("hidden")));
__shared__ unsigned char fake_shared_guard[FAKE_SHARED_GUARD] __attribute__((used));
extern const FakeShared fake_shared = {__start_fake_shared_memory, __stop_fake_shared_memory};
}

/* ---- threads; each runs alone until it waits, so no other one is active ---- */

static inline void __syncthreads() {
    fake_thread.wait();
}
/* Each time it is asked, a warp is this thread alone, or has another one with all bits set. */
static bool fake_is_alone;
static inline unsigned __activemask() {
    fake_is_alone = !fake_is_alone;
    return fake_is_alone ? 1 : 3;
}
static inline unsigned __ballot_sync(unsigned, int is_set) {
    return (is_set != 0) | (fake_is_alone ? 0 : 2);
}
template <typename T> static inline T atomicAdd(T *to, T amount) {
    T before = *to;
    *to += amount;
    return before;
}

/* ---- numbers ---- */

#ifdef FAKE_WRONG /* as a compiler that takes liberties with rounding */
static inline float __fmaf_rn(float a, float b, float c) {
    return a * b + c;
}
static inline double __fma_rn(double a, double b, double c) {
    return a * b + c;
}
#else
static inline float __fmaf_rn(float a, float b, float c) {
    return __builtin_fmaf(a, b, c);
}
static inline double __fma_rn(double a, double b, double c) {
    return __builtin_fma(a, b, c);
}
#endif
static inline float sqrt(float a) {
    return __builtin_sqrtf(a);
}
static inline double sqrt(double a) {
    return __builtin_sqrt(a);
}
static inline float fabs(float a) {
    return __builtin_fabsf(a);
}
static inline double fabs(double a) {
    return __builtin_fabs(a);
}
static inline int __ffs(int a) {
    return __builtin_ffs(a);
}
static inline int __popc(unsigned a) {
    return __builtin_popcount(a);
}
template <typename To, typename From> static inline To fake_bits(From from) {
    To to;
    static_assert(sizeof to == sizeof from, "the same bits");
    __builtin_memcpy(&to, &from, sizeof to);
    return to;
}
static inline int __float_as_int(float a) {
    return fake_bits<int>(a);
}
static inline float __int_as_float(int a) {
    return fake_bits<float>(a);
}
static inline long long __double_as_longlong(double a) {
    return fake_bits<long long>(a);
}
static inline double __longlong_as_double(long long a) {
    return fake_bits<double>(a);
}

/* ---- entry points: number of parameters, their types, and how to call them ---- */

template <typename T> struct FakeType {
    static constexpr FakeParameter described = {sizeof(T), 0, 0};
};
template <typename T> struct FakeType<T *> {
    static constexpr FakeParameter described = {sizeof(T *), 1, 1};
};
template <typename T> struct FakeType<const T *> {
    static constexpr FakeParameter described = {sizeof(T *), 1, 0};
};

template <int... Places> struct FakePlaces {};
template <int Count, int... Places> struct FakeUpTo : FakeUpTo<Count - 1, Count - 1, Places...> {};
template <int... Places> struct FakeUpTo<0, Places...> { typedef FakePlaces<Places...> All; };

template <auto kernel> struct FakeEntry;
template <typename... P, void (*kernel)(P...)> struct FakeEntry<kernel> {
    static_assert(((sizeof(P) <= FAKE_ARGUMENT_BYTES) && ...), "no structs as parameters");
    template <int... Places> static void spread(void *const *arguments, FakePlaces<Places...>) {
        kernel(*(P *)arguments[Places]...);
    }
    static void call(void *const *arguments) {
        spread(arguments, typename FakeUpTo<sizeof...(P)>::All());
    }
    static constexpr FakeParameter parameters[] = {FakeType<P>::described...};
    static constexpr FakeKernel described = {call, sizeof...(P), parameters};
};

#define FAKE_KERNEL(name)                                                                          \
    extern "C" {                                                                                   \
    extern const FakeKernel fake_kernel_##name = FakeEntry<name>::described;                       \
    }
