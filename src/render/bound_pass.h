/* SPDX-License-Identifier: MIT */
/* Sample positions in a pixel, and bound passes: they render samples with ever smaller cut-offs
   until each truncation error is within its limit. */
#ifndef HD_RENDER_BOUND_PASS_H
#define HD_RENDER_BOUND_PASS_H

#include "device/renderer.h"
#include "image/curve.h"
#include "system/thread_pool.h"

/* Distinct samples on a grid: column | row << 16. Of a set from hd_sample_set_grid, the first 1, 4,
   16, ... samples cover the pixel as evenly as a grid of that size. */
typedef struct HdSampleSet {
    int *places; /* owned */
    int count;
    int grid_side;
} HdSampleSet;

/* Creates all positions of a grid of side x side, 1 to 64, in the order of a low-discrepancy
   sequence: Sobol's first two dimensions, a (0, 2)-sequence in base 2 (Sobol 1967; Niederreiter
   1992, section 4), with bits flipped so that the first sample is near the centre. */
HdStatus hd_sample_set_grid(HdSampleSet *set, int side, HdError *error);

/* Creates side * side positions, 1 to 64, on a grid of HD_DENSE_GRID: correlated multi-jittered
   samples (Kensler 2013). Each cell of side x side holds one, and so does each of side * side
   columns and rows. For an edge between black and white, 32 x 32 of them have an error of at most
   2.2/255; a grid has up to 4/255. */
enum { HD_DENSE_GRID = 4096 };
HdStatus hd_sample_set_dense(HdSampleSet *set, int side, HdError *error);

/* Fills the set with the positions of hd_multijitter for a grid of side x side cells. */
HdStatus hd_sample_set_multijitter(HdSampleSet *set, int side, HdError *error);

void hd_sample_set_free(HdSampleSet *set);

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

/* Mean of consecutive samples of a pixel. */
typedef struct HdBoundedMean {
    float rgb[3]; /* radiance times exposure */
    float bound;  /* most that is missing from any channel */
} HdBoundedMean;

typedef struct HdBoundRequest {
    int pixel; /* x | y << 16 */
    int first; /* index of the first sample in the set */
} HdBoundRequest;

typedef struct HdBoundPasses {
    const HdScene *scene; /* uploaded; with an error bound */
    HdRenderer *renderer; /* renderer without frames in flight */
    const HdSampleSet *samples;
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

/* Samples of one call. */
typedef struct HdBoundPass {
    const HdBoundRequest *requests;
    int count;            /* number of requests, 1 or more */
    int samples;          /* samples per request */
    HdBoundedMean *means; /* result of each */
    HdWatched watched;    /* progress weight of the whole pass */
} HdBoundPass;

/* Fills means[i] with the mean of the samples [first, first + samples) of request i. With a limit
   (HdScene.max_error) each bound is within it, unless the scene's depth or cut-off ends rays early
   or a sample needs too many rays; the bound then exceeds it. */
HdStatus hd_bound_pass(HdBoundPasses *passes, const HdBoundPass *pass, HdError *error);

#endif
