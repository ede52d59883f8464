/* SPDX-License-Identifier: MIT */
/* Private to the compilation of scenes: src/tables/builder.inc is built once for each precision. */
#ifndef HD_TABLES_BUILDER_H
#define HD_TABLES_BUILDER_H

#include "tables/tables.h"

HdStatus hd_compile_scene_float(HdSceneTables *tables, const HdScene *scene, HdError *error);
HdStatus hd_compile_scene_double(HdSceneTables *tables, const HdScene *scene, HdError *error);
/* `list` is NULL where all pixels have all places of the grid. */
HdStatus hd_compile_frame_float(HdFrameTables *tables, const HdScene *scene, const HdCamera *camera,
                                const HdSampleList *list, HdError *error);
HdStatus hd_compile_frame_double(HdFrameTables *tables, const HdScene *scene,
                                 const HdCamera *camera, const HdSampleList *list, HdError *error);

#endif
