/* SPDX-License-Identifier: MIT */
/* The last step of a frame: its pictures get their names, and then it counts as stored. */
#ifndef HD_OUTPUT_PUBLISHER_H
#define HD_OUTPUT_PUBLISHER_H

#include <stdbool.h>

#include "image/frame.h"
#include "output/outputs.h"
#include "system/atomic_file.h"

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
    int tracer;           /* who traced it, if it was not finished */
    int done;             /* frames stored so far, this one included */
    const HdFrame *frame; /* without its pixels */
    bool was_finished;    /* before the run: of `frame` only the size is worth something */
    HdFrameTimes times;
} HdStoredFrame;

typedef struct HdPublisherPlan {
    const HdOutputPlan *outputs; /* settled; must live on */
    HdDurability durability;
    int most; /* frames that may wait, 1 or more */
    /* Called after each frame is stored, in their order. Must return HD_OK to go on. */
    HdStatus (*stored)(void *context, const HdStoredFrame *stored, HdError *error);
    void *context;
} HdPublisherPlan;

typedef struct HdPublisher HdPublisher;

HdStatus hd_publisher_create(HdPublisher **publisher, const HdPublisherPlan *plan, HdError *error);

/* Takes over a frame's files, by output, those with a stream; they wait under their temporary
   names. Settles first where as many frames wait as may. */
HdStatus hd_publisher_add(HdPublisher *publisher, const HdStoredFrame *stored, HdAtomicFile *files,
                          HdError *error);

/* Stores the frames that wait, in their order: together, because a disk is waited for as long for
   one file as for many. With HD_DURABLE all bytes are on the disk before a file gets its name, and
   all names before `stored` is called. After a failure, which is that of the first frame that could
   not be stored, the frames before it are stored and later ones gone, but where `stored` failed,
   those that waited with that frame have their names. */
HdStatus hd_publisher_settle(HdPublisher *publisher, HdError *error);

/* Drops the frames that wait. NULL is no mistake. */
void hd_publisher_free(HdPublisher *publisher);

#endif
