/* SPDX-License-Identifier: MIT */
#include "pipeline.h"

/* So many lights that no distance ends: from here on full bundles are worth the way through a
 * queue. */
enum { MANY_LIGHTS = 100 };

HdPipeline hd_choose_pipeline(const HdDevice *device, const HdRenderOptions *options,
                              const HdScene *scene) {
    if (options->pipeline != HD_PIPELINE_AUTO)
        return options->pipeline;
    bool has_many = scene != NULL && hd_scene_endless_light_count(scene) >= MANY_LIGHTS;
    /* The megakernel traces a whole tree in one launch, which nothing can cut. */
    bool must_be_cut = options->has_deep_trees && device->has_timeout && device->has_wide_atomics;
    return (device->is_cpu ? has_many : must_be_cut) ? HD_PIPELINE_WAVEFRONT : HD_PIPELINE_MEGA;
}

bool hd_pipeline_is_wavefront(HdPipeline pipeline) {
    return pipeline == HD_PIPELINE_WAVEFRONT || pipeline == HD_PIPELINE_WAVEFRONT_UNCOMPACTED;
}

const char *hd_pipeline_name(HdPipeline pipeline) {
    static const char *const names[HD_PIPELINE_COUNT] = {"auto", "mega", "wavefront",
                                                         "wavefront-uncompacted"};
    return names[pipeline];
}
