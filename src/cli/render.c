/* SPDX-License-Identifier: MIT */
/* Runs the commands that render a scene: 'hedron render' and the classic mode. */
#define _POSIX_C_SOURCE 200809L
#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/text.h"
#include "cli/console.h"
#include "cli/options.h"
#include "cli/statistics.h"
#include "input/classic.h"
#include "input/files.h"
#include "output/fingerprint.h"
#include "run/darkness.h"
#include "run/load_scene.h"
#include "run/sequence.h"
#include "system/interrupt.h"

typedef struct Run {
    const HdSceneFile *file;
    HdFrameList frames;
    HdOutputPlan outputs;
    bool is_classic; /* standard output has a line for each frame, otherwise the outputs */
    HdResume resume;
    HdConsole console;
    HdStatistics statistics; /* stream NULL: not requested */
    HdDeviceTeam team;
    HdWatch watch;
    char lines[HD_MAX_WORKERS][HD_RENDERER_LINE]; /* description of each renderer with the scene */
} Run;

/* ---- reports of frames ---- */

static void scene_uploaded(void *context, int number, const HdSceneTables *tables) {
    Run *run = context;
    const HdRenderer *renderer = run->team.list[number].renderer;
    hd_renderer_describe(renderer, run->lines[number], HD_RENDERER_LINE);
    hd_console_report_upload(&run->console, renderer, run->lines[number], tables);
}

static void device_dropped(void *context, int number, const HdError *error) {
    Run *run = context;
    hd_console_report_loss(&run->console, &run->team.list[number].device, error->message);
}

/* Covers the work from the camera to the pixels in memory. */
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

static HdStatus frame_stored(void *context, const HdStoredFrame *stored, HdError *error) {
    Run *run = context;
    HdStatus status = HD_OK;
    hd_console_hold(&run->console); /* both may go to the same terminal */
    if (run->is_classic)
        status = print_frame_line(stored, error);
    if (status == HD_OK && run->statistics.stream != NULL)
        status = hd_statistics_add(&run->statistics, &run->file->scene,
                                   &run->team.list[stored->worker].device,
                                   run->lines[stored->worker], stored, error);
    hd_console_release(&run->console, status == HD_OK ? stored : NULL);
    return status;
}

/* ---- the run ---- */

static HdStatus open_devices(Run *run, const HdDevicePlan *plan, HdError *error) {
    HdScene plain = run->file->scene; /* `file` keeps ownership */
    HdRenderOptions render = plan->render;
    const HdFrameList *missing = &run->resume.missing;
    const HdJob job = {
        .scene = &plain, .first_frame = missing->frames[0], .frame_count = missing->count};
    const HdDeviceSelection selection = {.backend = plan->backend,
                                         .device = plan->device,
                                         .kind = plan->kind,
                                         .options = &render,
                                         .job = &job};
    render.has_deep_trees = hd_scene_has_deep_trees(&plain);
    render.first_hits = run->outputs.request.layers != 0;
    hd_scene_drop_error_bound(&plain);
    HdStatus status = hd_open_devices(&run->team, &selection, error);
    hd_console_clear(&run->console);
    if (status == HD_INTERRUPTED)
        return hd_fail(error, status, "interrupted after %d of %d frames",
                       run->resume.first_missing, run->frames.count);
    if (status == HD_OK)
        hd_console_report_devices(&run->console, &run->team);
    return status;
}

static HdStatus render_sequence(Run *run, HdError *error) {
    const HdSequence sequence = {
        .scene = &run->file->scene,
        .resume = &run->resume,
        .outputs = &run->outputs,
        .team = &run->team,
        .uploaded = scene_uploaded,
        .dropped = device_dropped,
        .stored = frame_stored,
        .context = run,
        .watch = &run->watch,
    };
    if (run->team.count > 0 && run->team.list[0].device.backend->functions->kernels != NULL)
        hd_console_prepare(&run->console, "building kernels");
    hd_console_watch(&run->console, &run->watch);
    HdStatus status = hd_sequence_render(&sequence, error);
    hd_console_end(&run->console, sequence.scene, &run->team, run->lines, status);
    return status;
}

/* A device that cannot be used leaves the statistics of an earlier run unchanged. */
static HdStatus render_missing(Run *run, const HdDevicePlan *devices, HdError *error) {
    HdStatus status = run->resume.missing.count > 0 ? open_devices(run, devices, error) : HD_OK;
    if (status == HD_OK)
        status = hd_statistics_open(&run->statistics, error);
    if (status == HD_OK)
        status = render_sequence(run, error);
    status = hd_statistics_close(&run->statistics, run->outputs.durability, status, error);
    hd_close_devices(&run->team);
    return status;
}

/* ---- outputs ---- */

/* Statistics on standard output exclude all other text there. */
static HdStatus print_names(const Run *run, HdError *error) {
    const HdFrameList *frames = &run->frames;
    char file[HD_MAX_PATH];
    for (int i = 0; i < run->outputs.count && !run->statistics.is_standard_output; i++) {
        const HdOutput *output = &run->outputs.list[i];
        if (frames->count == 1)
            HD_TRY(hd_output_name(output, frames->frames[0], file, error));
        printf("%s\n", frames->count == 1 ? file : output->name);
    }
    return HD_OK;
}

/* Chooses the outputs of the plan, otherwise the scene's, otherwise a name that suits the number of
   frames. Fast arithmetic gives no fingerprint, since its results differ between machines. */
static HdStatus settle(Run *run, const HdOptions *options, HdError *error) {
    const HdStorePlan *store = &options->store;
    const HdRenderOptions *render = &options->devices.render;
    const HdOutputSettings *settings = &run->file->output;
    const HdScene *scene = &run->file->scene;
    HdOutputPlan *outputs = &run->outputs;
    const char *usual = run->frames.count == 1 ? "hedron.png" : "hedron.mp4";
    const char *name = settings->path[0] != '\0' ? settings->path : usual;
    const bool is_named = store->count > 0;
    HdStatus status =
        hd_outputs_settle(outputs, is_named ? store->names : &name, is_named ? store->count : 1,
                          &settings->style, run->frames.count, error);
    outputs->options = store->given;
    outputs->crop = scene->crop;
    outputs->background = hd_scale(scene->background, scene->exposure);
    outputs->durability = store->no_sync ? HD_WITHOUT_SYNC : HD_DURABLE;
    if (status == HD_OK)
        status =
            hd_outputs_add_layers(outputs, store->layers, hd_scene_has_error_bound(scene), error);
    if (status != HD_OK)
        return status;
    if (render->math == HD_MATH_STRICT && (outputs->bears_fingerprints || outputs->film_count > 0))
        hd_outputs_set_fingerprint(
            outputs, hd_run_fingerprint(run->file, render->precision, &outputs->style.picture),
            !store->again);
    return hd_statistics_settle(&run->statistics, store->statistics, options->scene.path, outputs,
                                run->frames.frames[0], error);
}

/* Says why the first frame is black, if it is. */
static void explain_darkness(const Run *run) {
    HdProblems notes = {.count = 0};
    hd_note_darkness(&run->file->scene, run->outputs.style.picture.curve, run->frames.frames[0],
                     &notes);
    hd_problems_print(&notes, stderr, "hedron", ": ");
}

/* Pictures store the last part of the scene's name: folders are private and differ between
   machines. */
static HdStatus render_frames(Run *run, const HdOptions *options, HdError *error) {
    const char *name = hd_scene_name(options->scene.path), *slash = strrchr(name, '/');
    char escaped[HD_MAX_PATH];
    HdStatus status = settle(run, options, error);
    if (status != HD_OK)
        return status;
    hd_console_report_run(&run->console, name, run->file, &run->outputs, &run->frames);
    hd_escape(slash != NULL ? slash + 1 : name, escaped, sizeof escaped);
    run->outputs.scene = escaped;
    status = hd_resume_find(&run->resume, &run->outputs, &run->frames, error);
    if (status == HD_OK) {
        hd_console_start(&run->console, &run->resume);
        status = render_missing(run, &options->devices, error);
    }
    if (status == HD_OK && options->reporting.verbose)
        explain_darkness(run);
    hd_resume_free(&run->resume);
    return status == HD_OK && !run->is_classic ? print_names(run, error) : status;
}

/* ---- the commands ---- */

HdStatus hd_command_render(const HdOptions *options, HdError *error) {
    HdSceneFile file;
    Run run = {.file = &file};
    HdProblems notes = {.count = 0};
    run.is_classic = options->command == HD_COMMAND_CLASSIC;
    hd_console_open(&run.console, &options->reporting);
    HdStatus status = hd_load_scene(&file, &options->scene, &notes, error);
    if (!options->reporting.quiet)
        hd_problems_print(&notes, stderr, "hedron", ": ");
    HD_TRY(status);
    status = hd_frame_list_parse(&run.frames, options->frames, file.scene.frame_count, error);
    if (status == HD_OK)
        status = render_frames(&run, options, error);
    hd_frame_list_free(&run.frames);
    hd_scene_file_free(&file);
    return status;
}

static HdStatus print_default(const HdScenePlan *plan, HdError *error) {
    HdSceneFile file;
    HD_TRY(hd_default_input(&file, error));
    HdStatus status = hd_scene_apply_numbers(&file.scene, plan, error);
    if (status == HD_OK)
        status = hd_classic_print(stdout, &file, error);
    hd_scene_file_free(&file);
    return status;
}

HdStatus hd_command_classic(const HdOptions *options, HdError *error) {
    return options->prints_default ? print_default(&options->scene, error)
                                   : hd_command_render(options, error);
}
