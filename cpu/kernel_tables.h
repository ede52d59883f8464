/* SPDX-License-Identifier: MIT */
/* How the tables that the host hands over become the kernels' variables of the same names, in C. */
#ifndef HD_CPU_KERNEL_TABLES_H
#define HD_CPU_KERNEL_TABLES_H

#include "cpu/dialect.h"

#include "kernels/common/scene_tables.h"

#define HD_TABLE_FROM_SCENE(type, name)                                                            \
    const type *name = hd_scene_tables[HD_TABLE_##name].data;                                      \
    (void)name;
#define HD_TABLE_FROM_FRAME(type, name)                                                            \
    const type *name = hd_frame_tables[HD_TABLE_##name].data;                                      \
    (void)name;

/* Declares all of them, for SCENE_ARGUMENTS; `scene` and `frame` are const HdTable *. */
#define HD_DECLARE_TABLES(scene, frame)                                                            \
    const HdTable *hd_scene_tables = (scene), *hd_frame_tables = (frame);                          \
    HD_SCENE_TABLES(HD_TABLE_FROM_SCENE)                                                           \
    HD_FRAME_TABLES(HD_TABLE_FROM_FRAME)

#endif
