/* SPDX-License-Identifier: MIT */
#include "choice/tune.h"

#include <math.h>
#include <stdio.h>

/* A candidate must be that much faster than the best so far, so that noise decides nothing. */
#define CLEARLY_FASTER 0.98

typedef struct Tuner {
    HdTuning *tuning;
    const HdDevice *device;
    const HdRenderOptions *options;
    const HdJob *job;
    HdTrialWish how; /* for all candidates; a share of 0: not known yet */
} Tuner;

/* ---- one candidate ---- */

/* As much of the frame as takes a fifth of a second: four times as many pixels must not take much
   longer than that. Everything is rendered twice: the first time some drivers are still compiling.
 */
static HdStatus find_share(Tuner *tuner, HdRenderer *renderer, HdError *error) {
    const double picture_seconds = 0.2, all_seconds = 0.5;
    const int least_times = 2, most_times = 40;
    const HdTrialWish wish = {.believed = picture_seconds / 4.0, .times = 2};
    HdTrial trial;
    HdStatus status = hd_trial(renderer, tuner->job, &wish, &trial, error);
    if (status != HD_OK)
        return status;
    tuner->how.share = trial.share;
    tuner->how.times = (int)fmax(least_times, fmin(most_times, all_seconds / trial.seconds));
    return HD_OK;
}

static HdStatus measure(Tuner *tuner, const HdRenderOptions *options, HdTrial *trial,
                        HdError *error) {
    HdRenderer *renderer;
    HdStatus status = hd_trial_open(&renderer, tuner->device, options, tuner->job, error);
    if (status != HD_OK)
        return status;
    if (tuner->how.share <= 0.0)
        status = find_share(tuner, renderer, error);
    if (status == HD_OK)
        status = hd_trial(renderer, tuner->job, &tuner->how, trial, error);
    hd_renderer_close(renderer);
    return status;
}

static HdStatus try(Tuner *tuner, const HdRenderOptions *options, HdError *error) {
    HdTuning *tuning = tuner->tuning;
    HdTrial trial = {0};
    if (tuning->count == HD_TUNING_CANDIDATES)
        return HD_OK;
    HdStatus status = measure(tuner, options, &trial, error);
    bool is_first = tuning->count == 0;
    if (status != HD_OK && (is_first || status == HD_INTERRUPTED || status == HD_BAD_INPUT))
        return status;
    HdTuningCandidate *candidate = &tuning->candidates[tuning->count];
    *candidate = (HdTuningCandidate){.options = *options, .seconds = trial.trace_seconds};
    if (status != HD_OK)
        snprintf(candidate->failure, sizeof candidate->failure, "%.511s", error->message);
    if (is_first) {
        tuning->width = trial.width;
        tuning->height = trial.height;
    }
    tuning->count++;
    return HD_OK;
}

/* ---- the best of those so far ---- */

static void find_best(HdTuning *tuning) {
    tuning->best = 0;
    for (int i = 1; i < tuning->count; i++) {
        const HdTuningCandidate *candidate = &tuning->candidates[i];
        if (candidate->failure[0] == '\0' &&
            candidate->seconds < CLEARLY_FASTER * tuning->candidates[tuning->best].seconds)
            tuning->best = i;
    }
}

/* Where others use the machine too, they do so for a while: what was slow may have been unlucky. */
static HdStatus measure_again(Tuner *tuner, HdError *error) {
    const double near = 1.5;
    HdTuning *tuning = tuner->tuning;
    double limit = near * tuning->candidates[tuning->best].seconds;
    for (int i = 0; i < tuning->count; i++) {
        HdTuningCandidate *candidate = &tuning->candidates[i];
        HdTrial trial;
        if (candidate->failure[0] != '\0' || candidate->seconds > limit)
            continue;
        HdStatus status = measure(tuner, &candidate->options, &trial, error);
        if (status != HD_OK)
            return status;
        candidate->seconds = fmin(candidate->seconds, trial.trace_seconds);
    }
    return HD_OK;
}

static HdStatus choose(Tuner *tuner, HdError *error) {
    const int rounds = 2;
    HdStatus status = HD_OK;
    find_best(tuner->tuning);
    for (int i = 0; status == HD_OK && i < rounds; i++) {
        status = measure_again(tuner, error);
        find_best(tuner->tuning);
    }
    return status;
}

/* ---- all of them ---- */

static HdRenderOptions best_so_far(const Tuner *tuner) {
    return tuner->tuning->candidates[tuner->tuning->best].options;
}

/* The launch with each of the values for one of its members. */
static HdStatus try_each(Tuner *tuner, HdRenderOptions *options, int *member, const int *values,
                         int count, HdError *error) {
    HdStatus status = HD_OK;
    for (int i = 0; status == HD_OK && i < count; i++) {
        *member = values[i];
        status = try(tuner, options, error);
    }
    return status;
}

static HdStatus try_pipeline(Tuner *tuner, HdPipeline pipeline, HdError *error) {
    static const int limits[] = {64, 96, 128, 168};
    HdRenderOptions options = *tuner->options;
    options.pipeline = pipeline;
    HdStatus status = try(tuner, &options, error);
    if (status == HD_OK && tuner->device->nvidia_arch > 0 && tuner->options->registers == 0)
        status = try_each(tuner, &options, &options.registers, limits, 4, error);
    return status;
}

static HdStatus try_pipelines(Tuner *tuner, HdError *error) {
    static const HdPipeline pipelines[] = {HD_PIPELINE_MEGA, HD_PIPELINE_WAVEFRONT};
    HdPipeline suits = hd_choose_pipeline(tuner->device, tuner->options, tuner->job->scene);
    HdStatus status = try_pipeline(tuner, suits, error);
    for (int i = 0; status == HD_OK && tuner->options->pipeline == HD_PIPELINE_AUTO && i < 2; i++) {
        bool is_too_long = pipelines[i] == HD_PIPELINE_MEGA &&
                           hd_megakernel_is_too_long(tuner->device, tuner->options);
        if (pipelines[i] != suits && !is_too_long)
            status = try_pipeline(tuner, pipelines[i], error);
    }
    return status;
}

#define LISTED(number) number,

/* All bundles that the device takes but single rays. */
static HdStatus try_lanes(Tuner *tuner, HdError *error) {
    static const int lanes[] = {HD_LANE_COUNTS(LISTED)};
    int count = (int)(sizeof lanes / sizeof *lanes);
    int most = tuner->device->most_lanes[tuner->options->precision];
    while (most > 0 && lanes[count - 1] > most)
        count--;
    HdRenderOptions options = best_so_far(tuner);
    return tuner->options->lanes == 0
               ? try_each(tuner, &options, &options.lanes, lanes + 1, count - 1, error)
               : HD_OK;
}

static HdStatus try_blocks(Tuner *tuner, HdError *error) {
    static const int blocks[] = {64, 128, 256};
    HdRenderOptions options = best_so_far(tuner);
    return tuner->options->block == 0 ? try_each(tuner, &options, &options.block, blocks, 3, error)
                                      : HD_OK;
}

/* A few groups for each compute unit, which then take one item after the other. */
static HdStatus try_grids(Tuner *tuner, HdError *error) {
    static const int groups_per_unit[] = {8, 32};
    HdRenderOptions options = best_so_far(tuner);
    HdStatus status = HD_OK;
    for (int i = 0; status == HD_OK && tuner->options->grid == 0 && i < 2; i++) {
        options.grid = groups_per_unit[i] * tuner->device->compute_units;
        if (options.grid > 0 && options.grid <= HD_MAX_GRID)
            status = try(tuner, &options, error);
    }
    return status;
}

HdStatus hd_tune(HdTuning *tuning, const HdDevice *device, const HdRenderOptions *options,
                 const HdJob *job, HdError *error) {
    typedef HdStatus Stage(Tuner *, HdError *);
    Stage *const of_cpus[] = {try_pipelines, try_lanes, NULL};
    Stage *const of_gpus[] = {try_pipelines, try_blocks, try_grids, NULL};
    bool has_groups = !device->is_cpu || options->test.groups;
    Tuner tuner = {.tuning = tuning, .device = device, .options = options, .job = job};
    HdStatus status = HD_OK;
    tuning->count = tuning->best = 0;
    for (Stage *const *stage = has_groups ? of_gpus : of_cpus; status == HD_OK && *stage; stage++) {
        status = (*stage)(&tuner, error);
        if (status == HD_OK)
            status = choose(&tuner, error);
    }
    return status;
}

HdStatus hd_tuning_remember(const HdTuning *tuning, const HdDevice *device,
                            const HdRenderOptions *options, const HdScene *scene, HdError *error) {
    const HdTuningCandidate *best = &tuning->candidates[tuning->best];
    const HdTeamDevice measured = {
        .device = *device, .options = best->options, .seconds = best->seconds};
    return hd_measured_put(&measured, 1, options, scene, error);
}
