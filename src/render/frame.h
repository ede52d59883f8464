/* SPDX-License-Identifier: MIT */
/* Renders one frame of a scene that is on a renderer (verify/trust.h), also with an error bound
   (hd_scene_has_error_bound). */
#ifndef HD_RENDER_FRAME_H
#define HD_RENDER_FRAME_H

#include "device/renderer.h"

/* The source of frames and their request. */
typedef struct HdFrameMaker {
    HdRenderer *renderer;
    const HdScene *scene; /* scene on the renderer; size, crop, samples and less depth may differ */
    HdFrameRequest request;    /* its curve measures errors; frames with a bound are radiance */
    HdWatch *watch;            /* NULL: none */
    struct HdBounded *bounded; /* private; for a scene with an error bound */
} HdFrameMaker;

/* A frame in flight. The struct must stay in place until the frame ends, or until its tables are
   freed after hd_renderer_drop. */
typedef struct HdFrameInFlight {
    HdCamera camera;
    HdFrameTables tables;
} HdFrameInFlight;

/* Allocates the members for an error bound; the caller sets all others. */
HdStatus hd_frame_maker_open(HdFrameMaker *maker, HdError *error);

/* Closes the maker, which need not be open. */
void hd_frame_maker_close(HdFrameMaker *maker);

/* Returns the most frames in flight: HD_FRAMES_IN_FLIGHT, or 1 with an error bound, as such a frame
   consists of several dependent passes. */
int hd_frame_max_in_flight(const HdFrameMaker *maker);

/* Compile and begin a frame. On failure nothing needs dropping, and earlier frames stay in flight.
 */
HdStatus hd_frame_prepare(const HdFrameMaker *maker, const HdCamera *camera,
                          HdFrameInFlight *in_flight, HdError *error);
HdStatus hd_frame_begin(const HdFrameMaker *maker, HdFrameInFlight *in_flight, HdError *error);

/* Blocks on the oldest frame in flight and retires it, even on failure. `frame` has space for the
   request (hd_renderer_collect) and gets the layers that it has space for. */
HdStatus hd_frame_end(const HdFrameMaker *maker, HdFrameInFlight *in_flight, HdFrame *frame,
                      HdError *error);

/* Renders a frame's radiance while none is in flight; the maker need not be open. */
HdStatus hd_frame_render(const HdFrameMaker *maker, const HdCamera *camera, HdFrame *frame,
                         HdError *error);

#endif
