/* SPDX-License-Identifier: MIT */
/* Stores frames while the next ones are rendered: converts them for films, hands them to FFmpeg,
   writes pictures, each on threads of its own. */
#ifndef HD_FRAME_STORE_H
#define HD_FRAME_STORE_H

#include "frame.h"
#include "frame_list.h"
#include "outputs.h"

/* When something was done, in seconds. */
typedef struct HdSpan {
    double began;   /* since the start of the run; negative: there was nothing to do */
    double seconds; /* 0 where there was nothing to do */
} HdSpan;

/* Where the time of one frame went. */
typedef struct HdFrameTimes {
    HdSpan prepare; /* the camera and its tables */
    HdSpan trace;   /* on the device */
    HdSpan copy;    /* what the frame was waited for beyond that */
    HdSpan convert; /* to 8 bits, where a film needs it and the device has not done it */
    HdSpan store;   /* encoding and writing pictures */
    HdSpan film;    /* handing it to FFmpeg: from the first film's begin to the last one's end */
    double longest_launch; /* seconds, of a GPU's kernel; negative: not known, or on no GPU */
} HdFrameTimes;

/* What is known once a frame is stored. */
typedef struct HdStoredFrame {
    int number;
    int done; /* frames stored so far, this one included */
    const HdFrame *frame;
    HdFrameTimes times;
} HdStoredFrame;

typedef struct HdFrameStorePlan {
    HdOutputs *outputs;
    const HdFrameList *frames;
    int width, height;
    double start; /* of the run, by hd_monotonic_seconds */
    /* Called after each frame is stored, in their order, on a thread of the store. Must return
       HD_OK to go on. */
    HdStatus (*stored)(void *context, const HdStoredFrame *stored, HdError *error);
    void *context;
} HdFrameStorePlan;

typedef struct HdFrameStore HdFrameStore;

/* What the plan points to must live on. */
HdStatus hd_frame_store_start(HdFrameStore **store, const HdFrameStorePlan *plan, HdError *error);

/* Waits for room for the next frame of the list, which the caller then fills, its times up to
   `copy` included. NULL after a failure: then no more frames are wanted. */
HdFrame *hd_frame_store_next(HdFrameStore *store, HdFrameTimes **times);

/* Takes the frame that was filled. */
void hd_frame_store_give(HdFrameStore *store);

/* Waits until the frames are stored that were given, those after one that failed excepted; frees
   `store`. Tells how many were stored: they are the first ones, and no later one has left
   pictures. */
HdStatus hd_frame_store_end(HdFrameStore *store, int *stored_count, HdError *error);

#endif
