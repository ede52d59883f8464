/* SPDX-License-Identifier: MIT */
/* The tables of a scene and of a frame, as a host has them, and whether they fit into its memory,
   told in words that help where they do not. */
#ifndef HD_TABLES_TABLE_H
#define HD_TABLES_TABLE_H

#include <stdbool.h>
#include <stddef.h>

#include "base/error.h"
#include "base/watch.h"
#include "scene/camera.h"
#include "scene/scene.h"

/* Bytes for a device, laid out as the kernels' structs. Empty tables are allowed. */
typedef struct HdTable {
    void *data;
    size_t bytes;
} HdTable;

typedef enum HdPrecision { HD_PRECISION_FLOAT, HD_PRECISION_DOUBLE } HdPrecision;

/* In the order of HD_SCENE_TABLES; the counts are those that kernels are specialised by. */
typedef struct HdSceneTables {
    HdTable table[32];
    int table_count;
    HdPrecision precision;
    int lanes; /* of the kernels' packets: nodes for single rays have as many children */
    int plane_count, light_count;
    int depth;
    int node_stack;       /* of the hierarchies of meshes; 0: there are no meshes */
    bool refracts;        /* some solid has an index of refraction that is not 1 */
    bool lit_from_behind; /* some material is */
    bool many_lights;  /* so many that one lane may judge those that follow each other together */
    bool small_tables; /* HD_SMALL_SCENE_TABLES and HD_SMALL_FRAME_TABLES have no more rows */
    bool bounded;      /* pixels come with bounds of what was left out */
} HdSceneTables;

/* In the order of HD_FRAME_TABLES. */
typedef struct HdFrameTables {
    HdTable table[4];
    int table_count;
    int width, height;
    int samples; /* of a pixel */
    int floats;  /* that come of a pixel: 3, of surveyed scenes 5 (HdFrame) */
    HdPrecision precision;
    HdWatched watched; /* nobody, unless whoever had the tables compiled fills it in */
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
    double max_left_out; /* of a sample, in all: hd_max_left_out */
} HdSampleList;

enum { HD_LISTED_WIDTH = 8 }; /* of the frame that entries form, row by row */

/* What the scene's table with that number has, in the plural, for messages: "triangles". */
const char *hd_scene_table_content(int table);

/* Makes tables that were compiled claim to need of the kernels what `like` does, too: planes,
   depth, stack of nodes, refraction, light from behind, many lights and surveys; and to be small
   only where `like` is. */
void hd_scene_tables_raise(HdSceneTables *tables, const HdSceneTables *like);

void hd_scene_tables_free(HdSceneTables *tables);
void hd_frame_tables_free(HdFrameTables *tables);

/* Memory */

enum { HD_BYTE_TEXT_SIZE = 32 };

/* For messages: "288 MB", "1.07 GB"; less than a thousand as "16 bytes". */
void hd_byte_text(double bytes, char out[HD_BYTE_TEXT_SIZE]);

/* What users may do where a device has too little memory; ends a sentence. */
extern const char hd_budget_advice[];

typedef struct HdMemoryBudget {
    const char *name;   /* of the device or machine */
    const char *advice; /* what to do where it is too little */
    double memory;      /* bytes in all; 0: unknown */
    double at_once;     /* most bytes of one table; 0: unknown */
} HdMemoryBudget;

/* HD_UNAVAILABLE where a table, or all of them, can never fit, however much is free: with what is
   too large, what it needs, and what there is. */
HdStatus hd_check_budget(const HdSceneTables *tables, const HdMemoryBudget *capacity,
                         HdError *error);

/* Memory for table->bytes, zeroed and aligned for the widest loads; at least one unit, so that no
   table is NULL. `what` names it in a message: "scene's triangles". */
HdStatus hd_table_allocate(HdTable *table, const char *what, HdError *error);

/* Compiles a scene that hd_scene_validate accepted. All geometry is computed in double; differences
   of centres are formed before they are rounded to the kernels' precision. `lanes` is what
   hd_renderer_lanes tells; a scene without meshes may be compiled for any number. HD_UNAVAILABLE
   where this machine has less memory than the tables need, HD_FAILED where it is taken. */
HdStatus hd_compile_scene(HdSceneTables *tables, const HdScene *scene, HdPrecision precision,
                          int lanes, HdError *error);

/* Compiles one frame of the same scene: the samples of the grid, or, of a surveyed scene, those
   that are listed, 1 or more. `list` may be NULL. */
HdStatus hd_compile_frame(HdFrameTables *tables, const HdScene *scene, const HdCamera *camera,
                          HdPrecision precision, const HdSampleList *list, HdError *error);

/* Of a surveyed scene: no more than this, after exposure, is left out of a sample in all. It goes
   through all lights and materials, so ask once for a scene. */
double hd_max_left_out(const HdScene *scene);

#endif
