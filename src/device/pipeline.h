/* SPDX-License-Identifier: MIT */
/* Which way of tracing the tree of rays a renderer takes. */
#ifndef HD_DEVICE_PIPELINE_H
#define HD_DEVICE_PIPELINE_H

#include "device/backend.h"
#include "scene/scene.h"

/* What `options` come to on that device: never HD_PIPELINE_AUTO. Where they leave the choice, a CPU
   takes the wavefront for a scene whose shading has most of the time (docs/performance.md), a GPU
   with 64-bit atomics whose driver may end long kernels for deep trees (docs/backends.md,
   Launches), and otherwise the megakernel is taken. `scene` may be NULL: not known. */
HdPipeline hd_choose_pipeline(const HdDevice *device, const HdRenderOptions *options,
                              const HdScene *scene);

/* Whether the megakernel could keep that device, which may be drawing a display, for too long: it
   traces a whole tree in one launch, which nothing can cut. */
bool hd_megakernel_is_too_long(const HdDevice *device, const HdRenderOptions *options);

/* True for both kinds of wavefront. */
bool hd_pipeline_is_wavefront(HdPipeline pipeline);

/* As on the command line, by HdPipeline; NULL ends them. */
extern const char *const hd_pipeline_names[HD_PIPELINE_COUNT + 1];
const char *hd_pipeline_name(HdPipeline pipeline);

#endif
