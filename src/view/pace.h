/* SPDX-License-Identifier: MIT */
/* How large a picture may be, and how many samples its pixels may have, so that it is there in time
   while something moves. */
#ifndef HD_VIEW_PACE_H
#define HD_VIEW_PACE_H

/* Seconds for a moving picture: 33 in a second, for above 25 are wanted and times vary. */
#define HD_MOVING_SECONDS 0.030

/* What was measured: seconds of a sample, smoothed; 0: nothing was yet. */
typedef struct HdPace {
    double seconds_per_sample;
} HdPace;

typedef struct HdDetail {
    int width, height;
    int samples; /* of a side */
} HdDetail;

/* A picture of that detail took so many seconds. */
void hd_pace_note(HdPace *pace, const HdDetail *detail, double seconds);

/* The most detail that is made in time, at most `full`. All of the picture's pixels come before
   more samples. */
HdDetail hd_pace_choose(const HdPace *pace, const HdDetail *full);

#endif
