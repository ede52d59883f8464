/* SPDX-License-Identifier: MIT */
#include "commands.h"
#include "default_scene.h"
#include "rendering.h"

static HdStatus render_frames(const HdOptions *options, const HdScene *scene, HdError *error) {
    HdRendering rendering = {
        .scene = scene,
        .output = options->output ? options->output : "hedron.mp4",
        .device_kind = HD_WANT_ANY,
    };
    HdStatus status = hd_render(&rendering, options, error);
    if (status == HD_OK)
        printf("%s\n", rendering.output);
    return status;
}

HdStatus hd_command_render(const HdOptions *options, HdError *error) {
    HdClassicInput input;
    HdStatus status = hd_default_input(&input, error);
    if (status != HD_OK)
        return status;
    status = hd_apply_scene_options(&input.scene, options, error);
    if (status == HD_OK)
        status = hd_load_floor_texture(&input.scene, input.texture_path, HD_CURVE_LINEAR, error);
    if (status == HD_OK)
        status = render_frames(options, &input.scene, error);
    hd_classic_free(&input);
    return status;
}
