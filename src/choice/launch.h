/* SPDX-License-Identifier: MIT */
/* What a renderer may choose without changing a picture, and what was once found the best. */
#ifndef HD_CHOICE_LAUNCH_H
#define HD_CHOICE_LAUNCH_H

#include <stdbool.h>

#include "device/renderer.h"
#include "scene/scene.h"

/* As in HdRenderOptions: 0 and HD_PIPELINE_AUTO stand for what suits the device. */
typedef struct HdLaunch {
    HdPipeline pipeline;
    int lanes, block, grid, registers;
} HdLaunch;

/* What the options say. */
HdLaunch hd_launch_of(const HdRenderOptions *options);

/* The options with that choice instead of their own. */
HdRenderOptions hd_launch_options(const HdRenderOptions *options, const HdLaunch *launch);

/* For people: "mega, groups of 64, at most 96 registers"; "as it suits the device" where nothing is
   chosen. */
void hd_launch_describe(const HdLaunch *launch, char *text, int capacity);

/* Stores the choice in the cache folder (cache_folder.h) for later jobs of this kind (trial.h)
   on such a device, with the same driver, that leave the same open. Errors as hd_cache_put. */
HdStatus hd_launch_remember(const HdDevice *device, const HdRenderOptions *options,
                            const HdScene *scene, const HdLaunch *launch, HdError *error);

/* Takes the choice that was remembered. It keeps to what the options say. False where there is
   none, or one that makes no sense: then it is what the options say. */
bool hd_launch_recall(HdLaunch *launch, const HdDevice *device, const HdRenderOptions *options,
                      const HdScene *scene);

/* The options with what is remembered for them, if anything is. */
HdRenderOptions hd_launch_remembered_options(const HdDevice *device, const HdRenderOptions *options,
                                             const HdScene *scene);

/* hd_renderer_open with these options. */
HdStatus hd_launch_open(HdRenderer **renderer, const HdDevice *device,
                        const HdRenderOptions *options, const HdScene *scene, HdError *error);

#endif
