/* SPDX-License-Identifier: MIT */
#include "device/pipeline.h"

/* So many lights that no distance ends: from here on full bundles are worth the way through a
 * queue. */
enum { MANY_LIGHTS = 100 };

bool hd_megakernel_is_too_long(const HdDevice *device, const HdRenderOptions *options) {
    return options->has_deep_trees && device->has_timeout && !device->is_cpu;
}

HdPipeline hd_choose_pipeline(const HdDevice *device, const HdRenderOptions *options,
                              const HdScene *scene) {
    if (options->pipeline != HD_PIPELINE_AUTO)
        return options->pipeline;
    bool has_many = scene != NULL && hd_scene_endless_light_count(scene) >= MANY_LIGHTS;
    bool is_wavefront =
        device->is_cpu ? has_many
                       : hd_megakernel_is_too_long(device, options) && device->has_wide_atomics;
    return is_wavefront ? HD_PIPELINE_WAVEFRONT : HD_PIPELINE_MEGA;
}

bool hd_pipeline_is_wavefront(HdPipeline pipeline) {
    return pipeline == HD_PIPELINE_WAVEFRONT || pipeline == HD_PIPELINE_WAVEFRONT_UNCOMPACTED;
}

const char *const hd_pipeline_names[HD_PIPELINE_COUNT + 1] = {"auto", "mega", "wavefront",
                                                              "wavefront-uncompacted", NULL};

const char *hd_pipeline_name(HdPipeline pipeline) {
    return hd_pipeline_names[pipeline];
}
