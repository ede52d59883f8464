/* SPDX-License-Identifier: MIT */
/* One frame of a scene, by a renderer that need not have seen it before. */
#ifndef HD_VERIFY_RENDER_SCENE_H
#define HD_VERIFY_RENDER_SCENE_H

#include "device/renderer.h"
#include "scene/camera.h"
#include "scene/scene.h"

/* What all golden frames need of the kernels, so that devices which compile them do so once. */
extern const HdSceneTables hd_golden_needs;

/* Compiles a valid scene for the renderer, which computes in `precision`, as if it needed of the
   kernels what `like` does too (hd_scene_tables_raise; NULL: only what it needs), and uploads it.
 */
HdStatus hd_upload_scene(HdRenderer *renderer, const HdScene *scene, HdPrecision precision,
                         const HdSceneTables *like, HdError *error);

/* Uploads and renders, with the samples that the scene asks for, and with those layers
   (hd_frame_add_layers). The caller frees the frame. */
HdStatus hd_render_scene(HdRenderer *renderer, const HdScene *scene, const HdCamera *camera,
                         HdPrecision precision, const HdSceneTables *like, unsigned layers,
                         HdFrame *frame, HdError *error);

#endif
