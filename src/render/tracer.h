/* SPDX-License-Identifier: MIT */
/* Traces frames of a sequence on one device, and gives them to the store. */
#ifndef HD_RENDER_TRACER_H
#define HD_RENDER_TRACER_H

#include "device/renderer.h"
#include "output/frame_store.h"
#include "render/adaptive.h"
#include "scene/frame_list.h"
#include "scene/scene.h"

/* The same for all that trace frames of a sequence. */
typedef struct HdTracerJob {
    const HdScene *scene;
    const HdFrameList *frames;
    HdPrecision precision;
    HdFrameWish wish;
    double start; /* of the run, by hd_monotonic_seconds */
    HdFrameStore *store;
} HdTracerJob;

/* A frame that the renderer works on. */
typedef struct HdFlight {
    int place; /* in the list */
    HdFrameTables tables;
    HdSpan prepare;
    double begun; /* seconds since the start of the run */
} HdFlight;

typedef struct HdTracer {
    const HdTracerJob *job;
    int number; /* the store's for it */
    HdRenderer *renderer;
    HdRefinement *refinement; /* NULL: the scene is not surveyed */
    int begun, ended;         /* frames so far */
    HdFlight flights[HD_FRAMES_IN_FLIGHT];
    double traced;   /* when the last frame's tracing was over */
    double finished; /* when the last frame was */
} HdTracer;

/* The scene is on the renderer; both must live on. */
HdStatus hd_tracer_open(HdTracer *tracer, const HdTracerJob *job, HdRenderer *renderer, int number,
                        HdError *error);

/* Who watches a tracer; each is called on its thread. */
typedef struct HdTracerWatch {
    /* Whether it is to take a frame now (HdTaker). */
    bool (*wants)(void *context, int left);
    /* A frame was begun; one was finished, for which the device took so long. */
    void (*begun)(void *context);
    void (*finished)(void *context, double seconds);
    /* A frame that was begun went back to the store. */
    void (*given_back)(void *context);
    void *context;
} HdTracerWatch;

/* Traces frames until the store has none left. What a frame itself is to blame for, the store is
   told. Fails where the device fails (hd_renderer_has_failed), and with HD_INTERRUPTED after a
   signal: what was under way is then given back to the store. `watch` may be NULL. */
HdStatus hd_tracer_run(HdTracer *tracer, const HdTracerWatch *watch, HdError *error);

void hd_tracer_close(HdTracer *tracer);

#endif
