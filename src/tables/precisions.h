/* SPDX-License-Identifier: MIT */
/* The compilation of scenes and frames in each precision (tables.h); src/tables/compile_*.c. */
#ifndef HD_TABLES_PRECISIONS_H
#define HD_TABLES_PRECISIONS_H

#include "scene/camera.h"
#include "scene/scene.h"
#include "tables/table.h"

HdStatus hd_compile_scene_float(HdSceneTables *tables, const HdScene *scene, HdError *error);
HdStatus hd_compile_scene_double(HdSceneTables *tables, const HdScene *scene, HdError *error);
/* `list` is NULL where all pixels have all places of the grid. */
HdStatus hd_compile_frame_float(HdFrameTables *tables, const HdScene *scene, const HdCamera *camera,
                                const HdSampleList *list, HdError *error);
HdStatus hd_compile_frame_double(HdFrameTables *tables, const HdScene *scene,
                                 const HdCamera *camera, const HdSampleList *list, HdError *error);

#endif
