/* SPDX-License-Identifier: MIT */
/* What the commands that render share: options applied to a scene, a device opened. */
#ifndef HD_RENDERING_H
#define HD_RENDERING_H

#include "device_choice.h"
#include "options.h"
#include "sequence.h"

/* Lays size, samples, depth and cut-off of the command line over the scene, and checks the result.
 */
HdStatus hd_apply_scene_options(HdScene *scene, const HdOptions *options, HdError *error);

/* Chooses and opens a device, and renders the sequence; a fallback is announced on standard error.
 */
HdStatus hd_render_sequence(const HdSequence *sequence, const HdOptions *options,
                            const HdDeviceWish *wish, HdError *error);

#endif
