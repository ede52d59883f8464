/* SPDX-License-Identifier: MIT */
/* Renders listed samples of a surveyed scene, so often with a smaller cut-off that what was left
   out of each of them stays within bounds. */
#ifndef HD_RENDER_SURVEY_H
#define HD_RENDER_SURVEY_H

#include "device/renderer.h"
#include "image/curve.h"
#include "render/samples.h"
#include "system/thread_pool.h"

/* How much may be missing from a pixel's radiance before its picture is off by so many steps of
   255: on the linear curve the same everywhere, on sRGB's less where it is dark. That is
   floor + slope * radiance for a step, times the number of steps. It never exceeds what is allowed:
   the curve f grows by at most e where radiance grows by no more than e / f', for f is concave; and
   1 / f' is above the straight line (docs/proofs.md). Being linear, it holds for the mean of
   samples if it holds for each of them. */
typedef struct HdErrorBudget {
    double floor, slope;
} HdErrorBudget;

HdErrorBudget hd_error_budget(HdCurve curve);

/* The radiance that may be missing for `steps` of 255, of a pixel or sample whose darkest channel
   has `radiance`, after exposure. */
double hd_error_budget_radiance(const HdErrorBudget *budget, double steps, double radiance);

/* By how many steps of 255 at most the picture is off where no more than `missing` is missing from
   any channel of such a pixel. */
double hd_missing_steps(HdCurve curve, double missing, double radiance);

/* Samples of a pixel that follow each other in the set: their means. */
typedef struct HdSurvey {
    float rgb[3]; /* radiance times exposure */
    float bound;  /* of what is missing from any channel */
} HdSurvey;

typedef struct HdSurveyRequest {
    int pixel; /* x | y << 16 */
    int first; /* sample in the set */
} HdSurveyRequest;

/* Column and row of number z of 64 pixels in Z order, in which items render theirs
   (kernels/common/render.h). */
static inline int hd_z_order_x(int z) {
    return (z & 1) | (z >> 1 & 2) | (z >> 2 & 4);
}

static inline int hd_z_order_y(int z) {
    return hd_z_order_x(z >> 1);
}

typedef struct HdSurveyor {
    const HdScene *scene; /* uploaded; surveyed */
    HdPrecision precision;
    HdRenderer *renderer; /* no frame is under way */
    const HdSampleSet *samples;
    HdErrorBudget budget;
    double most_left_out;  /* hd_most_left_out of the scene */
    HdThreadPool *threads; /* for the host's work */
    HdWatched pass;        /* what the pass to come is worth */
    HdFrame sums;          /* counts and time of all passes so far; without pixels */
    int *entries, *open;   /* the surveyor's own from here on */
    int entry_room, open_room;
    HdFrame frame;
    int frame_rows; /* that it has room for */
} HdSurveyor;

/* Gives up what the surveyor owns itself. */
void hd_surveyor_free(HdSurveyor *surveyor);

/* How deep a scene with such a limit must be, so that what lies beyond is worth little of it. */
int hd_survey_depth(const HdScene *scene);

/* Fills surveys[i] with the mean of the samples [first, first + samples) of request i. With a limit
   (HdScene.max_error) each bound is within it, unless depth or cut-off of the scene end rays
   before, or so many rays of a sample are needed that they come to no end: then it says by how
   much. */
HdStatus hd_survey_pass(HdSurveyor *surveyor, const HdCamera *camera,
                        const HdSurveyRequest *requests, int count, int samples, HdSurvey *surveys,
                        HdError *error);

#endif
