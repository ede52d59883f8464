/* SPDX-License-Identifier: MIT */
/* How functions hand the tables on (structs hold no pointers), and the bounds of private arrays. */
#ifndef HD_SCENE_ARGUMENTS_H
#define HD_SCENE_ARGUMENTS_H

#include "scene_tables.h"

#define HD_TABLE_PARAMETER(type, name) GLOBAL const type *RESTRICT name,
#define HD_TABLE_ARGUMENT(type, name)  name,

/* Both end with a comma: f(SCENE_PARAMETERS int x) is called as f(SCENE_ARGUMENTS 1). */
#define SCENE_PARAMETERS HD_SCENE_TABLES(HD_TABLE_PARAMETER) HD_FRAME_TABLES(HD_TABLE_PARAMETER)
#define SCENE_ARGUMENTS  HD_SCENE_TABLES(HD_TABLE_ARGUMENT) HD_FRAME_TABLES(HD_TABLE_ARGUMENT)

/* Constants where the build is specialised for a scene, otherwise the scene's own numbers. */
#ifdef HD_PLANE_COUNT
#define PLANE_BOUND (HD_PLANE_COUNT + 1)
#else
#define PLANE_BOUND (header->plane_count + 1)
#endif
#ifdef HD_DEPTH
#define LEVEL_BOUND (HD_DEPTH + 1)
#else
#define LEVEL_BOUND (view->depth + 1)
#endif

#endif
