/* SPDX-License-Identifier: MIT */
/* Uploads scenes to renderers; all rendering for a user goes through it. First settles the device's
   arithmetic (probe.h). Newly compiled strict kernels must then render those golden frames of this
   test that they support, with the right hashes. If the megakernel fails, the wavefront replaces it
   with a warning (warnings.h). Kernels that pass are kept on disk (kernel_cache.h). Renderers
   refuse frames by others (hd_renderer_submit). */
#ifndef HD_VERIFY_TRUST_H
#define HD_VERIFY_TRUST_H

#include "device/renderer.h"
#include "scene/camera.h"
#include "scene/scene.h"

/* Uploads a compiled scene to a renderer of the same precision and lanes. HD_UNAVAILABLE if the
   device computes wrongly. */
HdStatus hd_put_tables(HdRenderer *renderer, const HdSceneTables *tables, HdError *error);

/* Compiles a valid scene for the renderer and uploads it. `like` adds needs of the kernels
   (hd_scene_tables_raise); NULL: none. */
HdStatus hd_put_scene(HdRenderer *renderer, const HdScene *scene, const HdSceneTables *like,
                      HdError *error);

/* The same, and renders a frame with those layers (hd_frame_add_layers), which the caller frees. */
HdStatus hd_put_and_render(HdRenderer *renderer, const HdScene *scene, const HdCamera *camera,
                           const HdSceneTables *like, unsigned layers, HdFrame *frame,
                           HdError *error);

/* Exempts the renderer's kernels from the test and from storage: the caller judges the frames. */
void hd_put_on_trial(HdRenderer *renderer);

#endif
