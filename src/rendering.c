/* SPDX-License-Identifier: MIT */
#include "rendering.h"

#include <stdio.h>

#include "progress.h"

enum { FRAMES_PER_SECOND = 30 };

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

typedef struct Run {
    const HdRendering *rendering;
    HdProgress progress;
} Run;

static HdStatus frame_stored(void *context, int number, int done, const HdFrame *frame,
                             double seconds, HdError *error) {
    const Run *run = context;
    HdStatus status = HD_OK;
    if (run->rendering->stored != NULL)
        status = run->rendering->stored(number, frame, seconds, error);
    if (status == HD_OK)
        hd_progress_update(&run->progress, done);
    return status;
}

static HdStatus render_sequence(const HdSequence *sequence, const HdDeviceWish *wish,
                                const HdRenderOptions *options, HdError *error) {
    HdDevice device;
    HdRenderer *renderer;
    char note[512];
    HdStatus status = hd_sequence_check(sequence, error);
    if (status == HD_OK)
        status = hd_choose_device(&device, wish, options, note, error);
    if (status != HD_OK)
        return status;
    if (note[0] != '\0')
        fprintf(stderr, "hedron: %s\n", note);
    status = hd_renderer_open(&renderer, &device, options, error);
    if (status != HD_OK)
        return status;
    status = hd_sequence_render(sequence, renderer, error);
    hd_renderer_close(renderer);
    return status;
}

HdStatus hd_render(const HdRendering *rendering, const HdOptions *options, HdError *error) {
    const HdScene *scene = rendering->scene;
    HdFrameList frames;
    HdStatus status = hd_frame_list_parse(&frames, options->frames, scene->frame_count, error);
    if (status != HD_OK)
        return status;
    Run run = {.rendering = rendering, .progress = hd_progress_start(frames.count)};
    HdSequence sequence = {
        .scene = scene,
        .frames = &frames,
        .precision = options->render.precision,
        .output = rendering->output,
        .frames_per_second = FRAMES_PER_SECOND,
        .stored = frame_stored,
        .context = &run,
    };
    HdDeviceWish wish = {
        .backend = options->backend,
        .device = options->device,
        .kind = rendering->device_kind,
    };
    status = render_sequence(&sequence, &wish, &options->render, error);
    hd_progress_end(&run.progress);
    hd_frame_list_free(&frames);
    return status;
}
