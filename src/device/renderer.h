/* SPDX-License-Identifier: MIT */
/* Opens a device of any backend, checks the use of its functions, and tracks frames in flight. */
#ifndef HD_DEVICE_RENDERER_H
#define HD_DEVICE_RENDERER_H

#include <stdbool.h>

#include "device/backend.h"

/* Open device. If the backend fails, messages of the functions below begin with its name: "cuda:
   ...". */
typedef struct HdRenderer HdRenderer;

/* Opens a renderer. HD_UNAVAILABLE if the device has an unsupported reason. */
HdStatus hd_renderer_open(HdRenderer **renderer, const HdDevice *device,
                          const HdRenderOptions *options, HdError *error);

/* Uploads a scene. Users' scenes go through verify/trust.h, which tests their compiled kernels. */
HdStatus hd_renderer_upload(HdRenderer *renderer, const HdSceneTables *tables, HdError *error);

/* Begins a frame without waiting; fewer than HD_FRAMES_IN_FLIGHT are in flight. The tables must
   live until the frame is collected or dropped. After a failure they need not, and earlier frames
   stay in flight. HD_BAD_INPUT if this function or its neighbours are misused, the picture is too
   large, or the kernels are neither accepted nor on trial (kernel_cache.h). */
HdStatus hd_renderer_submit(HdRenderer *renderer, const HdFrameTables *tables,
                            const HdFrameRequest *request, HdError *error);

/* Blocks on the oldest frame in flight, fills `frame`, and removes it from the queue, also if the
   backend fails. `frame` must have the width, height and floats of the submitted tables, and
   `rgba` unless radiance was requested. HD_BAD_INPUT: no frame is in flight, or the size or
   floats differ; nothing is then collected. HD_INTERRUPTED: a signal came (interrupt.h) or the
   caller's watch cancelled (watch.h). After an error the pixels are undefined. */
HdStatus hd_renderer_collect(HdRenderer *renderer, HdFrame *frame, HdError *error);

/* Fills the frame's `first` (hd_frame_add_layers) with the first hits of those tables. The renderer
   must have been opened with `first_hits`. Frames may be in flight. HD_INTERRUPTED as above. */
HdStatus hd_renderer_first_hits(HdRenderer *renderer, const HdFrameTables *tables, HdFrame *frame,
                                HdError *error);

/* Returns whether the backend failed in any of the functions above, so that another device may
   succeed. Other errors are due to the request. */
bool hd_renderer_has_failed(const HdRenderer *renderer);

/* Returns the seconds of the longest launch of the frames collected since the last call or since
   opening. Negative: unknown, or no launch could block a display. */
double hd_renderer_take_longest_launch(HdRenderer *renderer);

/* Waits until the device has finished the frames in flight, and discards them. */
void hd_renderer_drop(HdRenderer *renderer);

/* Submits a frame and collects its radiance. No other may be in flight. */
HdStatus hd_renderer_render(HdRenderer *renderer, const HdFrameTables *tables, HdFrame *frame,
                            HdError *error);

/* Return members that live as long as the renderer. The pipeline is the chosen one. */
const HdDevice *hd_renderer_device(const HdRenderer *renderer);
const HdRenderOptions *hd_renderer_options(const HdRenderer *renderer);

/* Returns the lanes of the renderer's kernels, for which scenes are compiled. */
int hd_renderer_lanes(const HdRenderer *renderer);

enum { HD_RENDERER_LINE = 512 }; /* capacity of the text below */
void hd_renderer_describe(const HdRenderer *renderer, char *text, int capacity);

/* Returns the origin and test of the kernels, for people; "" if they are built in. */
const char *hd_renderer_kernels_note(const HdRenderer *renderer);

/* Returns the kernels that the renderer compiles; NULL: none. */
HdKernelCache *hd_renderer_kernels(const HdRenderer *renderer);

/* Computes a batch of the arithmetic probe with such kernels. Discards the scene. */
HdStatus hd_renderer_compute(HdRenderer *renderer, const HdProbeBatch *batch,
                             HdProbeResults *results, HdError *error);

/* Reopens the device for the wavefront, with other kernels and no scene. Returns false and changes
   nothing if it has no wavefront, uses it already or must keep its pipeline. */
bool hd_renderer_change_to_wavefront(HdRenderer *renderer);

/* Records a failure, other than HD_INTERRUPTED, as the backend's (hd_renderer_has_failed), and
   prefixes the message with its name. Returns `status`. */
HdStatus hd_renderer_fail(HdRenderer *renderer, HdStatus status, HdError *error);

/* Drops the frames in flight and closes. NULL is allowed. */
void hd_renderer_close(HdRenderer *renderer);

#endif
