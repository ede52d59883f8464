/* SPDX-License-Identifier: MIT */
/* A scene turned into the tables that kernels read (kernels/common/scene_tables.h). */
#ifndef HD_TABLES_TABLES_H
#define HD_TABLES_TABLES_H

#include "scene/camera.h"
#include "scene/scene.h"
#include "tables/table.h"

/* Compiles a scene that hd_scene_validate accepted. All geometry is computed in double; differences
   of centres are formed before they are rounded to the kernels' precision. `lanes` is what
   hd_renderer_lanes tells; a scene without meshes may be compiled for any number. HD_UNAVAILABLE
   where this machine has less memory than the tables need, HD_FAILED where it is taken. */
HdStatus hd_compile_scene(HdSceneTables *tables, const HdScene *scene, HdPrecision precision,
                          int lanes, HdError *error);

/* The tables of one frame of the same scene. */
HdStatus hd_compile_frame(HdFrameTables *tables, const HdScene *scene, const HdCamera *camera,
                          HdPrecision precision, HdError *error);

/* Of a surveyed scene: no more than this, after exposure, is left out of a sample in all. It goes
   through all lights and materials, so ask once for a scene. */
double hd_most_left_out(const HdScene *scene);

/* The same with the listed samples, 1 or more, of a surveyed scene. */
HdStatus hd_compile_listed_frame(HdFrameTables *tables, const HdScene *scene,
                                 const HdCamera *camera, HdPrecision precision,
                                 const HdSampleList *list, HdError *error);

#endif
