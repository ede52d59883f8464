/* SPDX-License-Identifier: MIT */
/* The dialect of the shared kernels: the one file that asks which backend it is compiled for.

   Kernel text is written for a bundle of HD_LANES lanes. With one lane a bundle is a scalar; with
   more it is a vector of the language. docs/dialect.md is the manual.

   HD_LANES   1, 4, 8 or 16
   HD_DOUBLE  0: real is float; 1: real is double */
#ifndef HD_DIALECT_H
#define HD_DIALECT_H

#ifndef HD_LANES
#define HD_LANES 1
#endif
#ifndef HD_DOUBLE
#define HD_DOUBLE 0
#endif

#define HD_PASTE_(a, b) a##b
#define HD_PASTE(a, b)  HD_PASTE_(a, b)

/* ---- scalars: real, R(literal), uint, uint64, fixed64; address spaces; function qualifier ---- */

#if defined(__OPENCL_C_VERSION__)

#if HD_STRICT
#pragma OPENCL FP_CONTRACT OFF
#endif
#if HD_DOUBLE
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#endif
#define FN        static inline
#define FN_APART  static
#define GLOBAL    __global
#define LOCAL     __local
#define BARRIER() barrier(CLK_LOCAL_MEM_FENCE)
#ifdef cl_nv_pragma_unroll /* NVIDIA's compiler; see CUDA below */
#define RECONVERGE()                                                                               \
    __asm__ volatile("{ .reg .b32 m; activemask.b32 m; bar.warp.sync m; }" ::: "memory")
#else
#define RECONVERGE() ((void)0)
#endif
#define RESTRICT   restrict
#define ALIGNED_16 __attribute__((aligned(16)))
typedef ulong uint64;
typedef long fixed64;

#elif defined(__CUDACC__) || defined(__CUDACC_RTC__)

#define FN       static __device__ __forceinline__
#define FN_APART static __device__ __forceinline__
#define GLOBAL
#define LOCAL
/* Threads of a warp that left loops at different times come together again. Left to themselves,
   NVIDIA's compilers (13.0, sm_90) lose what some of them do where loops are nested deeply. */
#define BARRIER()    (__syncwarp(), __syncthreads())
#define RECONVERGE() __syncwarp(__activemask())
#define RESTRICT     __restrict__
#define ALIGNED_16   __align__(16)
typedef unsigned int uint;
typedef unsigned long long uint64;
typedef long long fixed64;

#else

#if defined(__FAST_MATH__) || (defined(__FLT_EVAL_METHOD__) && __FLT_EVAL_METHOD__ != 0)
#error "hedron needs IEEE 754 arithmetic in the declared precision: no -ffast-math, no x87"
#endif
#include <math.h>
#include <stdint.h>
#include <string.h>
#if defined(__AVX512F__) || defined(__AVX2__)
#include <immintrin.h>
#endif
#define FN       static inline __attribute__((always_inline, unused))
#define FN_APART static __attribute__((noinline, unused))
#define GLOBAL
#define LOCAL
#define BARRIER()    ((void)0) /* there is one work item in a group */
#define RECONVERGE() ((void)0)
#define RESTRICT     restrict
#define ALIGNED_16   __attribute__((aligned(16)))
typedef uint32_t uint;
typedef uint64_t uint64;
typedef int64_t fixed64;

#endif

#if HD_DOUBLE
typedef double real;
#define R(literal) literal
#else
typedef float real;
#define R(literal) HD_PASTE(literal, f)
#endif

/* Larger than any distance of a scene; stands for "none" in searches of a minimum. */
#define REAL_LARGE R(1e30)

/* ---- bundles: vreal, vint (integers), vmask (opaque but for &, |, ^ and ~), vfix (64 bits), vbits
   (integers as wide as real, whose scalar is real_bits) ---- */

#if HD_LANES == 1

typedef real vreal;
typedef fixed64 vfix;
typedef int vint;
typedef int vmask;
#define HD_MASKS_ARE_INTEGERS 1
#if HD_DOUBLE
typedef fixed64 real_bits;
#else
typedef int real_bits;
#endif
typedef real_bits vbits;

FN vreal splat(real a) {
    return a;
}
FN vbits splat_bits(real_bits a) {
    return a;
}
FN vint splat_int(int a) {
    return a;
}
FN vmask lt(vreal a, vreal b) {
    return a < b ? -1 : 0;
}
FN vmask le(vreal a, vreal b) {
    return a <= b ? -1 : 0;
}
FN vmask eq_int(vint a, vint b) {
    return a == b ? -1 : 0;
}
FN vmask lt_int(vint a, vint b) {
    return a < b ? -1 : 0;
}
FN vreal pick(vmask m, vreal a, vreal b) {
    return m ? a : b;
}
FN vint pick_int(vmask m, vint a, vint b) {
    return m ? a : b;
}
FN int any_lane(vmask m) {
    return m != 0;
}
FN real lane_real(const vreal *a, int lane) {
    (void)lane;
    return *a;
}
FN int lane_int(const vint *a, int lane) {
    (void)lane;
    return *a;
}
FN fixed64 lane_fix(const vfix *a, int lane) {
    (void)lane;
    return *a;
}
FN void set_lane_int(vint *a, int lane, int value) {
    (void)lane;
    *a = value;
}
FN vint to_int(vreal a) {
    return (int)a;
}
FN vreal to_real(vint a) {
    return (real)a;
}
FN vfix truncate_to_fix(vreal a) {
    return (vfix)a;
}
#if defined(__OPENCL_C_VERSION__)
FN vreal multiply_add(vreal a, vreal b, vreal c) {
    return fma(a, b, c);
}
FN vreal square_root(vreal a) {
    return sqrt(a);
}
#if HD_DOUBLE
FN vbits bits_of(vreal a) {
    return as_long(a);
}
FN vreal from_bits(vbits a) {
    return as_double(a);
}
#else
FN vbits bits_of(vreal a) {
    return as_int(a);
}
FN vreal from_bits(vbits a) {
    return as_float(a);
}
#endif
#elif defined(__CUDACC__) || defined(__CUDACC_RTC__)
#if HD_DOUBLE
FN vbits bits_of(vreal a) {
    return __double_as_longlong(a);
}
FN vreal from_bits(vbits a) {
    return __longlong_as_double(a);
}
FN vreal multiply_add(vreal a, vreal b, vreal c) {
    return __fma_rn(a, b, c);
}
FN vreal square_root(vreal a) {
    return sqrt(a);
}
#else
FN vbits bits_of(vreal a) {
    return __float_as_int(a);
}
FN vreal from_bits(vbits a) {
    return __int_as_float(a);
}
FN vreal multiply_add(vreal a, vreal b, vreal c) {
    return __fmaf_rn(a, b, c);
}
FN vreal square_root(vreal a) {
    return sqrtf(a);
}
#endif
#else
FN vbits bits_of(vreal a) {
    vbits b;
    memcpy(&b, &a, sizeof b);
    return b;
}
FN vreal from_bits(vbits a) {
    vreal b;
    memcpy(&b, &a, sizeof b);
    return b;
}
#if HD_DOUBLE
FN vreal multiply_add(vreal a, vreal b, vreal c) {
    return __builtin_fma(a, b, c);
}
FN vreal square_root(vreal a) {
    return __builtin_sqrt(a);
}
#else
FN vreal multiply_add(vreal a, vreal b, vreal c) {
    return __builtin_fmaf(a, b, c);
}
FN vreal square_root(vreal a) {
    return __builtin_sqrtf(a);
}
#endif
#endif

#elif defined(__OPENCL_C_VERSION__)

#if HD_DOUBLE
typedef HD_PASTE(double, HD_LANES) vreal;
typedef HD_PASTE(long, HD_LANES) vint;
typedef HD_PASTE(long, HD_LANES) vmask;
typedef long lane_integer;
#define HD_CONVERT_INT  HD_PASTE(convert_long, HD_LANES)
#define HD_CONVERT_REAL HD_PASTE(convert_double, HD_LANES)
#define HD_AS_BITS      HD_PASTE(as_long, HD_LANES)
#define HD_AS_REAL      HD_PASTE(as_double, HD_LANES)
#else
typedef HD_PASTE(float, HD_LANES) vreal;
typedef HD_PASTE(int, HD_LANES) vint;
typedef HD_PASTE(int, HD_LANES) vmask;
typedef int lane_integer;
#define HD_CONVERT_INT  HD_PASTE(convert_int, HD_LANES)
#define HD_CONVERT_REAL HD_PASTE(convert_float, HD_LANES)
#define HD_AS_BITS      HD_PASTE(as_int, HD_LANES)
#define HD_AS_REAL      HD_PASTE(as_float, HD_LANES)
#endif
typedef lane_integer real_bits;
typedef vint vbits;
#define HD_MASKS_ARE_INTEGERS 1
typedef HD_PASTE(long, HD_LANES) vfix;
#define HD_CONVERT_FIX        HD_PASTE(convert_long, HD_LANES)

FN vreal splat(real a) {
    return (vreal)(a);
}
FN vbits splat_bits(real_bits a) {
    return (vbits)(a);
}
FN vbits bits_of(vreal a) {
    return HD_AS_BITS(a);
}
FN vreal from_bits(vbits a) {
    return HD_AS_REAL(a);
}
FN vint splat_int(int a) {
    return (vint)(a);
}
FN vmask lt(vreal a, vreal b) {
    return a < b;
}
FN vmask le(vreal a, vreal b) {
    return a <= b;
}
FN vmask eq_int(vint a, vint b) {
    return a == b;
}
FN vmask lt_int(vint a, vint b) {
    return a < b;
}
FN vreal pick(vmask m, vreal a, vreal b) {
    return select(b, a, m);
}
FN vint pick_int(vmask m, vint a, vint b) {
    return select(b, a, m);
}
/* A byte for each lane: drivers for CPUs are slow with any(). */
#if HD_LANES == 16
FN int any_lane(vmask m) {
    ulong2 bytes = as_ulong2(convert_char16(m));
    return (bytes.x | bytes.y) != 0;
}
#elif HD_LANES == 8
FN int any_lane(vmask m) {
    return as_ulong(convert_char8(m)) != 0;
}
#else
FN int any_lane(vmask m) {
    return as_int(convert_char4(m)) != 0;
}
#endif
FN real lane_real(const vreal *a, int lane) {
    return ((const real *)a)[lane];
}
FN int lane_int(const vint *a, int lane) {
    return (int)((const lane_integer *)a)[lane];
}
FN fixed64 lane_fix(const vfix *a, int lane) {
    return ((const fixed64 *)a)[lane];
}
FN void set_lane_int(vint *a, int lane, int value) {
    ((lane_integer *)a)[lane] = value;
}
FN vint to_int(vreal a) {
    return HD_CONVERT_INT(a);
}
FN vreal to_real(vint a) {
    return HD_CONVERT_REAL(a);
}
FN vfix truncate_to_fix(vreal a) {
    return HD_CONVERT_FIX(a);
}
FN vreal multiply_add(vreal a, vreal b, vreal c) {
    return fma(a, b, c);
}
FN vreal square_root(vreal a) {
    return sqrt(a);
}

#else /* C, with the vector extension of GCC and Clang */

#if HD_DOUBLE
typedef int64_t lane_integer;
#define HD_FMA_SCALAR  __builtin_fma
#define HD_SQRT_SCALAR __builtin_sqrt
#else
typedef int32_t lane_integer;
#define HD_FMA_SCALAR  __builtin_fmaf
#define HD_SQRT_SCALAR __builtin_sqrtf
#endif
/* Whether a bundle fills a register of 512 bits; a mask then has a bit for each lane. */
#if defined(__AVX512DQ__) && HD_LANES * (HD_DOUBLE + 1) == 16
#define HD_REGISTER_512 1
#else
#define HD_REGISTER_512 0
#endif
typedef real vreal __attribute__((vector_size(HD_LANES * sizeof(real))));
typedef lane_integer vint __attribute__((vector_size(HD_LANES * sizeof(real))));
typedef int64_t vfix __attribute__((vector_size(HD_LANES * 8)));
typedef lane_integer real_bits;
typedef vint vbits;

FN vreal splat(real a) {
    return a - (vreal){0};
}
FN vint splat_int(int a) {
    return (lane_integer)a - (vint){0};
}
FN vbits splat_bits(real_bits a) {
    return a - (vbits){0};
}
FN vbits bits_of(vreal a) {
    return (vbits)a;
}
FN vreal from_bits(vbits a) {
    return (vreal)a;
}
FN real lane_real(const vreal *a, int lane) {
    return (*a)[lane];
}
FN int lane_int(const vint *a, int lane) {
    return (int)(*a)[lane];
}
FN fixed64 lane_fix(const vfix *a, int lane) {
    return (*a)[lane];
}
FN void set_lane_int(vint *a, int lane, int value) {
    (*a)[lane] = value;
}
FN vint to_int(vreal a) {
    return __builtin_convertvector(a, vint);
}
FN vreal to_real(vint a) {
    return __builtin_convertvector(a, vreal);
}
FN vfix truncate_to_fix(vreal a) {
    return __builtin_convertvector(a, vfix);
}

#if HD_REGISTER_512
typedef uint32_t vmask; /* bits above the lanes' have no meaning */
#if HD_DOUBLE
typedef __m512d Reals512;
#define HD_MASK(m)                 ((__mmask8)(m))
#define HD_REALS_512(name, ending) _mm512_##name##_pd##ending
#define HD_INTS_512(name, ending)  _mm512_##name##_epi64##ending
#else
typedef __m512 Reals512;
#define HD_MASK(m)                 ((__mmask16)(m))
#define HD_REALS_512(name, ending) _mm512_##name##_ps##ending
#define HD_INTS_512(name, ending)  _mm512_##name##_epi32##ending
#endif
FN vmask lt(vreal a, vreal b) {
    return HD_REALS_512(cmp, _mask)((Reals512)a, (Reals512)b, _CMP_LT_OQ);
}
FN vmask le(vreal a, vreal b) {
    return HD_REALS_512(cmp, _mask)((Reals512)a, (Reals512)b, _CMP_LE_OQ);
}
FN vmask eq_int(vint a, vint b) {
    return HD_INTS_512(cmpeq, _mask)((__m512i)a, (__m512i)b);
}
FN vmask lt_int(vint a, vint b) {
    return HD_INTS_512(cmplt, _mask)((__m512i)a, (__m512i)b);
}
FN vreal pick(vmask m, vreal a, vreal b) {
    return (vreal)HD_REALS_512(mask_blend, )(HD_MASK(m), (Reals512)b, (Reals512)a);
}
FN vint pick_int(vmask m, vint a, vint b) {
    return (vint)HD_INTS_512(mask_blend, )(HD_MASK(m), (__m512i)b, (__m512i)a);
}
FN vreal multiply_add(vreal a, vreal b, vreal c) {
    return (vreal)HD_REALS_512(fmadd, )((Reals512)a, (Reals512)b, (Reals512)c);
}
FN vreal square_root(vreal a) {
    return (vreal)HD_REALS_512(sqrt, )((Reals512)a);
}
FN int any_lane(vmask m) {
    return HD_MASK(m) != 0;
}
FN vmask mask_none(void) {
    return 0;
}
FN vmask mask_all(void) {
    return HD_MASK(-1);
}
FN int first_lane(vmask m) {
    return __builtin_ctz(m);
}

#else
typedef vint vmask;
FN vmask lt(vreal a, vreal b) {
    return a < b;
}
FN vmask le(vreal a, vreal b) {
    return a <= b;
}
FN vmask eq_int(vint a, vint b) {
    return a == b;
}
FN vmask lt_int(vint a, vint b) {
    return a < b;
}
FN vreal pick(vmask m, vreal a, vreal b) {
    return (vreal)((m & (vmask)a) | (~m & (vmask)b));
}
FN vint pick_int(vmask m, vint a, vint b) {
    return (m & a) | (~m & b);
}
#define HD_MASKS_ARE_INTEGERS 1

/* Neither compiler has these three for vectors: instructions where the width is the machine's, lane
   by lane elsewhere. */
#if HD_LANES * (HD_DOUBLE + 1) == 8 && defined(__AVX2__) && defined(__FMA__)
#define HD_REGISTER_256 1
#if HD_DOUBLE
typedef __m256d Reals256;
#define HD_REALS_256(name) _mm256_##name##_pd
#else
typedef __m256 Reals256;
#define HD_REALS_256(name) _mm256_##name##_ps
#endif
FN vreal multiply_add(vreal a, vreal b, vreal c) {
    return (vreal)HD_REALS_256(fmadd)((Reals256)a, (Reals256)b, (Reals256)c);
}
FN vreal square_root(vreal a) {
    return (vreal)HD_REALS_256(sqrt)((Reals256)a);
}
FN int any_lane(vmask m) {
    return HD_REALS_256(movemask)((Reals256)m) != 0;
}
#elif HD_LANES * (HD_DOUBLE + 1) == 4 && defined(__AVX2__) && defined(__FMA__)
FN vreal multiply_add(vreal a, vreal b, vreal c) {
    return (vreal)_mm_fmadd_ps((__m128)a, (__m128)b, (__m128)c);
}
FN vreal square_root(vreal a) {
    return (vreal)_mm_sqrt_ps((__m128)a);
}
FN int any_lane(vmask m) {
    return _mm_movemask_ps((__m128)m) != 0;
}
#else
FN vreal multiply_add(vreal a, vreal b, vreal c) {
    vreal r;
    for (int lane = 0; lane < HD_LANES; lane++)
        r[lane] = HD_FMA_SCALAR(a[lane], b[lane], c[lane]);
    return r;
}
FN vreal square_root(vreal a) {
    vreal r;
    for (int lane = 0; lane < HD_LANES; lane++)
        r[lane] = HD_SQRT_SCALAR(a[lane]);
    return r;
}
FN int any_lane(vmask m) {
    lane_integer joined = 0;
    for (int lane = 0; lane < HD_LANES; lane++)
        joined |= m[lane];
    return joined != 0;
}
#endif
#endif

#endif

#ifdef HD_MASKS_ARE_INTEGERS
FN vmask mask_none(void) {
    return splat_int(0);
}
FN vmask mask_all(void) {
    return splat_int(-1);
}

/* The number of the first lane whose mask is set; only for masks with any_lane(m). */
FN int first_lane(vmask m) {
    int lane = 0;
    while (lane < HD_LANES - 1 && !lane_int(&m, lane))
        lane++;
    return lane;
}
#endif

/* ---- built from the above, the same for every backend ---- */

/* The lesser and the greater as selects: vendors differ in what their min and max make of NaN and
   -0. Where a is NaN or both are 0, the result is b, as x86's instructions have it. */
#if HD_REGISTER_512
FN vreal lesser(vreal a, vreal b) {
    return (vreal)HD_REALS_512(min, )((Reals512)a, (Reals512)b);
}
FN vreal greater(vreal a, vreal b) {
    return (vreal)HD_REALS_512(max, )((Reals512)a, (Reals512)b);
}
#elif HD_REGISTER_256
FN vreal lesser(vreal a, vreal b) {
    return (vreal)HD_REALS_256(min)((Reals256)a, (Reals256)b);
}
FN vreal greater(vreal a, vreal b) {
    return (vreal)HD_REALS_256(max)((Reals256)a, (Reals256)b);
}
#else
FN vreal lesser(vreal a, vreal b) {
    return pick(lt(a, b), a, b);
}
FN vreal greater(vreal a, vreal b) {
    return pick(lt(b, a), a, b);
}
#endif

FN vint least_int(vint a, vint b) {
    return pick_int(lt_int(a, b), a, b);
}
FN vint greatest_int(vint a, vint b) {
    return pick_int(lt_int(b, a), a, b);
}

#if defined(__OPENCL_C_VERSION__)
FN vreal absolute(vreal a) {
    return fabs(a);
}
#elif defined(__CUDACC__) || defined(__CUDACC_RTC__)
FN vreal absolute(vreal a) {
    return fabs(a); /* overloaded */
}
#else
FN vreal absolute(vreal a) {
    return from_bits(bits_of(a) & ~bits_of(splat(R(-0.0))));
}
#endif

/* `a`, negated where `sign` is negative. */
FN vreal times_sign_of(vreal a, vreal sign) {
    return from_bits(bits_of(a) ^ (bits_of(sign) & bits_of(splat(R(-0.0)))));
}

/* The number of the lowest bit that is set, from 0 on; not for 0. */
#if defined(__OPENCL_C_VERSION__)
FN int lowest_bit(uint bits) {
    return 31 - (int)clz(bits & (0u - bits));
}
#elif defined(__CUDACC__) || defined(__CUDACC_RTC__)
FN int lowest_bit(uint bits) {
    return __ffs((int)bits) - 1;
}
#else
FN int lowest_bit(uint bits) {
    return __builtin_ctz(bits);
}
#endif

FN vmask pick_mask(vmask m, vmask a, vmask b) {
    return (m & a) | (~m & b);
}

/* A private array's numbers, one for each lane. */
#if HD_LANES == 1
FN vreal gather_reals(const real *from) {
    return *from;
}
#elif defined(__OPENCL_C_VERSION__)
FN vreal gather_reals(const real *from) {
    return HD_PASTE(vload, HD_LANES)(0, from);
}
#else
FN vreal gather_reals(const real *from) {
    vreal a;
    __builtin_memcpy(&a, from, sizeof a);
    return a;
}
#endif

/* The four words of a table from number `index` of each lane on. */
typedef struct {
    vint word[4];
} FourWords;

#if HD_REGISTER_512 && !HD_DOUBLE
/* Of the 4 x 4 words in each quarter of the registers. */
FN FourWords transpose_quarters(const __m512i row[4]) {
    __m512i a = _mm512_unpacklo_epi32(row[0], row[1]), b = _mm512_unpacklo_epi32(row[2], row[3]);
    __m512i c = _mm512_unpackhi_epi32(row[0], row[1]), d = _mm512_unpackhi_epi32(row[2], row[3]);
    FourWords words;
    words.word[0] = (vint)_mm512_unpacklo_epi64(a, b);
    words.word[1] = (vint)_mm512_unpackhi_epi64(a, b);
    words.word[2] = (vint)_mm512_unpacklo_epi64(c, d);
    words.word[3] = (vint)_mm512_unpackhi_epi64(c, d);
    return words;
}

/* Four lanes to a register. */
FN FourWords fetch_four_words(GLOBAL const uint *table, vint index) {
    __m512i lanes[4];
    for (int i = 0; i < 4; i++) {
        __m512i row = _mm512_castsi128_si512(_mm_loadu_si128((const void *)(table + index[i])));
        row = _mm512_inserti32x4(row, _mm_loadu_si128((const void *)(table + index[i + 4])), 1);
        row = _mm512_inserti32x4(row, _mm_loadu_si128((const void *)(table + index[i + 8])), 2);
        lanes[i] =
            _mm512_inserti32x4(row, _mm_loadu_si128((const void *)(table + index[i + 12])), 3);
    }
    return transpose_quarters(lanes);
}
#else
FN FourWords fetch_four_words(GLOBAL const uint *table, vint index) {
    FourWords words;
    for (int i = 0; i < 4; i++)
        words.word[i] = splat_int(0);
    for (int lane = 0; lane < HD_LANES; lane++) {
        GLOBAL const uint *row = table + lane_int(&index, lane);
        for (int i = 0; i < 4; i++)
            set_lane_int(&words.word[i], lane, (int)row[i]);
    }
    return words;
}
#endif

/* `counts`, one more in the lanes of `m`. */
FN vint count_lanes(vint counts, vmask m) {
    return counts + pick_int(m, splat_int(1), splat_int(0));
}

/* A bit for each lane of a mask, the first lane's the lowest. */
#if HD_REGISTER_512
FN uint lane_bits(vmask m) {
    return HD_MASK(m);
}
#elif HD_LANES == 8 && !HD_DOUBLE && !defined(__OPENCL_C_VERSION__) && defined(__AVX2__)
FN uint lane_bits(vmask m) {
    return (uint)_mm256_movemask_ps((__m256)m);
}
#else
FN uint lane_bits(vmask m) {
    vint chosen = pick_int(m, splat_int(1), splat_int(0));
    uint bits = 0;
    for (int lane = 0; lane < HD_LANES; lane++)
        bits |= (uint)lane_int(&chosen, lane) << lane;
    return bits;
}
#endif

/* How many bits are set. */
#if defined(__OPENCL_C_VERSION__)
FN int count_bits(uint bits) {
    return (int)popcount(bits);
}
#elif defined(__CUDACC__) || defined(__CUDACC_RTC__)
FN int count_bits(uint bits) {
    return __popc(bits);
}
#else
FN int count_bits(uint bits) {
    return __builtin_popcount(bits);
}
#endif

/* 0, 1, 2, ... */
FN vint lane_numbers(void) {
    vint numbers = splat_int(0);
    for (int lane = 0; lane < HD_LANES; lane++)
        set_lane_int(&numbers, lane, lane);
    return numbers;
}

/* The least and the greatest of the lanes of `m`, of which there are some; numbers but infinite
   ones or NaN. */
#if HD_REGISTER_512
FN real least_lane(vreal a, vmask m) {
    return HD_REALS_512(mask_reduce_min, )(HD_MASK(m), (Reals512)a);
}
FN real greatest_lane(vreal a, vmask m) {
    return HD_REALS_512(mask_reduce_max, )(HD_MASK(m), (Reals512)a);
}
#elif HD_LANES > 1
FN real least_lane(vreal a, vmask m) {
    vreal kept = pick(m, a, splat(REAL_LARGE));
    real least = lane_real(&kept, 0);
    for (int lane = 1; lane < HD_LANES; lane++) {
        real other = lane_real(&kept, lane);
        least = other < least ? other : least;
    }
    return least;
}
FN real greatest_lane(vreal a, vmask m) {
    return -least_lane(-a, m);
}
#endif

/* The first `count` lanes. */
FN vmask lanes_below(int count) {
    return lt_int(lane_numbers(), splat_int(count));
}

/* The four numbers of a table from number `index` of each lane on. */
typedef struct {
    vreal number[4];
} FourReals;

#if HD_REGISTER_512 && !HD_DOUBLE
FN FourReals reals_of(FourWords words) {
    FourReals reals;
    for (int i = 0; i < 4; i++)
        reals.number[i] = from_bits(words.word[i]);
    return reals;
}
FN FourReals fetch_four_reals(GLOBAL const real *table, vint index) {
    return reals_of(fetch_four_words((const void *)table, index));
}
#else
FN FourReals fetch_four_reals(GLOBAL const real *table, vint index) {
    real rows[4][HD_LANES];
    FourReals reals;
    for (int lane = 0; lane < HD_LANES; lane++) {
        GLOBAL const real *row = table + lane_int(&index, lane);
        for (int i = 0; i < 4; i++)
            rows[i][lane] = row[i];
    }
    for (int i = 0; i < 4; i++)
        reals.number[i] = gather_reals(rows[i]);
    return reals;
}
#endif

/* Likewise the four numbers k * `stride` after `from` in lane k; beyond lane `count` those of the
   last one. */
#if HD_LANES > 1
#if HD_REGISTER_512 && !HD_DOUBLE
FN FourReals load_rows(const real *from, int stride, int count) {
    __m512i row[4];
    for (int i = 0; i < 4; i++) {
        const real *at = from + (i < count ? i : count - 1) * stride;
        row[i] = _mm512_broadcast_i32x4(_mm_loadu_si128((const void *)at));
    }
    for (int quarter = 1; quarter < 4 && 4 * quarter < count; quarter++)
        for (int i = 0; i < 4; i++) {
            int k = 4 * quarter + i;
            const real *at = from + (k < count ? k : count - 1) * stride;
            __m512i more = _mm512_broadcast_i32x4(_mm_loadu_si128((const void *)at));
            row[i] = _mm512_mask_mov_epi32(row[i], (__mmask16)(0xf << 4 * quarter), more);
        }
    return reals_of(transpose_quarters(row));
}
#else
FN FourReals load_rows(GLOBAL const real *from, int stride, int count) {
    return fetch_four_reals(from, least_int(lane_numbers(), splat_int(count - 1)) * stride);
}
#endif
#endif

/* Asks for memory that is needed soon, where a processor can be asked. */
#if defined(__OPENCL_C_VERSION__) || defined(__CUDACC__) || defined(__CUDACC_RTC__)
FN void prefetch_bytes(GLOBAL const char *from, int count) {
    (void)from;
    (void)count;
}
#else
FN void prefetch_bytes(const char *from, int count) {
    enum { CACHE_LINE = 64 };
    for (int i = 0; i < count; i += CACHE_LINE)
        __builtin_prefetch(from + i);
}
#endif

/* ---- memory: as many consecutive numbers as a bundle has lanes, wherever they begin; and the
   lanes of a mask stored side by side, which may overwrite as much as a bundle ---- */

#if HD_LANES == 1
FN vreal load_reals(GLOBAL const real *from) {
    return *from;
}
FN vint load_ints(GLOBAL const int *from) {
    return *from;
}
#elif defined(__OPENCL_C_VERSION__)
FN vreal load_reals(GLOBAL const real *from) {
    return HD_PASTE(vload, HD_LANES)(0, from);
}
FN vint load_ints(GLOBAL const int *from) {
    return HD_CONVERT_INT(HD_PASTE(vload, HD_LANES)(0, from));
}
#else
FN vreal load_reals(const real *from) {
    vreal a;
    __builtin_memcpy(&a, from, sizeof a);
    return a;
}
FN vint load_ints(const int *from) {
    int32_t a __attribute__((vector_size(HD_LANES * 4)));
    __builtin_memcpy(&a, from, sizeof a);
    return __builtin_convertvector(a, vint);
}
#endif

/* Where each lane of `m` is stored; returns how many these are. */
FN int lane_offsets(vmask m, int offset[HD_LANES]) {
    vint chosen = pick_int(m, splat_int(1), splat_int(0));
    int count = 0;
    for (int lane = 0; lane < HD_LANES; lane++) {
        offset[lane] = count;
        count += lane_int(&chosen, lane);
    }
    return count;
}

#if HD_REGISTER_512
FN void store_lanes(real *to, vmask m, const int offset[HD_LANES], const vreal *a) {
    (void)offset;
    HD_REALS_512(storeu, )(to, HD_REALS_512(maskz_compress, )(HD_MASK(m), (Reals512)*a));
}
#else
FN void store_lanes(GLOBAL real *to, vmask m, const int offset[HD_LANES], const vreal *a) {
    (void)m;
    for (int lane = 0; lane < HD_LANES; lane++)
        to[offset[lane]] = lane_real(a, lane);
}
#endif
FN void store_lanes_int(GLOBAL int *to, const int offset[HD_LANES], const vint *a) {
    for (int lane = 0; lane < HD_LANES; lane++)
        to[offset[lane]] = lane_int(a, lane);
}

/* What threads share. Where no group of threads works together (HD_GROUP_SIZE is 0), each has
   memory of its own, and an addition is a plain one. */
#if !HD_GROUP_SIZE
FN void add_shared(GLOBAL fixed64 *sum, fixed64 amount) {
    *sum += amount;
}
#elif defined(__OPENCL_C_VERSION__)
#ifdef cl_khr_int64_base_atomics
#pragma OPENCL EXTENSION cl_khr_int64_base_atomics : enable
FN void add_shared(GLOBAL fixed64 *sum, fixed64 amount) {
    atom_add(sum, amount);
}
#endif
FN uint take_shared(GLOBAL uint *counter, uint amount) {
    return atomic_add(counter, amount);
}
#else
FN void add_shared(fixed64 *sum, fixed64 amount) {
    atomicAdd((uint64 *)sum, (uint64)amount);
}
FN uint take_shared(uint *counter, uint amount) {
    return atomicAdd(counter, amount);
}
#endif

#endif
