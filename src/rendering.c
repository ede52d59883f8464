/* SPDX-License-Identifier: MIT */
#include "rendering.h"

#include <stdio.h>
HdStatus hd_apply_scene_options(HdScene *scene, const HdOptions *options, HdError *error) {
    if (options->width > 0) {
        scene->width = options->width;
        scene->height = options->height;
    }
    if (options->samples > 0)
        scene->samples_per_side = options->samples;
    if (options->depth >= 0)
        scene->depth = options->depth;
    if (options->cutoff >= 0.0)
        scene->cutoff = options->cutoff;
    return hd_scene_validate(scene, error);
}

HdStatus hd_render_sequence(const HdSequence *sequence, const HdOptions *options,
                            const HdDeviceWish *wish, HdError *error) {
    HdDevice device;
    HdRenderer *renderer;
    char note[512];
    HdStatus status = hd_sequence_check(sequence, error);
    if (status == HD_OK)
        status = hd_choose_device(&device, wish, &options->render, note, error);
    if (status != HD_OK)
        return status;
    if (note[0] != '\0')
        fprintf(stderr, "hedron: %s\n", note);
    status = hd_renderer_open(&renderer, &device, &options->render, error);
    if (status != HD_OK)
        return status;
    status = hd_sequence_render(sequence, renderer, error);
    hd_renderer_close(renderer);
    return status;
}
