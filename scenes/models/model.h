/* SPDX-License-Identifier: MIT */
/* Models that are made by formulas, of as many triangles as wanted. Their shape does not depend on
   that number, and their bytes on no machine. All lie within 1.2 of the origin. */
#ifndef HD_MODEL_H
#define HD_MODEL_H

#include "obj_writer.h"

enum { HD_MODEL_LEAST = 12, HD_MODEL_MOST = 10000000 };

typedef struct HdModel {
    const char *name;
    const char *summary;

    /* How many triangles there will be where `wanted`, HD_MODEL_LEAST..HD_MODEL_MOST, are asked
       for: as close as the model's grid allows. */
    int (*triangles)(int wanted);

    /* Writes vertices and triangles. */
    void (*write)(HdObjWriter *writer, int wanted);
} HdModel;

extern const HdModel hd_model_sphere, hd_model_knot, hd_model_soup;

#endif
