/* SPDX-License-Identifier: MIT */
/* Small scenes as the kernels read them. */
#ifndef HD_BENCH_COMPILED_H
#define HD_BENCH_COMPILED_H

#include "tables/table.h"

/* Effect of every face on a ray. */
typedef enum HdFaceKind { HD_FACE_MIRROR, HD_FACE_CLEAR, HD_FACE_OPAQUE } HdFaceKind;

typedef struct HdCompiled {
    HdScene scene;
    HdSceneTables tables;
    HdFrameTables frame; /* frame of the last eye */
} HdCompiled;

/* Returns a solid without rims and lights. */
HdSolid hd_plain_solid(HdSolidKind kind, HdVec3 centre, double radius, HdVec3 degrees,
                       HdFaceKind faces);

/* Makes a scene of such solids and `lights` point lights of intensity 1, whose positions the caller
   sets. Returns false and prints a message if memory runs out. */
bool hd_compiled_begin(HdCompiled *compiled, const HdSolid *solids, int count, int lights);

/* Adds a square floor of the first solid's material; height and half its side in sizes of `scale`
   about the centre. */
void hd_compiled_put_floor(HdCompiled *compiled, HdVec3 centre, double scale, double height,
                           double half_side);

/* Compiles the current scene. Prints the problem on failure. */
bool hd_compiled_finish(HdCompiled *compiled, HdPrecision precision, HdGeometry geometry);

/* Makes the tables of a frame with the eye at this place. */
bool hd_compiled_look(HdCompiled *compiled, HdVec3 eye);

void hd_compiled_free(HdCompiled *compiled);

#endif
