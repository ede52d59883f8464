/* SPDX-License-Identifier: MIT */
/* Where the samples of a pixel are, and the surveys that render some of them, so often with a
   smaller cut-off that what was left out of each stays within bounds. */
#ifndef HD_RENDER_BOUND_PASS_H
#define HD_RENDER_BOUND_PASS_H

#include "device/renderer.h"
#include "image/curve.h"
#include "system/thread_pool.h"

/* Samples in places of a grid, each place once: column | row << 16. The first 1, 4, 16, ... samples
   are spread over the pixel as evenly as a grid of theirs. */
typedef struct HdSampleSet {
    int *places; /* owned */
    int count;
    int grid_side;
} HdSampleSet;

/* All places of a grid of side x side, 1 to 64, in the order in which a low-discrepancy sequence
   comes upon them: the first two dimensions of Sobol's, a (0, 2)-sequence in base 2 (Sobol 1967;
   Niederreiter 1992, section 4), turned over so that the first sample is next to the middle. */
HdStatus hd_sample_set_grid(HdSampleSet *set, int side, HdError *error);

/* side * side places, 1 to 64, on a grid of HD_DENSE_GRID: correlated multi-jittered samples
   (Kensler 2013), one in each cell of a grid of side x side and one in each of side * side columns
   and rows. An edge between black and white is seen with an error of at most 2.2 steps of 255 by
   32 x 32 of them, and by a grid with up to 4. */
enum { HD_DENSE_GRID = 4096 };
HdStatus hd_sample_set_dense(HdSampleSet *set, int side, HdError *error);

void hd_sample_set_free(HdSampleSet *set);

/* The radiance, after exposure, that may be missing from a pixel or sample whose darkest channel
   has `radiance` before its picture is off by `steps` of 255: on the linear curve the same
   everywhere, on sRGB's less where it is dark. It never exceeds what is allowed: the curve f grows
   by at most e where radiance grows by no more than e / f', for f is concave; and 1 / f' is above a
   straight line (docs/numerics.md). Being linear, it holds for the mean of samples if it holds for
   each. */
double hd_missing_allowed(HdCurve curve, double steps, double radiance);

/* By how many steps of 255 at most the picture is off where no more than `missing` is missing from
   any channel of such a pixel. */
double hd_missing_steps(HdCurve curve, double missing, double radiance);

float hd_darkest(const float rgb[3]);

/* Samples of a pixel that follow each other in the set: their means. */
typedef struct HdBoundedMean {
    float rgb[3]; /* radiance times exposure */
    float bound;  /* of what is missing from any channel */
} HdBoundedMean;

typedef struct HdBoundRequest {
    int pixel; /* x | y << 16 */
    int first; /* sample in the set */
} HdBoundRequest;

typedef struct HdBoundPasses {
    const HdScene *scene; /* uploaded; surveyed */
    HdRenderer *renderer; /* no frame is under way */
    const HdSampleSet *samples;
    HdCurve curve;          /* of the picture whose errors are limited */
    double max_left_out;    /* hd_max_left_out of the scene */
    HdThreadPool *threads;  /* for the host's work */
    const HdCamera *camera; /* of the passes */
    HdFrame *sums;          /* gets the counts of all passes added */
    int *entries, *open;    /* the surveyor's own from here on */
    int entry_capacity, open_capacity;
    HdFrame frame;
    int frame_rows; /* that it has room for */
} HdBoundPasses;

/* Gives up what the surveyor owns itself. */
void hd_bound_passes_free(HdBoundPasses *passes);

/* Has nothing but the limit of a scene (HdScene.max_error), if there is one, end its rays: no
   cut-off, and a depth so large that what lies beyond is worth little of the limit. */
void hd_bound_pass_end_rays(HdScene *scene);

/* Samples that are asked for at a time. */
typedef struct HdBoundPass {
    const HdBoundRequest *requests;
    int count;            /* of them, 1 or more */
    int samples;          /* of each */
    HdBoundedMean *means; /* what comes of each */
    HdWatched watched;    /* what all of it is worth */
} HdBoundPass;

/* Fills surveys[i] with the mean of the samples [first, first + samples) of request i. With a limit
   (HdScene.max_error) each bound is within it, unless depth or cut-off of the scene end rays
   before, or so many rays of a sample are needed that they come to no end: then it says by how
   much. */
HdStatus hd_bound_pass(HdBoundPasses *passes, const HdBoundPass *pass, HdError *error);

#endif
