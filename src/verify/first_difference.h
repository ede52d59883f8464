/* SPDX-License-Identifier: MIT */
/* Where a frame that a device renders wrongly departs from plain C's. */
#ifndef HD_VERIFY_FIRST_DIFFERENCE_H
#define HD_VERIFY_FIRST_DIFFERENCE_H

#include "device/renderer.h"
#include "scene/camera.h"

typedef struct HdMismatch {
    const HdDevice *device;
    const HdRenderOptions *options; /* of the device's renderer */
    const HdSceneTables *like; /* what its kernels were built for, too (hd_scene_tables_raise) */
    /* Builds the scene anew from `what`; the caller frees it. */
    HdStatus (*build)(const void *what, HdScene *scene, HdCamera *camera, HdError *error);
    const void *what;
} HdMismatch;

/* Writes in words the first pixel that differs, its sample, the least depth of the ray at which the
   frame does, and the values, rendered by the kernels that failed; or that the device renders the
   frame as plain C does; or why that could not be found out. Depths count from 0, what the eye
   sees; pixels and samples from 0 on, as in the frame that was given. */
HdStatus hd_first_difference(const HdMismatch *mismatch, char *text, size_t capacity,
                             HdError *error);

#endif
