/* SPDX-License-Identifier: MIT */
#include "choice/launch.h"

#include <stdio.h>
#include <string.h>

#include "choice/trial.h"
#include "system/cache_folder.h"

enum { KEY_LENGTH = HD_JOB_KIND_LENGTH + 640, RECORD_LENGTH = 96 };

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
static void write_key(char key[KEY_LENGTH], const HdDevice *device, const HdRenderOptions *options,
                      const HdScene *scene) {
    hd_job_kind(scene, options, key, KEY_LENGTH);
    size_t length = strlen(key);
    snprintf(key + length, KEY_LENGTH - length, "%s %s (%s)\n", device->backend->name, device->name,
             device->driver);
}

HdStatus hd_launch_remember(const HdDevice *device, const HdRenderOptions *options,
                            const HdScene *scene, const HdLaunch *launch, HdError *error) {
    char key[KEY_LENGTH], text[RECORD_LENGTH];
    write_key(key, device, options, scene);
    snprintf(text, sizeof text, record_form, (int)launch->pipeline, launch->lanes, launch->block,
             launch->grid, launch->registers);
    return hd_cache_put_text(record_kind, key, text, error);
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
    char key[KEY_LENGTH], text[RECORD_LENGTH];
    HdLaunch found;
    HdError ignored;
    *launch = hd_launch_of(options);
    write_key(key, device, options, scene);
    if (hd_cache_get_text(record_kind, key, text, sizeof text, &ignored) != HD_OK ||
        !parse(&found, text) || !makes_sense(&found, device, options))
        return false;
    *launch = found;
    return true;
}

HdRenderOptions hd_launch_remembered_options(const HdDevice *device, const HdRenderOptions *options,
                                             const HdScene *scene) {
    HdLaunch launch;
    hd_launch_recall(&launch, device, options, scene);
    HdRenderOptions changed = hd_launch_options(options, &launch);
    changed.pipeline = hd_choose_pipeline(device, &changed, scene);
    return changed;
}

HdStatus hd_launch_open(HdRenderer **renderer, const HdDevice *device,
                        const HdRenderOptions *options, const HdScene *scene, HdError *error) {
    HdRenderOptions remembered = hd_launch_remembered_options(device, options, scene);
    return hd_renderer_open(renderer, device, &remembered, error);
}
