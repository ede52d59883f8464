/* SPDX-License-Identifier: MIT */
/* Where a frame that a device renders wrongly departs from plain C's, with as little as possible
   left in the scene. */
#ifndef HD_VERIFY_FIRST_DIFFERENCE_H
#define HD_VERIFY_FIRST_DIFFERENCE_H

#include "device/renderer.h"
#include "scene/camera.h"

typedef struct HdDispute {
    const HdDevice *device;
    const HdRenderOptions *options; /* of the device's renderer */
    const HdSceneTables *like; /* what its kernels were built for, too (hd_scene_tables_raise) */
    /* Builds the scene anew from `what`; the caller frees it. */
    HdStatus (*build)(const void *what, HdScene *scene, HdCamera *camera, HdError *error);
    const void *what;
} HdDispute;

/* Takes solids, lights, meshes, levels of rays, samples and pixels away, one after the other, as
   long as the frame still differs (Zeller and Hildebrandt 2002, Simplifying and Isolating
   Failure-Inducing Input), always with the kernels that failed. Writes in words the pixel, the
   sample, the depth of the ray and the values, and what of the scene is left; "" where the device
   renders the frame as plain C does. Depths count from 0, what the eye sees; pixels, samples and
   what is in the scene from 0 on, as in the frame that was given. */
HdStatus hd_first_difference(const HdDispute *dispute, char *text, size_t capacity, HdError *error);

#endif
