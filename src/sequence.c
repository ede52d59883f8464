/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "sequence.h"

#include <stdio.h>
#include <string.h>

#include "camera.h"
#include "clock.h"
#include "image.h"
#include "interrupt.h"
#include "output_kind.h"
#include "paths.h"
#include "video.h"

typedef struct Run {
    const HdSequence *sequence;
    HdRenderer *renderer;
    HdFrame frame;
    HdVideo *video; /* NULL: pictures */
    HdImage8 image; /* a film's frame */
} Run;

static bool is_film(const char *output) {
    return hd_output_is_film(hd_output_kind(output));
}

HdStatus hd_sequence_check(const HdSequence *sequence, HdError *error) {
    if (is_film(sequence->output) && hd_pattern_has_number(sequence->output))
        return hd_fail(error, HD_BAD_INPUT,
                       "'%s' asks for numbered films: a film has no %%d or # in its name, and "
                       "pictures end in .png, .pfm or .data",
                       sequence->output);
    if (is_film(sequence->output))
        return HD_OK;
    if (strpbrk(sequence->output, "%#") != NULL)
        return hd_pattern_check(sequence->output, error);
    if (sequence->frames->count == 1)
        return HD_OK;
    return hd_fail(error, HD_BAD_INPUT,
                   "'%s' names one picture, but %d frames are to be rendered: put #### into the "
                   "name, choose a film such as film.mp4, or choose one frame with --frames",
                   sequence->output, sequence->frames->count);
}

static HdStatus trace_frame(Run *run, int number, HdError *error) {
    const HdSequence *sequence = run->sequence;
    HdCamera camera;
    HdFrameTables tables;
    HdStatus status = hd_camera_at(&camera, sequence->scene, number, error);
    if (status == HD_OK)
        status = hd_compile_frame(&tables, sequence->scene, &camera, sequence->precision, error);
    if (status != HD_OK)
        return status;
    status = hd_renderer_render(run->renderer, &tables, &run->frame, error);
    hd_frame_tables_free(&tables);
    return status;
}

static HdStatus frame_path(const char *output, int number, char path[HD_MAX_PATH], HdError *error) {
    if (hd_pattern_has_number(output))
        return hd_pattern_format(output, number, path, error);
    if (snprintf(path, HD_MAX_PATH, "%s", output) >= HD_MAX_PATH)
        return hd_fail(error, HD_BAD_INPUT,
                       "the name of the output has %zu bytes, expected fewer than %d",
                       strlen(output), (int)HD_MAX_PATH);
    return HD_OK;
}

static HdStatus store_frame(Run *run, int number, HdError *error) {
    const HdPictureStyle style = {HD_CURVE_LINEAR, 8};
    char path[HD_MAX_PATH], expanded[HD_MAX_PATH];
    if (run->video != NULL) {
        hd_frame_to_image8(&run->frame, style.curve, &run->image);
        return hd_video_add(run->video, &run->image, error);
    }
    HdStatus status = frame_path(run->sequence->output, number, path, error);
    if (status == HD_OK)
        status = hd_path_expand_home(path, expanded, error);
    if (status != HD_OK)
        return status;
    return hd_picture_write(&run->frame, &style, expanded, error);
}

static HdStatus render_frames(Run *run, HdError *error) {
    const HdSequence *sequence = run->sequence;
    for (int i = 0; i < sequence->frames->count; i++) {
        int number = sequence->frames->frames[i];
        double start = hd_monotonic_seconds();
        HdStatus status = trace_frame(run, number, error);
        double seconds = hd_monotonic_seconds() - start;
        if (status == HD_OK && hd_interrupt_signal() != 0)
            status = hd_fail(error, HD_INTERRUPTED, "interrupted after %d of %d frames", i,
                             sequence->frames->count);
        if (status == HD_OK)
            status = store_frame(run, number, error);
        if (status == HD_OK)
            status =
                sequence->stored(sequence->context, number, i + 1, &run->frame, seconds, error);
        if (status != HD_OK)
            return status;
    }
    return HD_OK;
}

static HdStatus open_film(Run *run, HdError *error) {
    char path[HD_MAX_PATH];
    HdStatus status = hd_path_expand_home(run->sequence->output, path, error);
    if (status == HD_OK)
        status = hd_image8_create(&run->image, run->frame.width, run->frame.height, error);
    if (status != HD_OK)
        return status;
    return hd_video_open(&run->video, path, run->frame.width, run->frame.height,
                         run->sequence->frames_per_second, error);
}

static HdStatus prepare(Run *run, HdError *error) {
    const HdScene *scene = run->sequence->scene;
    HdSceneTables tables;
    HdStatus status = hd_frame_create(&run->frame, scene->width, scene->height, error);
    if (status == HD_OK)
        status = hd_compile_scene(&tables, scene, run->sequence->precision, error);
    if (status != HD_OK)
        return status;
    status = hd_renderer_upload(run->renderer, &tables, error);
    hd_scene_tables_free(&tables);
    if (status == HD_OK && is_film(run->sequence->output))
        status = open_film(run, error);
    return status;
}

HdStatus hd_sequence_render(const HdSequence *sequence, HdRenderer *renderer, HdError *error) {
    Run run = {.sequence = sequence, .renderer = renderer};
    HdStatus status = prepare(&run, error);
    if (status == HD_OK)
        status = render_frames(&run, error);
    if (run.video != NULL) {
        if (status == HD_OK)
            status = hd_video_close(run.video, error);
        else
            hd_video_abort(run.video);
    }
    hd_frame_free(&run.frame);
    hd_image8_free(&run.image);
    return status;
}
