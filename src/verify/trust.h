/* SPDX-License-Identifier: MIT */
/* Puts scenes on renderers: whoever renders for a user has it done here, for no kernels make a
   picture that did not prove themselves. */
#ifndef HD_VERIFY_TRUST_H
#define HD_VERIFY_TRUST_H

#include "device/renderer.h"
#include "scene/camera.h"
#include "scene/scene.h"

/* Hands a compiled scene to a renderer of the same precision and lanes. */
HdStatus hd_put_tables(HdRenderer *renderer, const HdSceneTables *tables, HdError *error);

/* Compiles a valid scene for the renderer, as if it needed of the kernels what `like` does too
   (hd_scene_tables_raise; NULL: only what it needs), and hands it over. */
HdStatus hd_put_scene(HdRenderer *renderer, const HdScene *scene, const HdSceneTables *like,
                      HdError *error);

/* The same, and renders a frame with those layers (hd_frame_add_layers), which the caller frees. */
HdStatus hd_put_and_render(HdRenderer *renderer, const HdScene *scene, const HdCamera *camera,
                           const HdSceneTables *like, unsigned layers, HdFrame *frame,
                           HdError *error);

#endif
