/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include <inttypes.h>
#include <stdio.h>
#include <unistd.h>

#include "cli/commands.h"
#include "cli/load_scene.h"
#include "cli/rendering.h"
#include "input/builtin.h"
#include "system/interrupt.h"

/* From the camera to the pixels in memory. */
static HdStatus print_frame_line(const HdStoredFrame *stored, HdError *error) {
    const HdFrameTimes *times = &stored->times;
    double seconds = times->prepare.seconds + times->trace.seconds + times->copy.seconds;
    if (!hd_wait_to_write(STDOUT_FILENO) ||
        printf("%d\t%.3f\t%" PRIu64 "\n", stored->number, seconds * 1e3,
               hd_frame_rays(stored->frame)) < 0 ||
        fflush(stdout) != 0)
        return hd_interrupt_signal() != 0
                   ? hd_fail(error, HD_INTERRUPTED, "interrupted while writing to standard output")
                   : hd_fail(error, HD_FAILED, "cannot write to standard output");
    return HD_OK;
}

static HdStatus render_file(const HdOptions *options, const HdSceneFile *file, HdError *error) {
    HdFrameList frames;
    HdStatus status = hd_frame_list_parse(&frames, options->frames, file->scene.frame_count, error);
    if (status != HD_OK)
        return status;
    const char *name = file->output.path;
    HdOutputPlan outputs;
    HdRendering rendering = {
        .name = "standard input",
        .file = file,
        .frames = &frames,
        .outputs = &outputs,
        .device_kind = options->cpu ? HD_ONLY_CPU : HD_PREFER_GPU,
        .stored = print_frame_line,
    };
    status = hd_outputs_settle(&outputs, &name, 1, &file->output.style, frames.count, error);
    if (status == HD_OK)
        status = hd_render(&rendering, options, error);
    hd_frame_list_free(&frames);
    return status;
}

static HdStatus print_default(const HdOptions *options, HdError *error) {
    HdSceneFile input;
    HdStatus status = hd_default_input(&input, error);
    if (status != HD_OK)
        return status;
    status = hd_apply_scene_options(&input.scene, options, error);
    if (status == HD_OK)
        status = hd_classic_print(stdout, &input, error);
    hd_scene_file_free(&input);
    return status;
}

static HdStatus trace_standard_input(const HdOptions *options, HdError *error) {
    HdSceneFile file;
    HdStatus status = hd_read_classic(&file, NULL, options->variant, error);
    if (status != HD_OK)
        return status;
    status = hd_apply_scene_options(&file.scene, options, error);
    if (status == HD_OK)
        status = hd_scene_file_load_texture(&file, error);
    if (status == HD_OK)
        status = hd_apply_geometry(&file.scene, options, error);
    if (status == HD_OK)
        status = render_file(options, &file, error);
    hd_scene_file_free(&file);
    return status;
}

HdStatus hd_command_classic(const HdOptions *options, HdError *error) {
    if (options->prints_default)
        return print_default(options, error);
    return trace_standard_input(options, error);
}
