/* SPDX-License-Identifier: MIT */
/* Small scenes as the kernels read them. */
#ifndef HD_BENCH_COMPILED_H
#define HD_BENCH_COMPILED_H

#include "tables/table.h"

/* What every face does with a ray. */
typedef enum HdFaceKind { HD_FACE_MIRROR, HD_FACE_CLEAR, HD_FACE_OPAQUE } HdFaceKind;

typedef struct HdCompiled {
    HdScene scene;
    HdSceneTables tables;
    HdFrameTables frame; /* of the eye that was put last */
} HdCompiled;

/* A solid without rims and lights. */
HdSolid hd_plain_solid(HdSolidKind kind, HdVec3 centre, double radius, HdVec3 degrees,
                       HdFaceKind faces);

/* A scene that holds nothing but such solids and `lights` point lights of intensity 1 (positions
   are to be set). False where memory runs out, which it prints. */
bool hd_compiled_begin(HdCompiled *compiled, const HdSolid *solids, int count, int lights);

/* Adds a square floor of the first solid's material; height and half its side in sizes of `scale`
   about the centre. */
void hd_compiled_put_floor(HdCompiled *compiled, HdVec3 centre, double scale, double height,
                           double half_side);

/* Compiles the scene as it is then. What is wrong is printed. */
bool hd_compiled_finish(HdCompiled *compiled, HdPrecision precision, HdGeometry geometry);

/* Tables of a frame with the eye there. */
bool hd_compiled_look(HdCompiled *compiled, HdVec3 eye);

void hd_compiled_free(HdCompiled *compiled);

#endif
