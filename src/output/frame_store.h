/* SPDX-License-Identifier: MIT */
/* Stores frames while the next ones are rendered: converts them for films, hands them to FFmpeg,
   writes pictures, each on threads of its own. */
#ifndef HD_OUTPUT_FRAME_STORE_H
#define HD_OUTPUT_FRAME_STORE_H

#include <stdbool.h>

#include "image/frame.h"
#include "output/outputs.h"
#include "output/resume.h"
#include "output/stages.h"

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
    int worker;           /* who traced it, if it was not finished */
    int done;             /* frames stored so far, this one included */
    const HdFrame *frame; /* without its pixels */
    bool was_finished;    /* before the run: of `frame` only the size is worth something */
    HdFrameTimes times;
} HdStoredFrame;

typedef struct HdFrameStorePlan {
    const HdOutputPlan *outputs; /* settled */
    HdResume *resume;            /* which frames are finished: the store takes these by itself, and
                                               reads them back for films */
    int width, height;
    int workers;  /* how many trace frames, 1 or more */
    double start; /* of the run, by hd_monotonic_seconds */
    /* Called on a thread of the store after each frame is stored, in their order. Must return HD_OK
       to go on. */
    HdStatus (*stored)(void *context, const HdStoredFrame *stored, HdError *error);
    void *context;
} HdFrameStorePlan;

typedef struct HdFrameStore HdFrameStore;

/* Removes what killed runs left (resume.h). Finds out whether the pictures of the first missing
   frame can be written, which makes their folders, and starts the films. What the plan points to
   must live on. On failure no file is left behind. */
HdStatus hd_frame_store_start(HdFrameStore **store, const HdFrameStorePlan *plan, HdError *error);

/* Where tracers take frames that are not finished, by their place in the list, and give them. */
HdStages *hd_frame_store_stages(HdFrameStore *store);

/* A frame that was taken and has room, to be filled by the tracer that took it, its times up to
   `copy` included, before it is given. */
HdFrame *hd_frame_store_frame(HdFrameStore *store, int place, int worker, HdFrameTimes **times);

/* Waits until the frames are stored that were given or finished, those after one that failed or was
   not given excepted: they are the first ones, and no later one has left pictures. Ends the films
   if all went well, or else drops them; frees `store`. `traced` is how tracing ended, and `error`
   then its error, which that of an earlier frame replaces; HD_INTERRUPTED tells how many frames
   were stored, and how many of them another run finds finished. */
HdStatus hd_frame_store_end(HdFrameStore *store, HdStatus traced, HdError *error);

#endif
