/* SPDX-License-Identifier: MIT */
/* What --verbose tells on standard error, a line for each thing. */
#ifndef HD_CLI_NOTES_H
#define HD_CLI_NOTES_H

#include "choice/launch.h"
#include "output/outputs.h"
#include "scene/scene.h"

void hd_note_scene(const char *name, const HdScene *scene);
void hd_note_outputs(const HdOutputPlan *plan, int frame_count);
void hd_note_device(const HdDevice *device, const char *why);

/* What 'hedron tune' found the best. */
void hd_note_launch(const HdLaunch *launch);

void hd_note_renderer_line(const char *renderer);

/* `renderer` is hd_renderer_describe's line, `kernels` hd_renderer_kernels_note's. */
void hd_note_renderer(const HdDevice *device, const char *renderer, const char *kernels,
                      const HdSceneTables *tables);

/* A device is left out of the rest of a run. Told even where nothing else is. */
void hd_note_dropped(const HdDevice *device, const char *why);

/* Where more may be missing from a picture than the scene allows. `missing`: in steps of 255. */
void hd_note_missing(const HdScene *scene, double missing);

#endif
