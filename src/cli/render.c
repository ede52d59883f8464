/* SPDX-License-Identifier: MIT */
#include <stdio.h>
#include <string.h>

#include "cli/commands.h"
#include "cli/load_scene.h"
#include "cli/rendering.h"

/* The outputs of the command line, else the scene's, else a name that suits the number of frames.
 */
static HdOutputPlan plan_outputs(const HdOptions *options, const HdOutputSettings *settings,
                                 int frame_count) {
    HdOutputPlan plan = {
        .count = options->output_count,
        .style = settings->style,
    };
    memcpy(plan.names, options->outputs, sizeof plan.names);
    if (plan.count == 0)
        plan.names[plan.count++] = settings->path[0] != '\0' ? settings->path
                                   : frame_count == 1        ? "hedron.png"
                                                             : "hedron.mp4";
    return plan;
}

/* Where standard output has the statistics, it has nothing else. */
static HdStatus print_names(const HdOptions *options, const HdOutputPlan *plan,
                            const HdFrameList *frames, HdError *error) {
    char file[HD_MAX_PATH];
    if (options->statistics != NULL && strcmp(options->statistics, "-") == 0)
        return HD_OK;
    for (int i = 0; i < plan->count; i++) {
        HdStatus status = HD_OK;
        if (frames->count == 1)
            status = hd_output_name(plan->names[i], frames->frames[0], file, error);
        if (status != HD_OK)
            return status;
        printf("%s\n", frames->count == 1 ? file : plan->names[i]);
    }
    return HD_OK;
}

static HdStatus render_file(const HdOptions *options, const HdSceneFile *file, HdError *error) {
    HdFrameList frames;
    HdStatus status = hd_frame_list_parse(&frames, options->frames, file->scene.frame_count, error);
    if (status != HD_OK)
        return status;
    HdRendering rendering = {
        .name = hd_scene_name(options),
        .scene = &file->scene,
        .file = file,
        .frames = &frames,
        .outputs = plan_outputs(options, &file->output, frames.count),
        .device_kind = HD_WANT_ANY,
        .resumes = !options->again,
        .tells_progress = true,
    };
    status = hd_render(&rendering, options, error);
    if (status == HD_OK)
        status = print_names(options, &rendering.outputs, &frames, error);
    hd_frame_list_free(&frames);
    return status;
}

HdStatus hd_command_render(const HdOptions *options, HdError *error) {
    HdSceneFile file;
    HdStatus status = hd_read_scene(&file, options, error);
    if (status != HD_OK)
        return status;
    status = render_file(options, &file, error);
    hd_scene_file_free(&file);
    return status;
}
