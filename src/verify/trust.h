/* SPDX-License-Identifier: MIT */
/* Puts scenes on renderers: whoever renders for a user has it done here. First the device's
   arithmetic is settled (probe.h). Kernels that were compiled anew, with strict arithmetic, then
   prove themselves: they render the golden frames that are for it and that they can render, and
   their hashes must be right. Where those of the megakernel are wrong, the wavefront takes over,
   and a note tells (warnings.h). Kernels that have proved themselves are kept on disk
   (kernel_cache.h). Renderers refuse frames by others (hd_renderer_submit). */
#ifndef HD_VERIFY_TRUST_H
#define HD_VERIFY_TRUST_H

#include "device/renderer.h"
#include "scene/camera.h"
#include "scene/scene.h"

/* Hands a compiled scene to a renderer of the same precision and lanes. HD_UNAVAILABLE where the
   device computes wrongly. */
HdStatus hd_put_tables(HdRenderer *renderer, const HdSceneTables *tables, HdError *error);

/* Compiles a valid scene for the renderer, as if it needed of the kernels what `like` does too
   (hd_scene_tables_raise; NULL: only what it needs), and hands it over. */
HdStatus hd_put_scene(HdRenderer *renderer, const HdScene *scene, const HdSceneTables *like,
                      HdError *error);

/* The same, and renders a frame with those layers (hd_frame_add_layers), which the caller frees. */
HdStatus hd_put_and_render(HdRenderer *renderer, const HdScene *scene, const HdCamera *camera,
                           const HdSceneTables *like, unsigned layers, HdFrame *frame,
                           HdError *error);

/* From now on the renderer's kernels need not prove themselves and are not kept: whoever asks for
   frames is to judge them. */
void hd_put_on_trial(HdRenderer *renderer);

#endif
