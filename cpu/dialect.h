/* SPDX-License-Identifier: MIT */
/* The dialect of the kernels (kernels/common/dialect.h) in C. */
#ifndef HD_CPU_DIALECT_H
#define HD_CPU_DIALECT_H

#include "kernels/host/shared.h"

#if HD_DOUBLE
#define HD_FMA_SCALAR  __builtin_fma
#define HD_SQRT_SCALAR __builtin_sqrt
#else
#define HD_FMA_SCALAR  __builtin_fmaf
#define HD_SQRT_SCALAR __builtin_sqrtf
#endif

#if HD_LANES > 1
#include "cpu/packets.h"
#else

#include "kernels/common/lanes.h"

FN vbits bits_of(vreal a) {
    vbits b;
    __builtin_memcpy(&b, &a, sizeof b);
    return b;
}
FN vreal from_bits(vbits a) {
    vreal b;
    __builtin_memcpy(&b, &a, sizeof b);
    return b;
}
FN vreal multiply_add(vreal a, vreal b, vreal c) {
    return HD_FMA_SCALAR(a, b, c);
}
FN vreal built_in_root(vreal a) {
    return HD_SQRT_SCALAR(a);
}

#endif

FN vreal absolute(vreal a) {
    return from_bits(bits_of(a) & ~bits_of(splat(R(-0.0))));
}
FN int lowest_bit(uint bits) {
    return __builtin_ctz(bits);
}
FN int count_bits(uint bits) {
    return __builtin_popcount(bits);
}
#define HD_OWN_PREFETCH
FN void prefetch_bytes(const char *from, int count) {
    enum { CACHE_LINE = 64 };
    for (int i = 0; i < count; i += CACHE_LINE)
        __builtin_prefetch(from + i);
}

/* Declare a kernel's variable for the host's table of the same name. */
#define HD_TABLE_FROM_SCENE(type, name)                                                            \
    const type *name = hd_scene_tables[HD_TABLE_##name].data;                                      \
    (void)name;
#define HD_TABLE_FROM_FRAME(type, name)                                                            \
    const type *name = hd_frame_tables[HD_TABLE_##name].data;                                      \
    (void)name;

/* Declares all tables, for SCENE_ARGUMENTS; `scene` and `frame` are const HdTable *. */
#define HD_DECLARE_TABLES(scene, frame)                                                            \
    const HdTable *hd_scene_tables = (scene), *hd_frame_tables = (frame);                          \
    HD_SCENE_TABLES(HD_TABLE_FROM_SCENE)                                                           \
    HD_FRAME_TABLES(HD_TABLE_FROM_FRAME)

#endif
