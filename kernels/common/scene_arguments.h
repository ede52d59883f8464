/* SPDX-License-Identifier: MIT */
/* How functions hand the tables on (structs hold no pointers), how lists of arguments become
   parameters, the bounds of private arrays, and what the scene needs at all. */
#ifndef HD_SCENE_ARGUMENTS_H
#define HD_SCENE_ARGUMENTS_H

#include "kernel_arguments.h"
#include "scene_tables.h"

/* What a list of kernel_arguments.h is in a list of parameters and in a call. */
#define HD_PARAMETER_INPUT(type, name)      GLOBAL const type *RESTRICT name
#define HD_PARAMETER_BUFFER(type, name)     GLOBAL type *RESTRICT name
#define HD_PARAMETER_NUMBER(type, name)     type name
#define HD_LAST_PARAMETER(kind, type, name) HD_PARAMETER_##kind(type, name)
#define HD_PARAMETER(kind, type, name)      HD_PARAMETER_##kind(type, name),
#define HD_ARGUMENT(kind, type, name)       name,

#define HD_TABLE_PARAMETER(type, name) GLOBAL const type *RESTRICT name,
#define HD_TABLE_ARGUMENT(type, name)  name,

/* Both end with a comma: f(SCENE_PARAMETERS int x) is called as f(SCENE_ARGUMENTS 1). */
#define SCENE_PARAMETERS HD_SCENE_TABLES(HD_TABLE_PARAMETER) HD_FRAME_TABLES(HD_TABLE_PARAMETER)
#define SCENE_ARGUMENTS  HD_SCENE_TABLES(HD_TABLE_ARGUMENT) HD_FRAME_TABLES(HD_TABLE_ARGUMENT)

/* Likewise of what tells where a frame's samples are. */
#define SAMPLE_PARAMETERS                                                                          \
    GLOBAL const View *RESTRICT view, GLOBAL const int *RESTRICT entries,                          \
        GLOBAL const int *RESTRICT sample_places,
#define SAMPLE_ARGUMENTS view, entries, sample_places,

/* Every solid has three planes at least. Constants where the kernels are built at run time,
 * otherwise the scene's own numbers. */
#ifdef HD_PLANE_BOUND
#define PLANE_BOUND(header)     HD_PLANE_BOUND
#define SOLID_BOUND(header)     (HD_PLANE_BOUND / 3 + 1)
#define DEPTH_BOUND(view)       HD_DEPTH_BOUND
#define REFRACTS(header)        HD_REFRACTS
#define LIT_FROM_BEHIND(header) HD_LIT_FROM_BEHIND
#define MANY_LIGHTS(header)     HD_MANY_LIGHTS
#define SURVEYED(header)        HD_SURVEYED
#define PIXEL_SUMS              (HD_SURVEYED ? HD_SURVEY_SUMS : HD_RADIANCE_SUMS)
#define MESHES(header)          (HD_NODE_STACK > 0 && (header)->instance_count > 0)
#define NODE_STACK(header)      (HD_NODE_STACK + 1)
#define WIDE_STACK(header)      (HD_WIDE_STACK + 1)
#else
#ifndef HD_PLAIN
#define HD_PLAIN 0
#endif
#define PLANE_BOUND(header)     ((header)->plane_count + 1)
#define SOLID_BOUND(header)     ((header)->solid_count + 1)
#define DEPTH_BOUND(view)       ((view)->depth + 1)
#define REFRACTS(header)        (!HD_PLAIN && (header)->refracts)
#define LIT_FROM_BEHIND(header) (!HD_PLAIN && (header)->lit_from_behind)
#define MANY_LIGHTS(header)     1
#define SURVEYED(header)        ((header)->surveyed)
#define PIXEL_SUMS              HD_SURVEY_SUMS
#define MESHES(header)          (!HD_PLAIN && (header)->instance_count > 0)
#define NODE_STACK(header)      ((header)->node_stack + 1)
#define WIDE_STACK(header)      ((header)->wide_stack + 1)
#endif

#endif
