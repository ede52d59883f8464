/* SPDX-License-Identifier: MIT */
/* Where a frame that a device renders wrongly departs first from plain C's: the pixel, the sample,
   the level of the tree of rays, and what is wrong there. The device renders it with the kernels
   that failed, each time with less in the scene, so that what is found holds for these. */
#ifndef HD_CERTIFY_FIRST_DIFFERENCE_H
#define HD_CERTIFY_FIRST_DIFFERENCE_H

#include "device/renderer.h"
#include "scene/camera.h"

typedef struct HdDispute {
    const HdDevice *device;
    HdPrecision precision;
    HdPipeline pipeline;
    const HdSceneTables *like; /* what its kernels were built for, too (hd_scene_tables_raise) */
    /* Builds the scene anew from `what`; the caller frees it. */
    HdStatus (*build)(const void *what, HdScene *scene, HdCamera *camera, HdError *error);
    const void *what;
} HdDispute;

/* Writes it in words, "" where the device renders the frame as plain C does. Levels count from 0,
   what the eye sees; pixels and samples from 0 at the top left. */
HdStatus hd_first_difference(const HdDispute *dispute, char *text, size_t capacity, HdError *error);

#endif
