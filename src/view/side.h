/* SPDX-License-Identifier: MIT */
/* One side of a view: a scene with its settings, and the worker that renders it. */
#ifndef HD_VIEW_SIDE_H
#define HD_VIEW_SIDE_H

#include "view/view.h"
#include "view/worker.h"

typedef enum HdViewSetting {
    HD_VIEW_BACKEND,
    HD_VIEW_DEVICE,
    HD_VIEW_PRECISION,
    HD_VIEW_DEPTH,
    HD_VIEW_SAMPLES,
    HD_VIEW_SAMPLING
} HdViewSetting;

typedef struct HdViewSide {
    HdViewPlan plan;
    char device[32]; /* that the plan may name */
    HdSceneFile file;
    HdViewWorker *worker;
    int device_change, scene_change;
    uint64_t files; /* as they were when read last */
    HdViewImage image;
    int version;        /* of the image */
    char mistake[4096]; /* why the last reading failed; "": it did not */
} HdViewSide;

/* Reads the scene and starts the worker, which calls `wake`. On failure nothing is open. */
HdStatus hd_view_side_open(HdViewSide *side, const HdViewPlan *plan, void (*wake)(void *context),
                           void *context, HdError *error);

/* Reads the scene again if a file has changed; true where it did. With a mistake in it the side
   keeps what it had. */
bool hd_view_side_follow_files(HdViewSide *side);

/* Changes a setting, a number `by` so much, and reads the scene again. */
void hd_view_side_change(HdViewSide *side, HdViewSetting setting, int by);

/* A side that is not open may be closed. */
void hd_view_side_close(HdViewSide *side);

#endif
