/* SPDX-License-Identifier: MIT */
/* Frames of surveyed scenes: each pixel gets the samples that it needs, and each sample the rays.
 */
#ifndef HD_RENDER_ADAPTIVE_H
#define HD_RENDER_ADAPTIVE_H

#include "device/renderer.h"

typedef struct HdRefinement HdRefinement;

/* For a scene that was uploaded to the renderer and is surveyed (hd_scene_is_surveyed); both must
   live on. Errors of the picture are judged on `curve`. */
HdStatus hd_refinement_create(HdRefinement **refinement, const HdScene *scene, HdRenderer *renderer,
                              HdCurve curve, HdError *error);

/* Renders a frame, none being under way: fills radiance (3 floats a pixel), the layers that it has
   room for, counts, time and what is known of the error. `watch` may be NULL; what passes are worth
   to it is a guess, since each hangs on what comes of those before. The same bytes come of it
   everywhere, whatever was rendered before.

   Adaptive sampling (after Whitted 1980, section 6) begins with one sample a pixel. A pixel gets 16
   where a neighbour's picture differs, or where a neighbour has turned out to be uneven; then 64,
   256, ... up to all of the grid's, as long as the means of parts of its samples differ, or those
   of its neighbours do. */
HdStatus hd_refinement_render(HdRefinement *refinement, const HdCamera *camera, HdWatch *watch,
                              HdFrame *frame, HdError *error);

/* NULL is allowed. */
void hd_refinement_free(HdRefinement *refinement);

#endif
