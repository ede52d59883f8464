/* SPDX-License-Identifier: MIT */
#include "choice/measure.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/hash.h"
#include "base/text.h"
#include "device/kernel_source.h"
#include "render/frame.h"
#include "scene/sample_pattern.h"
#include "system/cache_folder.h"
#include "system/machine.h"
#include "verify/trust.h"

void hd_launch_describe(const HdRenderOptions *options, char *text, int capacity) {
    const struct {
        const char *form;
        int value;
    } parts[] = {
        {"%d lanes", options->lanes},
        {"groups of %d", options->block},
        {"at most %d groups", options->grid},
        {"at most %d registers", options->registers},
    };
    const size_t size = (size_t)capacity;
    snprintf(text, size, "%s",
             options->pipeline != HD_PIPELINE_AUTO ? hd_pipeline_names[options->pipeline] : "");
    for (int i = 0; i < 4; i++)
        if (parts[i].value > 0)
            hd_add_text(text, size, ", ", parts[i].form, parts[i].value);
    if (text[0] == '\0')
        snprintf(text, size, "as it suits the device");
}

/* ---- trials ---- */

HdStatus hd_trial_open(HdRenderer **renderer, const HdDevice *device,
                       const HdRenderOptions *options, const HdJob *job, HdError *error) {
    HD_TRY(hd_renderer_open(renderer, device, options, error));
    HdStatus status = hd_put_scene(*renderer, job->scene, NULL, error);
    if (status != HD_OK) {
        hd_renderer_close(*renderer);
        *renderer = NULL;
    }
    return status;
}

static int scaled(int side, double factor) {
    return (int)fmax(1.0, (double)side * factor + 0.5);
}

static HdStatus render(HdRenderer *renderer, const HdScene *scene, const HdCamera *camera,
                       int times, HdTrial *trial, HdError *error) {
    const HdFrameMaker maker = {.renderer = renderer, .scene = scene};
    HdFrame frame;
    HdStatus status = hd_frame_create(&frame, scene->width, scene->height, error);
    trial->seconds = trial->trace_seconds = (double)INFINITY;
    for (int i = 0; status == HD_OK && i < times; i++) {
        double start = hd_monotonic_seconds();
        status = hd_frame_render(&maker, camera, &frame, error);
        trial->seconds = fmin(trial->seconds, hd_monotonic_seconds() - start);
        trial->trace_seconds = fmin(trial->trace_seconds, frame.trace_seconds);
    }
    hd_frame_free(&frame);
    return status;
}

static HdStatus render_share(HdRenderer *renderer, const HdJob *job, double share, int times,
                             HdTrial *trial, HdError *error) {
    HdScene small = *job->scene; /* still owned by the original */
    HdCamera camera;
    small.width = scaled(job->scene->width, sqrt(share));
    small.height = scaled(job->scene->height, sqrt(share));
    *trial = (HdTrial){.width = small.width, .height = small.height, .share = share};
    HD_TRY(hd_camera_at(&camera, &small, job->first_frame, error));
    HD_TRY(render(renderer, &small, &camera, times, trial, error));
    trial->frame_seconds = trial->seconds * ((double)job->scene->width * job->scene->height) /
                           ((double)small.width * small.height);
    return HD_OK;
}

static double count_samples(const HdScene *scene) {
    return (double)hd_sample_count(scene) * scene->width * scene->height;
}

/* Starts with few samples, for thousands of lights make each one slow. */
HdStatus hd_trial(HdRenderer *renderer, const HdJob *job, const HdTrialRequest *selection,
                  HdTrial *trial, HdError *error) {
    const double first_samples = 4096.0;
    double share = selection->share > 0.0 ? selection->share
                                          : fmin(1.0, first_samples / count_samples(job->scene));
    for (;;) {
        HD_TRY(render_share(renderer, job, share, selection->times, trial, error));
        if (selection->share > 0.0 || share >= 1.0 || trial->seconds > selection->trusted ||
            trial->frame_seconds * job->frame_count <= selection->enough)
            return HD_OK;
        share = fmin(1.0, 4.0 * share);
    }
}

HdTrialRequest hd_trial_request(double enough) {
    return (HdTrialRequest){.trusted = 0.02, .enough = enough, .times = 1};
}

/* ---- results ---- */

enum { KEY_LENGTH = 1 << 14, RESULTS_LENGTH = 1 << 12 };

static int power_of_two(double number) {
    return number < 1.0 ? 0 : (int)ceil(log2(number));
}

static int count_planes(const HdScene *scene) {
    int planes = 0;
    for (int i = 0; i < scene->solid_count; i++) {
        HdPlatonic shape;
        hd_platonic(scene->solids[i].kind, &shape);
        planes += shape.face_count;
    }
    return planes;
}

/* Devices of one name and driver are equal, whatever their numbers. */
static void write_key(const HdTeamDevice *devices, int count, const HdRenderOptions *options,
                      const HdScene *scene, char key[KEY_LENGTH]) {
    snprintf(key, KEY_LENGTH,
             "hedron %s, kernels %016" PRIx64 "\n2^%d samples, 2^%d planes, 2^%d triangles in 2^%d "
             "places, %s floor, 2^%d lights, 2^%d endless ones, depth 2^%d\nprecision %d, math %d, "
             "pipeline %d, %d lanes, %d threads, block %d, grid %d%s, launches of %g ms\n",
             HD_VERSION, hd_hash_bytes(HD_HASH_START, hd_opencl_source, hd_opencl_source_size),
             power_of_two(count_samples(scene)), power_of_two(count_planes(scene)),
             power_of_two((double)hd_scene_triangle_count(scene)),
             power_of_two(scene->instance_count), scene->floor.present ? "a" : "no",
             power_of_two(hd_scene_light_count(scene)),
             power_of_two(hd_scene_endless_light_count(scene)), power_of_two(scene->depth),
             (int)options->precision, (int)options->math, (int)options->pipeline, options->lanes,
             options->threads, options->block, options->grid,
             options->has_deep_trees ? ", deep trees" : "", options->launch_ms);
    for (int i = 0; i < count; i++) {
        const HdDevice *device = &devices[i].device;
        hd_add_text(key, KEY_LENGTH, "", "%s %s (%s)\n", device->backend->name, device->name,
                    device->driver);
    }
}

/* Writes a line for each device. */
static void write_results(const HdTeamDevice *devices, int count, char text[RESULTS_LENGTH]) {
    text[0] = '\0';
    for (int i = 0; i < count; i++) {
        const HdRenderOptions *launch = &devices[i].options;
        hd_add_text(text, RESULTS_LENGTH, "",
                    "%.9f s: pipeline %d, lanes %d, block %d, grid %d, registers %d\n",
                    devices[i].seconds, (int)launch->pipeline, launch->lanes, launch->block,
                    launch->grid, launch->registers);
    }
}

static bool read_result(const char **line, HdTeamDevice *device) {
    HdRenderOptions *launch = &device->options;
    int pipeline, length = 0;
    if (sscanf(*line, "%lf s: pipeline %d, lanes %d, block %d, grid %d, registers %d\n%n",
               &device->seconds, &pipeline, &launch->lanes, &launch->block, &launch->grid,
               &launch->registers, &length) != 6)
        return false;
    launch->pipeline = (HdPipeline)pipeline;
    *line += length;
    return device->seconds >= 0.0;
}

HdStatus hd_measured_put(const HdTeamDevice *devices, int count, const HdRenderOptions *options,
                         const HdScene *scene, HdError *error) {
    char key[KEY_LENGTH], text[RESULTS_LENGTH];
    write_key(devices, count, options, scene, key);
    write_results(devices, count, text);
    return hd_cache_put_text("measured", key, text, error);
}

bool hd_measured_get(HdTeamDevice *devices, int count, const HdRenderOptions *options,
                     const HdScene *scene) {
    char key[KEY_LENGTH], text[RESULTS_LENGTH];
    const char *line = text;
    HdError ignored;
    write_key(devices, count, options, scene, key);
    if (hd_cache_get_text("measured", key, text, sizeof text, &ignored) != HD_OK)
        return false;
    for (int i = 0; i < count; i++) {
        devices[i].options = *options;
        if (!read_result(&line, &devices[i]))
            return false;
    }
    return true;
}

/* ---- devices ---- */

static bool agrees(int given, int chosen) {
    return given == 0 || given == chosen;
}

static bool makes_sense(const HdRenderOptions *chosen, const HdRenderOptions *given,
                        const HdDevice *device) {
    return agrees((int)given->pipeline, (int)chosen->pipeline) &&
           agrees(given->lanes, chosen->lanes) && agrees(given->block, chosen->block) &&
           agrees(given->grid, chosen->grid) && agrees(given->registers, chosen->registers) &&
           hd_render_options_are_possible(chosen) &&
           hd_device_unsupported_reason(device, chosen) == NULL;
}

HdStatus hd_team_device_open(HdTeamDevice *member, const HdRenderOptions *options, const HdJob *job,
                             bool gets_scene, HdError *error) {
    const HdDevice *device = &member->device;
    member->is_tuned = hd_measured_get(member, 1, options, job->scene) &&
                       makes_sense(&member->options, options, device);
    if (!member->is_tuned)
        member->options = *options;
    HdRenderOptions resolved = member->options;
    resolved.pipeline = hd_choose_pipeline(device, &resolved, job->scene);
    return gets_scene ? hd_trial_open(&member->renderer, device, &resolved, job, error)
                      : hd_renderer_open(&member->renderer, device, &resolved, error);
}

void hd_team_device_close(HdTeamDevice *member) {
    hd_renderer_close(member->renderer);
    member->renderer = NULL;
}

/* Ratio by which a candidate must beat the best time so far, so that noise does not decide. */
#define CLEARLY_FASTER 0.98

typedef struct Tuner {
    HdTuning *tuning;
    const HdDevice *device;
    const HdRenderOptions *options;
    const HdJob *job;
    HdTrialRequest how; /* request for all candidates; share 0: not known yet */
} Tuner;

/* ---- tuning: one candidate ---- */

/* Finds the share of the frame that takes a fifth of a second: four times as many pixels must not
   take much longer. Renders everything twice, as some drivers still compile in the first run. */
static HdStatus find_share(Tuner *tuner, HdRenderer *renderer, HdError *error) {
    const double picture_seconds = 0.2, all_seconds = 0.5;
    const int min_times = 2, max_times = 40;
    const HdTrialRequest selection = {.trusted = picture_seconds / 4.0, .times = 2};
    HdTrial trial;
    HD_TRY(hd_trial(renderer, tuner->job, &selection, &trial, error));
    tuner->how.share = trial.share;
    tuner->how.times = (int)fmax(min_times, fmin(max_times, all_seconds / trial.seconds));
    return HD_OK;
}

static HdStatus measure(Tuner *tuner, const HdRenderOptions *options, HdTrial *trial,
                        HdError *error) {
    HdRenderer *renderer;
    HD_TRY(hd_trial_open(&renderer, tuner->device, options, tuner->job, error));
    HdStatus status = tuner->how.share <= 0.0 ? find_share(tuner, renderer, error) : HD_OK;
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

/* ---- tuning: the best of those so far ---- */

static void find_best(HdTuning *tuning) {
    tuning->best = 0;
    for (int i = 1; i < tuning->count; i++) {
        const HdTuningCandidate *candidate = &tuning->candidates[i];
        if (candidate->failure[0] == '\0' &&
            candidate->seconds < CLEARLY_FASTER * tuning->candidates[tuning->best].seconds)
            tuning->best = i;
    }
}

/* Repeats the fastest ones, for other load on the machine may have slowed them down for a while. */
static HdStatus measure_again(Tuner *tuner, HdError *error) {
    const double near = 1.5;
    HdTuning *tuning = tuner->tuning;
    double limit = near * tuning->candidates[tuning->best].seconds;
    for (int i = 0; i < tuning->count; i++) {
        HdTuningCandidate *candidate = &tuning->candidates[i];
        HdTrial trial;
        if (candidate->failure[0] != '\0' || candidate->seconds > limit)
            continue;
        HD_TRY(measure(tuner, &candidate->options, &trial, error));
        candidate->seconds = fmin(candidate->seconds, trial.trace_seconds);
    }
    return HD_OK;
}

static HdStatus choose(Tuner *tuner, HdError *error) {
    const int rounds = 2;
    find_best(tuner->tuning);
    for (int i = 0; i < rounds; i++) {
        HD_TRY(measure_again(tuner, error));
        find_best(tuner->tuning);
    }
    return HD_OK;
}

/* ---- tuning: all of them ---- */

static HdRenderOptions best_so_far(const Tuner *tuner) {
    return tuner->tuning->candidates[tuner->tuning->best].options;
}

/* Tries the launch with each value of a member. */
static HdStatus try_each(Tuner *tuner, HdRenderOptions *options, int *member, const int *values,
                         int count, HdError *error) {
    for (int i = 0; i < count; i++) {
        *member = values[i];
        HD_TRY(try(tuner, options, error));
    }
    return HD_OK;
}

static HdStatus try_pipeline(Tuner *tuner, HdPipeline pipeline, HdError *error) {
    static const int limits[] = {64, 80, 96, 128, 168};
    HdRenderOptions options = *tuner->options;
    options.pipeline = pipeline;
    HD_TRY(try(tuner, &options, error));
    return tuner->device->nvidia_arch > 0 && tuner->options->registers == 0
               ? try_each(tuner, &options, &options.registers, limits, 5, error)
               : HD_OK;
}

static HdStatus try_pipelines(Tuner *tuner, HdError *error) {
    static const HdPipeline pipelines[] = {HD_PIPELINE_MEGA, HD_PIPELINE_WAVEFRONT};
    HdPipeline suits = hd_choose_pipeline(tuner->device, tuner->options, tuner->job->scene);
    HD_TRY(try_pipeline(tuner, suits, error));
    for (int i = 0; tuner->options->pipeline == HD_PIPELINE_AUTO && i < 2; i++) {
        bool is_too_long = pipelines[i] == HD_PIPELINE_MEGA &&
                           hd_megakernel_is_too_long(tuner->device, tuner->options);
        if (pipelines[i] != suits && !is_too_long)
            HD_TRY(try_pipeline(tuner, pipelines[i], error));
    }
    return HD_OK;
}

#define LISTED(number) number,

/* Tries all packets that the device supports except single rays. */
static HdStatus try_lanes(Tuner *tuner, HdError *error) {
    static const int lanes[] = {HD_LANE_COUNTS(LISTED)};
    int offered[sizeof lanes / sizeof *lanes], count = 0;
    const int mask = tuner->device->lanes[tuner->options->precision];
    for (size_t i = 1; i < sizeof lanes / sizeof *lanes; i++)
        if (mask == 0 || (mask & lanes[i]) != 0)
            offered[count++] = lanes[i];
    HdRenderOptions options = best_so_far(tuner);
    return tuner->options->lanes == 0
               ? try_each(tuner, &options, &options.lanes, offered, count, error)
               : HD_OK;
}

static HdStatus try_blocks(Tuner *tuner, HdError *error) {
    static const int blocks[] = {64, 128, 256};
    HdRenderOptions options = best_so_far(tuner);
    return tuner->options->block == 0 ? try_each(tuner, &options, &options.block, blocks, 3, error)
                                      : HD_OK;
}

/* Tries a few groups for each compute unit, which then process several items each. */
static HdStatus try_grids(Tuner *tuner, HdError *error) {
    static const int groups_per_unit[] = {8, 32};
    HdRenderOptions options = best_so_far(tuner);
    for (int i = 0; tuner->options->grid == 0 && i < 2; i++) {
        options.grid = groups_per_unit[i] * tuner->device->compute_units;
        if (options.grid > 0 && options.grid <= HD_MAX_GRID)
            HD_TRY(try(tuner, &options, error));
    }
    return HD_OK;
}

HdStatus hd_tune(HdTuning *tuning, const HdDevice *device, const HdRenderOptions *options,
                 const HdJob *job, HdError *error) {
    typedef HdStatus Stage(Tuner *, HdError *);
    Stage *const of_cpus[] = {try_pipelines, try_lanes, NULL};
    Stage *const of_gpus[] = {try_pipelines, try_blocks, try_grids, NULL};
    bool has_groups = !device->is_cpu || options->test.groups;
    Tuner tuner = {.tuning = tuning, .device = device, .options = options, .job = job};
    tuning->count = tuning->best = 0;
    for (Stage *const *stage = has_groups ? of_gpus : of_cpus; *stage != NULL; stage++) {
        HD_TRY((*stage)(&tuner, error));
        HD_TRY(choose(&tuner, error));
    }
    return HD_OK;
}

HdStatus hd_tuning_remember(const HdTuning *tuning, const HdDevice *device,
                            const HdRenderOptions *options, const HdScene *scene, HdError *error) {
    const HdTuningCandidate *best = &tuning->candidates[tuning->best];
    const HdTeamDevice measured = {
        .device = *device, .options = best->options, .seconds = best->seconds};
    return hd_measured_put(&measured, 1, options, scene, error);
}
