/* SPDX-License-Identifier: MIT */
/* A scene turned into the tables that kernels read (kernels/common/scene_tables.h). */
#ifndef HD_TABLES_TABLES_H
#define HD_TABLES_TABLES_H

#include <stddef.h>

#include "base/error.h"
#include "scene/camera.h"
#include "scene/scene.h"

typedef enum HdPrecision { HD_PRECISION_FLOAT, HD_PRECISION_DOUBLE } HdPrecision;

/* Bytes for a device, laid out as the kernels' structs. Empty tables are allowed. */
typedef struct HdTable {
    void *data;
    size_t bytes;
} HdTable;

/* In the order of HD_SCENE_TABLES; the counts are those that kernels are specialised by. */
typedef struct HdSceneTables {
    HdTable table[32];
    int table_count;
    HdPrecision precision;
    int lanes; /* of the kernels' bundles: nodes for single rays have as many children */
    int plane_count;
    int depth;
    int node_stack;       /* of the hierarchies of meshes; 0: there are no meshes */
    bool refracts;        /* some solid has an index of refraction that is not 1 */
    bool lit_from_behind; /* some material is */
    bool surveyed;        /* pixels come with bounds of what was left out and with identities */
} HdSceneTables;

/* In the order of HD_FRAME_TABLES. */
typedef struct HdFrameTables {
    HdTable table[4];
    int table_count;
    int width, height;
    int samples; /* of a pixel */
    int floats;  /* that come of a pixel: 3, of surveyed scenes 5 (HdFrame) */
    HdPrecision precision;
} HdFrameTables;

/* The pixels of a listed frame, of the whole picture and in any order, and the samples of each. */
typedef struct HdSampleList {
    const int *entries; /* two numbers for each: x | y << 16, and the first sample in `places` */
    int entry_count;
    const int *places; /* of samples in their pixel: column | row << 16 */
    int place_count;
    int grid_side; /* columns and rows are less */
    int samples;   /* of each entry: those that follow the first one */
    double
        bound_cutoff; /* rays and lights that cannot add more than this to a sample are left out */
} HdSampleList;

enum { HD_LISTED_WIDTH = 8 }; /* of the frame that entries form, row by row */

/* Compiles a scene that hd_scene_validate accepted. All geometry is computed in double; differences
   of centres are formed before they are rounded to the kernels' precision. `lanes` is what
   hd_renderer_lanes tells; a scene without meshes may be compiled for any number. HD_UNAVAILABLE
   where this machine has less memory than the tables need, HD_FAILED where it is taken. */
HdStatus hd_compile_scene(HdSceneTables *tables, const HdScene *scene, HdPrecision precision,
                          int lanes, HdError *error);
void hd_scene_tables_free(HdSceneTables *tables);

/* What the table with that number has, in the plural, for messages: "triangles". */
const char *hd_scene_table_content(int table);

/* The tables of one frame of the same scene. */
HdStatus hd_compile_frame(HdFrameTables *tables, const HdScene *scene, const HdCamera *camera,
                          HdPrecision precision, HdError *error);

/* The same with the listed samples, 1 or more, of a surveyed scene. */
HdStatus hd_compile_listed_frame(HdFrameTables *tables, const HdScene *scene,
                                 const HdCamera *camera, HdPrecision precision,
                                 const HdSampleList *list, HdError *error);

void hd_frame_tables_free(HdFrameTables *tables);

#endif
