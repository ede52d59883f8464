/* SPDX-License-Identifier: MIT */
/* The scene of a golden frame as a picture of 16 x 16 pixels. */
#ifndef HD_TEST_SMALL_SCENE_H
#define HD_TEST_SMALL_SCENE_H

#include "verify/golden.h"

static inline HdStatus small_scene(HdScene *scene, const char *golden, HdError *error) {
    HdCamera unused;
    HdStatus status = hd_golden_build(hd_golden_find(golden), scene, &unused, error);
    if (status == HD_OK)
        scene->width = scene->height = 16;
    return status;
}

#endif
