/* SPDX-License-Identifier: MIT */
/* An open device of any backend: checks what it is asked, and tests what it compiled. */
#ifndef HD_DEVICE_RENDERER_H
#define HD_DEVICE_RENDERER_H

#include <stdbool.h>

#include "device/backend.h"
#include "device/probe.h"
#include "device/self_test_scenes.h"

/* An open device. Messages of the functions below begin with the backend's name where the backend
   failed: "cuda: ...". */
typedef struct HdRenderer HdRenderer;

/* HD_UNAVAILABLE where the device has an obstacle. */
HdStatus hd_renderer_open(HdRenderer **renderer, const HdDevice *device,
                          const HdRenderOptions *options, HdError *error);

/* Kernels that were compiled anew for the scene must first pass the self-test (self_test.h), with
   strict arithmetic. Where those of the megakernel fail it, the wavefront takes over, and a note
   tells (machine.h); HD_UNAVAILABLE where it fails too. Kernels that pass are kept on disk. */
HdStatus hd_renderer_upload(HdRenderer *renderer, const HdSceneTables *tables, HdError *error);

/* Begins a frame, so that the device works on it while the caller does other things; at most
   HD_FRAMES_IN_FLIGHT are under way. The tables must live until the frame is collected or dropped;
   on failure they need not, and the earlier frames are still under way. */
HdStatus hd_renderer_submit(HdRenderer *renderer, const HdFrameTables *tables,
                            const HdFrameWish *wish, HdError *error);

/* Waits for the oldest frame under way; whatever comes of it, it is so no longer. `frame` must have
   its size, and `rgba` unless radiance was wished for. HD_INTERRUPTED where a signal came first
   (interrupt.h), or whoever watches wants it no more (watch.h). */
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

/* Lives as long as the renderer. */
const HdDevice *hd_renderer_device(const HdRenderer *renderer);

/* How many lanes the renderer's kernels have: what scenes are compiled for. */
int hd_renderer_lanes(const HdRenderer *renderer);

void hd_renderer_describe(const HdRenderer *renderer, char *text, int capacity);

/* Where the kernels came from and what became of them, for people; "" where nobody compiles. */
const char *hd_renderer_kernels_note(const HdRenderer *renderer);

/* Probes the arithmetic of a device that compiles its kernels, whatever is remembered of it
   (probe.h), and remembers what came of it. There is no scene afterwards. */
HdStatus hd_renderer_probe(HdRenderer *renderer, int tuples, HdProbeReport *report, HdError *error);

/* Renders the frames of the self-test (self_test.h) by kernels that do what a scene with tables
   like these needs, `hash` being that of what is expected and `frame` the last one. There is no
   scene afterwards. */
HdStatus hd_renderer_self_test(HdRenderer *renderer, const HdSceneTables *like, uint64_t *hash,
                               HdSelfTestFrame *frame, bool *is_wrong, HdError *error);

/* What compiled the kernels; "": nobody knows, or they are built in. */
void hd_renderer_kernel_maker(const HdRenderer *renderer, char *text, size_t capacity);

/* Drops what is under way. NULL is allowed. */
void hd_renderer_close(HdRenderer *renderer);

#endif
