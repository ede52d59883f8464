/* SPDX-License-Identifier: MIT */
#include <stdbool.h>
#include <stdio.h>

#include "choice/measure.h"
#include "cli/console.h"
#include "cli/options.h"
#include "input/json/json_device_text.h"
#include "run/load_scene.h"
#include "scene/frame_list.h"

typedef struct Run {
    const HdOptions *options;
    HdRenderOptions render; /* as for the scene */
    const HdScene *scene;   /* of about the same work, not surveyed */
    HdDeviceTeam team;      /* closed before anything is measured */
    const HdDevice *device; /* the only one of the team */
    HdTuning tuning;
    const char *obstacle; /* why nothing is remembered; NULL: the best is */
} Run;

/* ---- text ---- */

static double ratio(const HdTuning *tuning, int index) {
    return tuning->candidates[index].seconds / tuning->candidates[0].seconds;
}

static void print_heading(const Run *run) {
    const HdDevice *device = run->device;
    printf("%s on %s %d, %s (%s)\n", hd_scene_name(run->options->scene.path), device->backend->name,
           device->index, device->name, device->driver);
    printf("pictures of %d x %d pixels, %d x %d samples\n\n", run->tuning.width, run->tuning.height,
           run->scene->samples_per_side, run->scene->samples_per_side);
    printf("%-52s %10s %7s\n", "candidate", "ms", "ratio");
}

static void print_candidate(const HdTuning *tuning, int index) {
    const HdTuningCandidate *candidate = &tuning->candidates[index];
    char name[128];
    hd_launch_describe(&candidate->options, name, sizeof name);
    if (candidate->failure[0] == '\0')
        printf("%-52s %10.3f %7.3f\n", name, 1e3 * candidate->seconds, ratio(tuning, index));
    else
        printf("%-52s cannot be used: %s\n", name, candidate->failure);
}

static void print_table(const Run *run) {
    char name[128];
    print_heading(run);
    for (int i = 0; i < run->tuning.count; i++)
        print_candidate(&run->tuning, i);
    hd_launch_describe(&run->tuning.candidates[run->tuning.best].options, name, sizeof name);
    printf("\nthe best: %s; ", name);
    if (run->obstacle == NULL)
        printf("remembered for scenes of this kind\n");
    else
        printf("not remembered: %s\n", run->obstacle);
}

/* ---- JSON ---- */

static json_t *number_or_null(int number) {
    return number > 0 ? json_integer(number) : json_null();
}

static json_t *describe_candidate(const HdTuning *tuning, int index) {
    const HdTuningCandidate *candidate = &tuning->candidates[index];
    const HdRenderOptions *launch = &candidate->options;
    bool works = candidate->failure[0] == '\0';
    return json_pack("{s:s, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "pipeline",
                     hd_pipeline_names[launch->pipeline], "lanes", number_or_null(launch->lanes),
                     "block", number_or_null(launch->block), "grid", number_or_null(launch->grid),
                     "registers", number_or_null(launch->registers), "ms",
                     works ? json_real(1e3 * candidate->seconds) : json_null(), "ratio",
                     works ? json_real(ratio(tuning, index)) : json_null(), "failure",
                     works ? json_null() : hd_json_device_text(candidate->failure));
}

static json_t *describe_candidates(const HdTuning *tuning) {
    json_t *list = json_array();
    for (int i = 0; i < tuning->count; i++)
        if (json_array_append_new(list, describe_candidate(tuning, i)) != 0) {
            json_decref(list);
            return NULL;
        }
    return list;
}

static HdStatus print_json(const Run *run, HdError *error) {
    const HdDevice *device = run->device;
    const HdTuning *tuning = &run->tuning;
    json_t *root = json_pack(
        "{s:o, s:s, s:i, s:o, s:o, s:i, s:i, s:i, s:o, s:i, s:b, s:o}", "scene",
        hd_json_device_text(hd_scene_name(run->options->scene.path)), "backend",
        device->backend->name, "index", device->index, "name", hd_json_device_text(device->name),
        "driver", hd_json_device_text(device->driver), "width", tuning->width, "height",
        tuning->height, "samples", run->scene->samples_per_side, "candidates",
        describe_candidates(tuning), "best", tuning->best, "remembered", run->obstacle == NULL,
        "reason", run->obstacle != NULL ? hd_json_device_text(run->obstacle) : json_null());
    return hd_json_print(root, "the candidates", error);
}

/* ---- the command ---- */

/* Without a folder there is nothing to be done; a folder that fails is an error. */
static HdStatus remember(Run *run, HdError *error) {
    HdStatus status =
        hd_tuning_remember(&run->tuning, run->device, &run->render, run->scene, error);
    run->obstacle = status == HD_OK ? NULL : error->message;
    return status == HD_UNAVAILABLE ? HD_OK : status;
}

/* On the device that 'hedron render' would take. */
static HdStatus measure(Run *run, const HdJob *job, HdError *error) {
    const HdDeviceWish wish = {
        .backend = run->options->devices.backend,
        .device = run->options->devices.device,
        .is_for_one = true,
        .options = &run->render,
        .job = job,
    };
    HdConsole console;
    hd_console_open(&console, &run->options->telling);
    hd_console_prepare(&console, "measuring");
    HdStatus status = hd_open_devices(&run->team, &wish, error);
    hd_close_devices(&run->team);
    if (status == HD_OK)
        status = hd_tune(&run->tuning, run->device, &run->render, job, error);
    hd_console_clear(&console);
    if (run->team.note[0] != '\0')
        fprintf(stderr, "hedron: %s\n", run->team.note);
    if (status == HD_INTERRUPTED)
        hd_fail(error, status, "interrupted; nothing is remembered");
    return status;
}

static HdStatus tune(Run *run, const HdJob *job, HdError *error) {
    HdStatus status = measure(run, job, error);
    if (status != HD_OK)
        return status;
    status = remember(run, error);
    if (!run->options->json) {
        print_table(run);
        return status;
    }
    HdStatus printed = print_json(run, error);
    return status == HD_OK ? printed : status;
}

HdStatus hd_command_tune(const HdOptions *options, HdError *error) {
    static Run run;
    HdSceneFile file;
    HdFrameList frames;
    HdProblems notes = {.count = 0};
    HdStatus status = hd_load_scene(&file, &options->scene, &notes, error);
    hd_problems_print(&notes, stderr, "hedron", ": ");
    if (status != HD_OK)
        return status;
    run = (Run){.options = options, .scene = &file.scene, .device = &run.team.list[0].device};
    run.render = options->devices.render;
    run.render.has_deep_trees = hd_scene_has_deep_trees(&file.scene);
    hd_scene_drop_survey(&file.scene);
    status = hd_frame_list_parse(&frames, options->frames, file.scene.frame_count, error);
    if (status == HD_OK) {
        HdJob job = {
            .scene = &file.scene,
            .first_frame = frames.frames[0],
            .frame_count = frames.count,
        };
        status = tune(&run, &job, error);
        hd_frame_list_free(&frames);
    }
    hd_scene_file_free(&file);
    return status;
}
