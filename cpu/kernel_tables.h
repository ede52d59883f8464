/* SPDX-License-Identifier: MIT */
/* How the tables that the host hands over become the kernels' variables of the same names, in C. */
#ifndef HD_CPU_KERNEL_TABLES_H
#define HD_CPU_KERNEL_TABLES_H

#include "kernels/common/scene_tables.h"

#define HD_TABLE_FROM_SCENE(type, name)                                                            \
    const type *name = scene[HD_TABLE_##name].data;                                                \
    (void)name;
#define HD_TABLE_FROM_FRAME(type, name)                                                            \
    const type *name = frame[HD_TABLE_##name].data;                                                \
    (void)name;

/* Declares all of them, from the parameters `scene` and `frame`, const HdTable * both. */
#define HD_DECLARE_TABLES                                                                          \
    HD_SCENE_TABLES(HD_TABLE_FROM_SCENE)                                                           \
    HD_FRAME_TABLES(HD_TABLE_FROM_FRAME)

#endif
