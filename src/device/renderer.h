/* SPDX-License-Identifier: MIT */
/* An open device of any backend: checks what it is asked, and has frames under way. */
#ifndef HD_DEVICE_RENDERER_H
#define HD_DEVICE_RENDERER_H

#include <stdbool.h>

#include "device/backend.h"

/* An open device. Messages of the functions below begin with the backend's name where the backend
   failed: "cuda: ...". */
typedef struct HdRenderer HdRenderer;

/* HD_UNAVAILABLE where the device has an obstacle. */
HdStatus hd_renderer_open(HdRenderer **renderer, const HdDevice *device,
                          const HdRenderOptions *options, HdError *error);

/* Users' scenes come by verify/trust.h, which looks at kernels that were compiled for them. */
HdStatus hd_renderer_upload(HdRenderer *renderer, const HdSceneTables *tables, HdError *error);

/* Begins a frame, for the device to work on meanwhile; fewer than HD_FRAMES_IN_FLIGHT are under
   way. The tables must live until the frame is collected or dropped; after a failure they need not,
   and earlier frames are still under way. HD_BAD_INPUT for misuse of this function and those
   beside it, for too large a picture and for kernels that are neither accepted nor on trial
   (kernel_cache.h). */
HdStatus hd_renderer_submit(HdRenderer *renderer, const HdFrameTables *tables,
                            const HdFrameRequest *request, HdError *error);

/* Waits for the oldest frame under way, of which there must be one, and retires it, even on
   failure. `frame` must have its size, and `rgba` unless radiance was wished for. HD_INTERRUPTED
   after a signal (interrupt.h), or if whoever watches wants it no more (watch.h). */
HdStatus hd_renderer_collect(HdRenderer *renderer, HdFrame *frame, HdError *error);

/* Fills the frame's `first`, which it must have (hd_frame_add_layers), with what is met first in
   the frame of those tables, for a renderer that was opened with `first_hits`. Frames may be under
   way. HD_INTERRUPTED as above. */
HdStatus hd_renderer_first_hits(HdRenderer *renderer, const HdFrameTables *tables, HdFrame *frame,
                                HdError *error);

/* Whether the backend failed in any of the functions above: that another device may do better,
   while other errors are due to what was asked for. */
bool hd_renderer_has_failed(const HdRenderer *renderer);

/* The seconds of the longest launch of the frames that were collected since the last call, or since
   the renderer was opened. Negative: not known, or nothing that would hold a display up. */
double hd_renderer_take_longest_launch(HdRenderer *renderer);

/* Waits until the device is done with the frames under way, and forgets them. */
void hd_renderer_drop(HdRenderer *renderer);

/* Submits a frame and collects its radiance. No other may be under way. */
HdStatus hd_renderer_render(HdRenderer *renderer, const HdFrameTables *tables, HdFrame *frame,
                            HdError *error);

/* Both live as long as the renderer. The pipeline is the one that was chosen. */
const HdDevice *hd_renderer_device(const HdRenderer *renderer);
const HdRenderOptions *hd_renderer_options(const HdRenderer *renderer);

/* How many lanes the renderer's kernels have: what scenes are compiled for. */
int hd_renderer_lanes(const HdRenderer *renderer);

enum { HD_RENDERER_LINE = 512 }; /* room for the line below */
void hd_renderer_describe(const HdRenderer *renderer, char *text, int capacity);

/* Where the kernels came from and what became of them, for people; "" where nobody compiles. */
const char *hd_renderer_kernels_note(const HdRenderer *renderer);

/* The kernels that the renderer compiles; NULL: nobody compiles. */
HdKernelCache *hd_renderer_kernels(const HdRenderer *renderer);

/* Computes a batch of the arithmetic probe with such kernels. There is no scene afterwards. */
HdStatus hd_renderer_compute(HdRenderer *renderer, const HdProbeBatch *batch,
                             HdProbeResults *results, HdError *error);

/* Opens the device anew for the wavefront, with other kernels and no scene. False, and nothing
   happened, where it has none, works by it already or is to keep its pipeline. */
bool hd_renderer_change_to_wavefront(HdRenderer *renderer);

/* Notes a failure, other than HD_INTERRUPTED, as the backend's (hd_renderer_has_failed), and puts
   its name before the message. Returns `status`. */
HdStatus hd_renderer_fail(HdRenderer *renderer, HdStatus status, HdError *error);

/* Drops what is under way. NULL is allowed. */
void hd_renderer_close(HdRenderer *renderer);

#endif
