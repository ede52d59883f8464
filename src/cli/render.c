/* SPDX-License-Identifier: MIT */
#include <stdio.h>
#include <string.h>

#include "cli/commands.h"
#include "cli/load_scene.h"
#include "cli/rendering.h"

/* The outputs of the command line, else the scene's, else a name that suits the number of frames.
 */
static HdStatus settle_outputs(HdOutputPlan *plan, const HdOptions *options,
                               const HdOutputSettings *settings, int frame_count, HdError *error) {
    const char *name = settings->path[0] != '\0' ? settings->path
                       : frame_count == 1        ? "hedron.png"
                                                 : "hedron.mp4";
    const bool is_given = options->output_count > 0;
    return hd_outputs_settle(plan, is_given ? options->outputs : &name,
                             is_given ? options->output_count : 1, &settings->style, frame_count,
                             error);
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
            status = hd_output_name(&plan->list[i], frames->frames[0], file, error);
        if (status != HD_OK)
            return status;
        printf("%s\n", frames->count == 1 ? file : plan->list[i].name);
    }
    return HD_OK;
}

static HdStatus render_frames(const HdOptions *options, const HdSceneFile *file,
                              const HdFrameList *frames, HdError *error) {
    HdOutputPlan outputs;
    HdRendering rendering = {
        .name = hd_scene_name(options),
        .file = file,
        .frames = frames,
        .outputs = &outputs,
        .device_kind = HD_WANT_ANY,
        .resumes = !options->again,
        .tells_progress = true,
    };
    HdStatus status = settle_outputs(&outputs, options, &file->output, frames->count, error);
    if (status == HD_OK)
        status = hd_outputs_add_layers(&outputs, options->layers,
                                       hd_scene_is_surveyed(&file->scene), error);
    if (status == HD_OK)
        status = hd_render(&rendering, options, error);
    return status == HD_OK ? print_names(options, &outputs, frames, error) : status;
}

static HdStatus render_file(const HdOptions *options, const HdSceneFile *file, HdError *error) {
    HdFrameList frames;
    HdStatus status = hd_frame_list_parse(&frames, options->frames, file->scene.frame_count, error);
    if (status != HD_OK)
        return status;
    status = render_frames(options, file, &frames, error);
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
