/* SPDX-License-Identifier: MIT */
#include "commands.h"
#include "default_scene.h"
#include "progress.h"
#include "rendering.h"

enum { FRAMES_PER_SECOND = 30 };

static HdStatus show_progress(void *context, int number, int done, const HdFrame *frame,
                              double seconds, HdError *error) {
    (void)number;
    (void)frame;
    (void)seconds;
    (void)error;
    hd_progress_update(context, done);
    return HD_OK;
}

static HdStatus render_frames(const HdOptions *options, const HdScene *scene, HdError *error) {
    HdFrameList frames;
    HdStatus status = hd_frame_list_parse(&frames, options->frames, scene->frame_count, error);
    if (status != HD_OK)
        return status;
    HdProgress progress = hd_progress_start(frames.count);
    HdSequence sequence = {
        .scene = scene,
        .frames = &frames,
        .precision = options->render.precision,
        .output = options->output ? options->output : "hedron.mp4",
        .frames_per_second = FRAMES_PER_SECOND,
        .stored = show_progress,
        .context = &progress,
    };
    HdDeviceWish wish = {.backend = options->backend, .device = options->device};
    status = hd_render_sequence(&sequence, options, &wish, error);
    hd_progress_end(&progress);
    hd_frame_list_free(&frames);
    if (status == HD_OK)
        printf("%s\n", sequence.output);
    return status;
}

HdStatus hd_command_render(const HdOptions *options, HdError *error) {
    HdClassicInput input;
    HdStatus status = hd_default_input(&input, error);
    if (status != HD_OK)
        return status;
    status = hd_apply_scene_options(&input.scene, options, error);
    if (status == HD_OK)
        status = hd_load_floor_texture(&input.scene, input.texture_path, error);
    if (status == HD_OK)
        status = render_frames(options, &input.scene, error);
    hd_classic_free(&input);
    return status;
}
