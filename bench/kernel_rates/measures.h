/* SPDX-License-Identifier: MIT */
/* What is measured: the loops of a build with scenes to work on. */
#ifndef HD_BENCH_MEASURES_H
#define HD_BENCH_MEASURES_H

#include <stdbool.h>

#include "loops.h"

/* The tables of a scene's first frame. */
typedef struct HdLoopScene {
    const char *name;        /* of its file, without folder and ending */
    HdSceneTables tables[2]; /* for bundles; for single lanes */
    HdFrameTables frame;
} HdLoopScene;

typedef struct HdMeasure {
    char name[96];
    const char *unit; /* of what is done */
    const HdLoops *loops;
    const HdLoopScene *scene; /* NULL: an arithmetic peak */
    HdWork work;
    enum { HD_MEASURE_SEARCH, HD_MEASURE_LIGHT, HD_MEASURE_FMA, HD_MEASURE_MUL_ADD } what;
} HdMeasure;

/* Reads a scene file, for bundles of so many lanes; without `floor` its floor is left out. Prints
   what is wrong and returns false on failure. */
bool hd_loop_scene_read(HdLoopScene *scene, const char *path, bool floor, int lanes);

/* The scene's tables for kernels of so many lanes: those that it was read for, or one. */
const HdTable *hd_loop_scene_tables(const HdLoopScene *scene, int lanes);

void hd_loop_scene_free(HdLoopScene *scene);

/* Does the measure's work once, and returns how much it was, in its unit. */
double hd_measure_run(const HdMeasure *measure);

/* Its work for a second of the processor's time, from at least `seconds` of it. */
double hd_measure_rate(const HdMeasure *measure, double seconds);

#endif
