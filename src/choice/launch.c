/* SPDX-License-Identifier: MIT */
#include "choice/launch.h"

#include <stdio.h>
#include <string.h>

#include "choice/record.h"

enum { DEVICE_LENGTH = 640, RECORD_LENGTH = 96 };

static const char record_kind[] = "launch";
static const char record_form[] = "pipeline %d, lanes %d, block %d, grid %d, registers %d\n";

HdLaunch hd_launch_of(const HdRenderOptions *options) {
    return (HdLaunch){
        .pipeline = options->pipeline,
        .lanes = options->lanes,
        .block = options->block,
        .grid = options->grid,
        .registers = options->registers,
    };
}

HdRenderOptions hd_launch_options(const HdRenderOptions *options, const HdLaunch *launch) {
    HdRenderOptions changed = *options;
    changed.pipeline = launch->pipeline;
    changed.lanes = launch->lanes;
    changed.block = launch->block;
    changed.grid = launch->grid;
    changed.registers = launch->registers;
    return changed;
}

void hd_launch_describe(const HdLaunch *launch, char *text, int capacity) {
    const struct {
        const char *form;
        int value;
    } parts[] = {
        {"%s%d lanes", launch->lanes},
        {"%sgroups of %d", launch->block},
        {"%sat most %d groups", launch->grid},
        {"%sat most %d registers", launch->registers},
    };
    size_t room = (size_t)capacity;
    snprintf(text, room, "%s",
             launch->pipeline != HD_PIPELINE_AUTO ? hd_pipeline_names[launch->pipeline] : "");
    for (int i = 0; i < 4; i++) {
        size_t length = strlen(text);
        if (parts[i].value > 0)
            snprintf(text + length, room - length, parts[i].form, length > 0 ? ", " : "",
                     parts[i].value);
    }
    if (text[0] == '\0')
        snprintf(text, room, "as it suits the device");
}

/* Devices of one name and driver are alike, whatever their numbers. */
static void write_device(const HdDevice *device, char text[DEVICE_LENGTH]) {
    snprintf(text, DEVICE_LENGTH, "%s %s (%s)\n", device->backend->name, device->name,
             device->driver);
}

HdStatus hd_launch_remember(const HdDevice *device, const HdRenderOptions *options,
                            const HdScene *scene, const HdLaunch *launch, HdError *error) {
    char devices[DEVICE_LENGTH], text[RECORD_LENGTH];
    write_device(device, devices);
    snprintf(text, sizeof text, record_form, (int)launch->pipeline, launch->lanes, launch->block,
             launch->grid, launch->registers);
    return hd_record_put(record_kind, scene, options, devices, text, error);
}

static bool keeps(int given, int chosen) {
    return given == 0 || given == chosen;
}

static bool parse(HdLaunch *launch, const char *text) {
    char again[RECORD_LENGTH];
    int pipeline;
    if (sscanf(text, record_form, &pipeline, &launch->lanes, &launch->block, &launch->grid,
               &launch->registers) != 5)
        return false;
    launch->pipeline = (HdPipeline)pipeline;
    snprintf(again, sizeof again, record_form, pipeline, launch->lanes, launch->block, launch->grid,
             launch->registers);
    return strcmp(text, again) == 0;
}

static bool makes_sense(const HdLaunch *launch, const HdDevice *device,
                        const HdRenderOptions *options) {
    HdError ignored;
    HdRenderOptions changed = hd_launch_options(options, launch);
    return keeps((int)options->pipeline, (int)launch->pipeline) &&
           keeps(options->lanes, launch->lanes) && keeps(options->block, launch->block) &&
           keeps(options->grid, launch->grid) && keeps(options->registers, launch->registers) &&
           hd_render_options_check(&changed, &ignored) == HD_OK &&
           hd_device_obstacle(device, &changed) == NULL;
}

bool hd_launch_recall(HdLaunch *launch, const HdDevice *device, const HdRenderOptions *options,
                      const HdScene *scene) {
    char devices[DEVICE_LENGTH], text[RECORD_LENGTH];
    HdLaunch found;
    *launch = hd_launch_of(options);
    write_device(device, devices);
    if (!hd_record_get(record_kind, scene, options, devices, text, sizeof text) ||
        !parse(&found, text) || !makes_sense(&found, device, options))
        return false;
    *launch = found;
    return true;
}

HdStatus hd_launch_open(HdTeamDevice *member, const HdRenderOptions *options, const HdJob *job,
                        bool gets_scene, HdError *error) {
    const HdDevice *device = &member->device;
    member->is_tuned = hd_launch_recall(&member->launch, device, options, job->scene);
    HdRenderOptions changed = hd_launch_options(options, &member->launch);
    changed.pipeline = hd_choose_pipeline(device, &changed, job->scene);
    return gets_scene ? hd_trial_open(&member->renderer, device, &changed, job, error)
                      : hd_renderer_open(&member->renderer, device, &changed, error);
}

void hd_launch_close(HdTeamDevice *member) {
    hd_renderer_close(member->renderer);
    member->renderer = NULL;
}
