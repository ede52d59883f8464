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
    size_t room = (size_t)capacity;
    snprintf(text, room, "%s",
             options->pipeline != HD_PIPELINE_AUTO ? hd_pipeline_names[options->pipeline] : "");
    for (int i = 0; i < 4; i++)
        if (parts[i].value > 0)
            hd_add_text(text, room, ", ", parts[i].form, parts[i].value);
    if (text[0] == '\0')
        snprintf(text, room, "as it suits the device");
}

/* ---- trials ---- */

HdStatus hd_trial_open(HdRenderer **renderer, const HdDevice *device,
                       const HdRenderOptions *options, const HdJob *job, HdError *error) {
    HdStatus status = hd_renderer_open(renderer, device, options, error);
    if (status != HD_OK)
        return status;
    status = hd_put_scene(*renderer, job->scene, NULL, error);
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
    HdScene small = *job->scene; /* what it owns stays with the other */
    HdCamera camera;
    small.width = scaled(job->scene->width, sqrt(share));
    small.height = scaled(job->scene->height, sqrt(share));
    *trial = (HdTrial){.width = small.width, .height = small.height, .share = share};
    HdStatus status = hd_camera_at(&camera, &small, job->first_frame, error);
    if (status == HD_OK)
        status = render(renderer, &small, &camera, times, trial, error);
    trial->frame_seconds = trial->seconds * ((double)job->scene->width * job->scene->height) /
                           ((double)small.width * small.height);
    return status;
}

static double count_samples(const HdScene *scene) {
    return (double)scene->samples_per_side * scene->samples_per_side * scene->width * scene->height;
}

/* Few samples come first, for thousands of lights make each one slow. */
HdStatus hd_trial(HdRenderer *renderer, const HdJob *job, const HdTrialWish *wish, HdTrial *trial,
                  HdError *error) {
    const double first_samples = 4096.0;
    double share =
        wish->share > 0.0 ? wish->share : fmin(1.0, first_samples / count_samples(job->scene));
    for (;;) {
        HdStatus status = render_share(renderer, job, share, wish->times, trial, error);
        if (status != HD_OK || wish->share > 0.0 || share >= 1.0 ||
            trial->seconds > wish->believed ||
            trial->frame_seconds * job->frame_count <= wish->enough)
            return status;
        share = fmin(1.0, 4.0 * share);
    }
}

HdTrialWish hd_trial_estimates(double enough) {
    return (HdTrialWish){.believed = 0.02, .enough = enough, .times = 1};
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

/* Devices of one name and driver are alike, whatever their numbers. */
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

/* A line for each device. */
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

static bool keeps(int given, int chosen) {
    return given == 0 || given == chosen;
}

static bool makes_sense(const HdRenderOptions *chosen, const HdRenderOptions *given,
                        const HdDevice *device) {
    return keeps((int)given->pipeline, (int)chosen->pipeline) &&
           keeps(given->lanes, chosen->lanes) && keeps(given->block, chosen->block) &&
           keeps(given->grid, chosen->grid) && keeps(given->registers, chosen->registers) &&
           hd_render_options_are_possible(chosen) && hd_device_obstacle(device, chosen) == NULL;
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
