/* SPDX-License-Identifier: MIT */
/* Which way of tracing the tree of rays a renderer takes. */
#ifndef HD_PIPELINE_H
#define HD_PIPELINE_H

#include "backend.h"
#include "scene.h"

/* The pipeline that suits a scene on a device where nothing was measured and nobody asked for one:
   on a CPU the wavefront where shading has most of the time (docs/performance.md), else the
   megakernel. */
HdPipeline hd_pipeline_of_scene(const HdDevice *device, const HdScene *scene);

/* What `options` come to on that device: never HD_PIPELINE_AUTO. */
HdPipeline hd_choose_pipeline(const HdDevice *device, const HdRenderOptions *options);

/* True for both kinds of wavefront. */
bool hd_pipeline_is_wavefront(HdPipeline pipeline);

/* As on the command line. */
const char *hd_pipeline_name(HdPipeline pipeline);

#endif
