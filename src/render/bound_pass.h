/* SPDX-License-Identifier: MIT */
/* Bound passes: they render pixels with ever smaller cut-offs until each truncation error is within
   its limit. */
#ifndef HD_RENDER_BOUND_PASS_H
#define HD_RENDER_BOUND_PASS_H

#include "device/renderer.h"
#include "image/curve.h"
#include "system/thread_pool.h"

/* Returns the radiance, after exposure, that may be missing from a pixel or sample whose darkest
   channel has `radiance`, if its picture may be off by `steps` of 1/255. It is constant on the
   linear curve and less in the dark on sRGB's. It is never too large: the concave curve f grows by
   at most e if radiance grows by at most e / f'. 1 / f' is above a straight line
   (docs/numerics.md). As it is linear, it holds for a mean of samples if it holds for each. */
double hd_missing_allowed(HdCurve curve, double steps, double radiance);

/* Returns the picture's largest error, in 1/255, if at most `missing` is missing from each channel
   of such a pixel. */
double hd_missing_steps(HdCurve curve, double missing, double radiance);

float hd_darkest(const float rgb[3]);

/* Mean of a pixel's samples. */
typedef struct HdBoundedMean {
    float rgb[3]; /* radiance times exposure */
    float bound;  /* most that is missing from any channel */
} HdBoundedMean;

typedef struct HdBoundPasses {
    const HdScene *scene;   /* uploaded; with an error bound */
    HdRenderer *renderer;   /* renderer without frames in flight */
    HdCurve curve;          /* curve of the picture whose errors are limited */
    double max_left_out;    /* hd_max_left_out of the scene */
    HdThreadPool *threads;  /* threads for the host's work */
    const HdCamera *camera; /* camera of the passes */
    HdFrame *sums;          /* accumulates the counts of all passes */
    int *entries, *open;    /* private from here on */
    int entry_capacity, open_capacity;
    HdFrame frame;
    int frame_rows; /* allocated rows */
} HdBoundPasses;

/* Frees the private members. */
void hd_bound_passes_free(HdBoundPasses *passes);

/* Makes only the scene's limit (HdScene.max_error), if any, end its rays: removes the cut-off and
   sets a depth beyond which little of the limit is left. */
void hd_bound_pass_end_rays(HdScene *scene);

/* Pixels of one call. */
typedef struct HdBoundPass {
    const int *pixels;    /* x | y << 16 */
    int count;            /* number of pixels, 1 or more */
    HdBoundedMean *means; /* result of each */
    HdWatched watched;    /* progress weight of the whole pass */
} HdBoundPass;

/* Fills means[i] with the mean of the samples of pixel i. With a limit (HdScene.max_error) each
   bound is within it, unless the scene's depth or cut-off ends rays early or a sample needs too
   many rays; the bound then exceeds it. */
HdStatus hd_bound_pass(HdBoundPasses *passes, const HdBoundPass *pass, HdError *error);

#endif
