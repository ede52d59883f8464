/* SPDX-License-Identifier: MIT */
/* Models made by formulas, of any number of triangles. Their shape does not depend on that number,
   nor their bytes on the machine. All lie within 1.2 of the origin. */
#ifndef HD_MODEL_H
#define HD_MODEL_H

#include "obj_writer.h"

enum { HD_MODEL_LEAST = 12, HD_MODEL_MOST = 10000000 };

typedef struct HdModel {
    const char *name;
    const char *summary;

    /* Returns the number of triangles for `wanted`, HD_MODEL_LEAST..HD_MODEL_MOST: as close as the
       model's grid allows. */
    int (*triangles)(int wanted);

    /* Writes vertices and triangles. */
    void (*write)(HdObjWriter *writer, int wanted);
} HdModel;

extern const HdModel hd_model_sphere, hd_model_knot, hd_model_soup;

#endif
