/* SPDX-License-Identifier: MIT */
#include "pipeline.h"

HdPipeline hd_choose_pipeline(const HdDevice *device, const HdRenderOptions *options) {
    (void)device; /* the same everywhere, as far as has been measured */
    return options->pipeline == HD_PIPELINE_AUTO ? HD_PIPELINE_MEGA : options->pipeline;
}

bool hd_pipeline_is_wavefront(HdPipeline pipeline) {
    return pipeline == HD_PIPELINE_WAVEFRONT || pipeline == HD_PIPELINE_WAVEFRONT_UNCOMPACTED;
}

const char *hd_pipeline_name(HdPipeline pipeline) {
    static const char *const names[HD_PIPELINE_COUNT] = {"auto", "mega", "wavefront",
                                                         "wavefront-uncompacted"};
    return names[pipeline];
}
