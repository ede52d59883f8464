/* SPDX-License-Identifier: MIT */
/* One frame of one scene, on a renderer that has the scene (verify/trust.h): each sample of the
   grid, or as many as the pixels of a surveyed scene need (hd_scene_has_error_bound).

   Adaptive sampling (after Whitted 1980, section 6) begins with one sample a pixel. A pixel gets 16
   where a neighbour's picture differs, or where a neighbour has turned out to be uneven; then 64,
   256, ... up to all of the grid's, as long as the means of parts of its samples differ, or those
   of its neighbours do. The same bytes come of it everywhere, whatever was rendered before. */
#ifndef HD_RENDER_FRAME_H
#define HD_RENDER_FRAME_H

#include "device/renderer.h"

/* What frames are made of, and how they are wanted. */
typedef struct HdFrameMaker {
    HdRenderer *renderer;
    const HdScene *scene; /* what the renderer has; size, crop, samples and less depth may differ */
    HdFrameRequest
        request;    /* surveyed frames come as radiance, whose errors are judged on its curve */
    HdWatch *watch; /* NULL: nobody looks */
    struct HdRefinement *refinement; /* the maker's own: of a surveyed scene */
} HdFrameMaker;

/* A frame under way. The struct stays where it is until the frame has ended, or its tables are
   freed since the renderer was told to forget it (hd_renderer_drop). */
typedef struct HdFrameInFlight {
    HdCamera camera;
    HdFrameTables tables;
} HdFrameInFlight;

/* Makes what surveyed scenes need; all else of the maker is filled in. */
HdStatus hd_frame_maker_open(HdFrameMaker *maker, HdError *error);

/* A maker that was not opened may be closed. */
void hd_frame_maker_close(HdFrameMaker *maker);

/* The frames under way at a time: HD_FRAMES_IN_FLIGHT, or 1 where the scene is surveyed, whose
   frames are made of several that are waited for one after the other. */
int hd_frame_max_in_flight(const HdFrameMaker *maker);

/* Compile and begin a frame. On failure there is nothing to drop, and the earlier ones are still
   under way. */
HdStatus hd_frame_prepare(const HdFrameMaker *maker, const HdCamera *camera,
                          HdFrameInFlight *in_flight, HdError *error);
HdStatus hd_frame_begin(const HdFrameMaker *maker, HdFrameInFlight *in_flight, HdError *error);

/* Waits for the oldest frame under way, which is so no longer; `frame` has room for what is wished
   for (hd_renderer_collect), and gets the layers that it has room for. */
HdStatus hd_frame_end(const HdFrameMaker *maker, HdFrameInFlight *in_flight, HdFrame *frame,
                      HdError *error);

/* A frame's radiance, none being under way, with a maker that need not be open. */
HdStatus hd_frame_render(const HdFrameMaker *maker, const HdCamera *camera, HdFrame *frame,
                         HdError *error);

#endif
