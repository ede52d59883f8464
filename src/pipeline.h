/* SPDX-License-Identifier: MIT */
/* Which way of tracing the tree of rays a renderer takes. */
#ifndef HD_PIPELINE_H
#define HD_PIPELINE_H

#include "backend.h"

/* What `options` come to on that device: never HD_PIPELINE_AUTO. */
HdPipeline hd_choose_pipeline(const HdDevice *device, const HdRenderOptions *options);

/* True for both kinds of wavefront. */
bool hd_pipeline_is_wavefront(HdPipeline pipeline);

/* As on the command line. */
const char *hd_pipeline_name(HdPipeline pipeline);

#endif
