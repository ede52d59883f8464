/* SPDX-License-Identifier: MIT */
#include "view/pace.h"

#include <math.h>
#include <stdbool.h>

/* Before anything was measured: what two cores take for a common scene. */
#define USUAL_SECONDS 2e-6

/* Below this a picture tells nothing any more: rather its rays go less deep, and deeper again once
   the picture is larger than that by far. */
enum { LEAST_WIDTH = 128, DEEPER_WIDTH = 256, LEAST_DEPTH = 2 };

static double sample_count(const HdDetail *detail) {
    return (double)detail->width * detail->height * detail->samples * detail->samples;
}

/* A picture that took too long counts at once, a quick one by and by. */
void hd_pace_note(HdPace *pace, const HdDetail *detail, double seconds) {
    const double now = seconds / sample_count(detail), before = pace->seconds_per_sample;
    const double weight = now > before ? 0.6 : 0.2;
    pace->seconds_per_sample = before > 0.0 ? before + weight * (now - before) : now;
}

static int scaled(int side, double scale) {
    const int pixels = (int)(side * scale);
    return pixels > 1 ? pixels : 1;
}

/* A step at a time, for what a step saves is known when it was measured. */
static void adapt_depth(HdPace *pace, const HdDetail *full, double width) {
    const int depth = pace->depth > 0 && pace->depth < full->depth ? pace->depth : full->depth;
    const bool is_whole = width >= full->width;
    if (width < LEAST_WIDTH && !is_whole && depth > LEAST_DEPTH)
        pace->depth = depth - 1;
    else if (is_whole || width >= DEEPER_WIDTH)
        pace->depth = depth < full->depth ? depth + 1 : 0;
}

static HdDetail smaller(const HdDetail *full, double scale) {
    const double least = fmin(1.0, (double)LEAST_WIDTH / full->width);
    const double kept = fmax(scale, least);
    return (HdDetail){scaled(full->width, kept), scaled(full->height, kept), 1, full->depth};
}

HdDetail hd_pace_choose(HdPace *pace, const HdDetail *full) {
    const double each = pace->seconds_per_sample > 0.0 ? pace->seconds_per_sample : USUAL_SECONDS;
    const double share = HD_MOVING_SECONDS / each / ((double)full->width * full->height);
    HdDetail detail = *full;
    adapt_depth(pace, full, sqrt(share) * full->width);
    if (pace->depth > 0 && pace->depth < full->depth)
        detail.depth = pace->depth;
    if (share < 1.0)
        return smaller(&detail, sqrt(share));
    const double side = sqrt(share);
    if (side < full->samples)
        detail.samples = (int)side;
    return detail;
}
