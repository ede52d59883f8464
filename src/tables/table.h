/* SPDX-License-Identifier: MIT */
/* The host's tables of a scene and of a frame, and the check whether they fit into a device's
   memory. */
#ifndef HD_TABLES_TABLE_H
#define HD_TABLES_TABLE_H

#include <stdbool.h>
#include <stddef.h>

#include "base/error.h"
#include "base/watch.h"
#include "scene/camera.h"
#include "scene/scene.h"

/* Bytes for a device, laid out as the kernels' structs; may be empty. */
typedef struct HdTable {
    void *data;
    size_t bytes;
} HdTable;

typedef enum HdPrecision { HD_PRECISION_FLOAT, HD_PRECISION_DOUBLE } HdPrecision;

/* In the order of HD_SCENE_TABLES; kernels are specialised by the counts and flags. */
typedef struct HdSceneTables {
    HdTable table[32];
    int table_count;
    HdPrecision precision;
    int lanes; /* lanes of the kernels' packets; wide nodes have as many children */
    int plane_count, light_count;
    int depth;
    int node_stack;       /* stack entries to traverse mesh hierarchies; 0: no meshes */
    bool refracts;        /* whether some material has an index of refraction other than 1 */
    bool lit_from_behind; /* whether some material is lit from behind */
    bool many_lights;     /* enough for packets of one lane to cull runs */
    bool small_tables;    /* whether they fit HD_SMALL_SCENE_TABLES and HD_SMALL_FRAME_TABLES */
    bool bounded;         /* whether pixels have an error bound */
    bool cut_outs;        /* whether some material of a mesh has holes */
    bool environment;     /* whether rays that hit nothing see a picture */
} HdSceneTables;

/* In the order of HD_FRAME_TABLES. */
typedef struct HdFrameTables {
    HdTable table[4];
    int table_count;
    int width, height;
    int samples; /* of a pixel */
    int floats;  /* floats of a pixel: HD_RADIANCE_FLOATS or HD_BOUNDED_FLOATS */
    HdPrecision precision;
    HdWatched watched; /* nobody, unless the caller sets it after compilation */
} HdFrameTables;

/* The pixels of a listed frame, in any order, in the whole picture. */
typedef struct HdPixelList {
    const int *entries; /* x | y << 16 */
    int entry_count;
    double bound_cutoff; /* rays and lights that add less than this to a sample are left out */
    double max_left_out; /* bound for a sample: hd_max_left_out */
} HdPixelList;

enum { HD_LISTED_WIDTH = 8 }; /* width in pixels of the frame that entries form, row by row */

/* Returns the content of the scene's table with that number for messages, in the plural:
   "triangles". */
const char *hd_scene_table_content(int table);

/* Raises the kernel needs of compiled tables to those of `like`: planes, depth, stack of nodes,
   refraction, light from behind, many lights, error bound, cut-outs and environment. Tables stay
   small only if `like` is. */
void hd_scene_tables_raise(HdSceneTables *tables, const HdSceneTables *like);

void hd_scene_tables_free(HdSceneTables *tables);
void hd_frame_tables_free(HdFrameTables *tables);

/* Memory */

enum { HD_BYTE_TEXT_SIZE = 32 };

/* Formats bytes for messages: "16 bytes" below a thousand, else "288 MB", "1.07 GB". */
void hd_byte_text(double bytes, char out[HD_BYTE_TEXT_SIZE]);

/* Advice to users if a device's memory is too small; ends a sentence. */
extern const char hd_budget_advice[];

typedef struct HdMemoryBudget {
    const char *name;   /* name of the device or machine */
    const char *advice; /* what to do if it is too small */
    double memory;      /* total bytes; 0: unknown */
    double at_once;     /* maximum bytes of one table; 0: unknown */
} HdMemoryBudget;

/* Fails with HD_UNAVAILABLE if a table, or all of them, exceed the budget. */
HdStatus hd_check_budget(const HdSceneTables *tables, const HdMemoryBudget *capacity,
                         HdError *error);

/* Allocates table->bytes, zeroed and aligned to 64 bytes, and never NULL. `what` names the table in
   a message: "scene's triangles". */
HdStatus hd_table_allocate(HdTable *table, const char *what, HdError *error);

/* Compiles a scene that hd_scene_validate accepted; computes geometry and differences of centres in
   double, then rounds them to the kernels' precision. `lanes` is that of hd_renderer_lanes; without
   meshes any number does. Fails with HD_UNAVAILABLE if the tables need more than this machine's
   memory, with HD_FAILED if the allocation fails. */
HdStatus hd_compile_scene(HdSceneTables *tables, const HdScene *scene, HdPrecision precision,
                          int lanes, HdError *error);

/* Compiles one frame of the same scene: all of its samples (`list` is NULL) or, in a scene
   with an error bound, the listed ones, at least 1. */
HdStatus hd_compile_frame(HdFrameTables *tables, const HdScene *scene, const HdCamera *camera,
                          HdPrecision precision, const HdPixelList *list, HdError *error);

/* Returns the bound of all that is left out of a sample, after exposure, in a scene with an error
   bound. Visits all lights and materials, so call it once for a scene. */
double hd_max_left_out(const HdScene *scene);

#endif
