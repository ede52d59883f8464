/* SPDX-License-Identifier: MIT */
/* Stores frames while the next ones are rendered: converts them for films, hands them to FFmpeg,
   writes pictures, each on threads of its own. */
#ifndef HD_OUTPUT_FRAME_STORE_H
#define HD_OUTPUT_FRAME_STORE_H

#include <stdbool.h>

#include "image/frame.h"
#include "output/outputs.h"
#include "output/resume.h"

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
    int tracer; /* who traced it, if it was not finished */
    int done;   /* frames stored so far, this one included */
    const HdFrame *frame;
    bool was_finished; /* before the run: of `frame` only the size is worth something */
    HdFrameTimes times;
} HdStoredFrame;

typedef struct HdFrameStorePlan {
    const HdOutputPlan *outputs; /* settled */
    const HdResume *resume;      /* which frames are finished: the store takes these by itself, and
                                    reads them back for films */
    int width, height;
    int tracers;  /* how many trace frames, 1 or more */
    double start; /* of the run, by hd_monotonic_seconds */
    /* Called after each frame is stored, in their order, on a thread of the store. Must return
       HD_OK to go on. */
    HdStatus (*stored)(void *context, const HdStoredFrame *stored, HdError *error);
    void *context;
} HdFrameStorePlan;

typedef struct HdFrameStore HdFrameStore;

/* Finds out whether the pictures of the first missing frame can be written, which makes their
   folders, and starts the films. What the plan points to must live on. On failure no file is left
   behind. */
HdStatus hd_frame_store_start(HdFrameStore **store, const HdFrameStorePlan *plan, HdError *error);

/* Takes the first frame of the list that is not finished and that nobody has traced or is tracing:
   its place in the list.
   The caller must give it, or give it back. `wants` says whether a tracer wants one (HdTaker);
   NULL: it does. Negative where there is none for it now; with `waits`, where there will be none.
 */
int hd_frame_store_take(HdFrameStore *store, bool (*wants)(void *context, int left), void *context,
                        bool waits);

/* Waits for room for a frame that was taken. False where it is not wanted any more. */
bool hd_frame_store_wait(HdFrameStore *store, int place);

/* A frame that has room, to be filled by who took it, its times up to `copy` included. */
HdFrame *hd_frame_store_frame(HdFrameStore *store, int place, HdFrameTimes **times);

/* Gives a frame to the store that was filled. */
void hd_frame_store_give(HdFrameStore *store, int place, int tracer);

/* Gives a frame back that was taken and cannot be traced, so that another tracer takes it. */
void hd_frame_store_give_back(HdFrameStore *store, int place);

/* Asks tracers that wait whether they want a frame now. */
void hd_frame_store_ask_again(HdFrameStore *store);

/* A frame that was taken cannot be had: the error of the whole run, if no earlier one fails. */
void hd_frame_store_fail(HdFrameStore *store, int place, const HdError *error);

/* No tracer gets another frame. */
void hd_frame_store_stop(HdFrameStore *store);

/* Waits until the frames are stored that were given or finished, those after one that failed or was
   not given excepted: they are the first ones, and no later one has left pictures. Ends the films
   if all went well, or else drops them; frees `store`. `traced` is how tracing ended, and `error`
   then its error, which that of an earlier frame replaces; HD_INTERRUPTED tells how many frames
   were stored. */
HdStatus hd_frame_store_end(HdFrameStore *store, HdStatus traced, HdError *error);

#endif
