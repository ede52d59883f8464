/* SPDX-License-Identifier: MIT */
/* Stores frames while later ones are rendered: threads convert them, send them to FFmpeg and write
   pictures. */
#ifndef HD_OUTPUT_FRAME_STORE_H
#define HD_OUTPUT_FRAME_STORE_H

#include <stdbool.h>

#include "image/frame.h"
#include "output/outputs.h"
#include "output/resume.h"
#include "output/stages.h"

/* A time span in seconds. */
typedef struct HdSpan {
    double began;   /* since the start of the run; negative: nothing to do */
    double seconds; /* 0 if there was nothing to do */
} HdSpan;

/* Times of one frame's steps. */
typedef struct HdFrameTimes {
    HdSpan prepare; /* the camera and its tables */
    HdSpan trace;   /* tracing on the device */
    HdSpan copy;    /* further waiting for the frame */
    HdSpan convert; /* conversion to 8 bits, if a film needs it and the device has not done it */
    HdSpan store;   /* encoding and writing pictures */
    HdSpan film;    /* sending it to FFmpeg, for all films */
    double longest_launch; /* longest GPU launch, in seconds; negative: unknown, or no GPU */
} HdFrameTimes;

/* Properties of a stored frame. */
typedef struct HdStoredFrame {
    int number;
    int worker;           /* worker that traced it, if it was not finished before */
    int done;             /* number of frames stored so far, this one included */
    const HdFrame *frame; /* frame without its pixels */
    bool was_finished;    /* finished before the run; only the size of `frame` is then valid */
    HdFrameTimes times;
} HdStoredFrame;

typedef struct HdFrameStorePlan {
    const HdOutputPlan *outputs; /* settled */
    HdResume *resume; /* finished frames need no worker; the store reads them for films */
    int width, height;
    int workers;  /* number of workers, 1 or more */
    double start; /* start of the run, by hd_monotonic_seconds */
    /* Reports each stored frame, in order, on a thread of the store. Returns HD_OK to continue. */
    HdStatus (*stored)(void *context, const HdStoredFrame *stored, HdError *error);
    void *context;
} HdFrameStorePlan;

typedef struct HdFrameStore HdFrameStore;

/* Removes files of killed runs (resume.h), makes folders, checks that pictures of the first missing
   frame can be written, and starts the films. The plan's pointers must live on. On failure no file
   is left. */
HdStatus hd_frame_store_start(HdFrameStore **store, const HdFrameStorePlan *plan, HdError *error);

/* Returns the stages, from which workers claim frames by index in the list and to which they submit
   them. */
HdStages *hd_frame_store_stages(HdFrameStore *store);

/* Returns the buffer of a claimed frame with capacity. The worker fills it and the times up to
   `copy` before it submits the frame. */
HdFrame *hd_frame_store_frame(HdFrameStore *store, int item, int worker, HdFrameTimes **times);

/* Waits until all submitted or finished frames before the first failed or missing one are stored;
   later ones leave no pictures. Completes the films if all went well, or else discards them; frees
   `store`. `traced` and `error` are the result of tracing; the error of an earlier frame replaces
   them. HD_INTERRUPTED reports the number of stored frames, and how many of them another run finds
   finished. */
HdStatus hd_frame_store_end(HdFrameStore *store, HdStatus traced, HdError *error);

#endif
