/* SPDX-License-Identifier: MIT */
#include "choice/tuning.h"

#include <math.h>
#include <stdio.h>

/* A candidate must be that much faster than the best so far, so that noise decides nothing. */
#define CLEARLY_FASTER 0.98

typedef struct Tuner {
    HdTuning *tuning;
    const HdDevice *device;
    const HdRenderOptions *options;
    const HdJob *job;
    double share; /* of a frame's pixels, for all candidates; 0: not known yet */
    int times;    /* that the picture is rendered for a candidate */
} Tuner;

/* ---- one candidate ---- */

/* As much of the frame as takes a fifth of a second. Renders everything twice: the first time some
   drivers are still compiling. */
static HdStatus find_share(Tuner *tuner, HdRenderer *renderer, HdError *error) {
    const double first_samples = 4096.0, picture_seconds = 0.2, all_seconds = 0.5;
    const int least_times = 2, most_times = 40;
    const HdScene *scene = tuner->job->scene;
    double samples =
        (double)scene->width * scene->height * scene->samples_per_side * scene->samples_per_side;
    double share = fmin(1.0, first_samples / samples);
    for (;;) {
        HdTrialTime time;
        HdStatus status = hd_trial_measure(renderer, tuner->job, share, 2, &time, error);
        if (status != HD_OK)
            return status;
        tuner->share = share;
        tuner->times = (int)fmax(least_times, fmin(most_times, all_seconds / time.seconds));
        /* Four times as many pixels must not take much longer than that. */
        if (share >= 1.0 || time.seconds > picture_seconds / 4.0)
            return HD_OK;
        share = fmin(1.0, 4.0 * share);
    }
}

static HdStatus measure(Tuner *tuner, const HdLaunch *launch, HdTrialTime *time, HdError *error) {
    HdRenderOptions options = hd_launch_options(tuner->options, launch);
    HdRenderer *renderer;
    HdStatus status = hd_trial_open(&renderer, tuner->device, &options, tuner->job, error);
    if (status != HD_OK)
        return status;
    if (tuner->share <= 0.0)
        status = find_share(tuner, renderer, error);
    if (status == HD_OK)
        status = hd_trial_measure(renderer, tuner->job, tuner->share, tuner->times, time, error);
    hd_renderer_close(renderer);
    return status;
}

static HdStatus try(Tuner *tuner, const HdLaunch *launch, HdError *error) {
    HdTuning *tuning = tuner->tuning;
    HdTrialTime time = {0};
    if (tuning->count == HD_TUNING_CANDIDATES)
        return HD_OK;
    HdStatus status = measure(tuner, launch, &time, error);
    bool is_first = tuning->count == 0;
    if (status != HD_OK && (is_first || status == HD_INTERRUPTED || status == HD_BAD_INPUT))
        return status;
    HdTuningCandidate *candidate = &tuning->candidates[tuning->count];
    *candidate = (HdTuningCandidate){.launch = *launch, .seconds = time.trace_seconds};
    if (status != HD_OK)
        snprintf(candidate->failure, sizeof candidate->failure, "%.511s", error->message);
    if (is_first) {
        tuning->width = time.width;
        tuning->height = time.height;
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
        HdTrialTime time;
        if (candidate->failure[0] != '\0' || candidate->seconds > limit)
            continue;
        HdStatus status = measure(tuner, &candidate->launch, &time, error);
        if (status != HD_OK)
            return status;
        candidate->seconds = fmin(candidate->seconds, time.trace_seconds);
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

static HdLaunch best_so_far(const Tuner *tuner) {
    return tuner->tuning->candidates[tuner->tuning->best].launch;
}

/* The launch with each of the values for one of its members. */
static HdStatus try_each(Tuner *tuner, HdLaunch *launch, int *member, const int *values, int count,
                         HdError *error) {
    HdStatus status = HD_OK;
    for (int i = 0; status == HD_OK && i < count; i++) {
        *member = values[i];
        status = try(tuner, launch, error);
    }
    return status;
}

static HdStatus try_pipeline(Tuner *tuner, HdPipeline pipeline, HdError *error) {
    static const int limits[] = {64, 96, 128, 168};
    HdLaunch launch = hd_launch_of(tuner->options);
    launch.pipeline = pipeline;
    HdStatus status = try(tuner, &launch, error);
    if (status == HD_OK && tuner->device->nvidia_arch > 0 && tuner->options->registers == 0)
        status = try_each(tuner, &launch, &launch.registers, limits, 4, error);
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
    HdLaunch launch = best_so_far(tuner);
    return tuner->options->lanes == 0
               ? try_each(tuner, &launch, &launch.lanes, lanes + 1, count - 1, error)
               : HD_OK;
}

static HdStatus try_blocks(Tuner *tuner, HdError *error) {
    static const int blocks[] = {64, 128, 256};
    HdLaunch launch = best_so_far(tuner);
    return tuner->options->block == 0 ? try_each(tuner, &launch, &launch.block, blocks, 3, error)
                                      : HD_OK;
}

/* A few groups for each compute unit, which then take one item after the other. */
static HdStatus try_grids(Tuner *tuner, HdError *error) {
    static const int groups_per_unit[] = {8, 32};
    HdLaunch launch = best_so_far(tuner);
    HdStatus status = HD_OK;
    for (int i = 0; status == HD_OK && tuner->options->grid == 0 && i < 2; i++) {
        launch.grid = groups_per_unit[i] * tuner->device->compute_units;
        if (launch.grid > 0 && launch.grid <= HD_MAX_GRID)
            status = try(tuner, &launch, error);
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
