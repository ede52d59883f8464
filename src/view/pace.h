/* SPDX-License-Identifier: MIT */
/* How large a picture may be, how many samples its pixels may have and how deep its rays may go, so
   that it is there in time while something moves. */
#ifndef HD_VIEW_PACE_H
#define HD_VIEW_PACE_H

/* Seconds for a moving picture: 38 in a second, for above 25 are wanted, and times vary. */
#define HD_MOVING_SECONDS 0.026

/* What was measured: seconds of a sample, smoothed; 0: nothing was yet. */
typedef struct HdPace {
    double seconds_per_sample;
    int depth; /* that pictures have for now, where it is less than the scene's; 0: the scene's */
} HdPace;

typedef struct HdDetail {
    int width, height;
    int samples; /* of a side */
    int depth;
} HdDetail;

/* A picture of that detail took so many seconds. */
void hd_pace_note(HdPace *pace, const HdDetail *detail, double seconds);

/* The most detail that is made in time, at most `full`. All of the picture's pixels come before
   more samples; depth is given up last, where a picture would be too small to tell anything. */
HdDetail hd_pace_choose(HdPace *pace, const HdDetail *full);

#endif
