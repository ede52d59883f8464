/* SPDX-License-Identifier: MIT */
/* Finds where a frame that a device renders wrongly departs from plain C's. */
#ifndef HD_VERIFY_FIRST_DIFFERENCE_H
#define HD_VERIFY_FIRST_DIFFERENCE_H

#include "device/renderer.h"
#include "scene/camera.h"

typedef struct HdMismatch {
    const HdDevice *device;
    const HdRenderOptions *options; /* options of the device's renderer */
    const HdSceneTables *like;      /* additional needs of its kernels (hd_scene_tables_raise) */
    /* Builds the scene from `what`; the caller frees it. */
    HdStatus (*build)(const void *what, HdScene *scene, HdCamera *camera, HdError *error);
    const void *what;
} HdMismatch;

/* Reports the first pixel that differs, its sample, the least ray depth at which the frame differs,
   and the values, rendered by the failing kernels. Reports instead that the device agrees with
   plain C, or why the search failed. Depths count from 0, the primary ray; pixels and samples from
   0, as in the given frame. */
HdStatus hd_first_difference(const HdMismatch *mismatch, char *text, size_t capacity,
                             HdError *error);

#endif
