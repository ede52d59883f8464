/* SPDX-License-Identifier: MIT */
#include "device/backend.h"

#include <stdio.h>
#include <string.h>

#include "device/kernel_cache.h"
#include "device/launch_plan.h"

HdStatus hd_backend_enumerate(const HdBackend *backend, HdDevice *devices, int capacity, int *count,
                              HdError *error) {
    HdStatus status = backend->enumerate(devices, capacity, count, error);
    for (HdDevice *device = devices; device < devices + *count; device++) {
        HdArithmetic known = {.difference = ""};
        device->backend = backend;
        device->is_measured =
            backend->needs_no_driver ||
            hd_arithmetic_recall(device->name, device->driver, HD_PRECISION_FLOAT, &known);
        if (known.difference[0] != '\0')
            snprintf(device->not_strict, sizeof device->not_strict, "it computes wrongly: %s",
                     known.difference);
    }
    return status;
}

const char *const hd_pipeline_names[HD_PIPELINE_COUNT + 1] = {"auto", "mega", "wavefront",
                                                              "wavefront-uncompacted", NULL};

bool hd_pipeline_is_wavefront(HdPipeline pipeline) {
    return pipeline == HD_PIPELINE_WAVEFRONT || pipeline == HD_PIPELINE_WAVEFRONT_UNCOMPACTED;
}

static bool is_within(double number, double min, double max) {
    return number == 0.0 || (number >= min && number <= max);
}

bool hd_render_options_are_possible(const HdRenderOptions *options) {
#define IS(number) || options->lanes == (number)
    return (options->lanes == 0 HD_LANE_COUNTS(IS)) &&
           is_within(options->threads, 1, HD_MAX_THREADS) &&
           is_within(options->block, HD_BLOCK_STEP, HD_MAX_BLOCK) &&
           options->block % HD_BLOCK_STEP == 0 && is_within(options->grid, 1, HD_MAX_GRID) &&
           is_within(options->registers, HD_MIN_REGISTERS, HD_MAX_REGISTERS) &&
           is_within(options->launch_ms, HD_MIN_LAUNCH_MS, HD_MAX_LAUNCH_MS) &&
           options->pipeline < HD_PIPELINE_COUNT;
}

static const char *list_lanes(int offered) {
    static const struct {
        int offered;
        const char *text;
    } lists[] = {
        {1, "the processor has registers for 1 lane in this precision"},
        {1 | 4, "the processor has registers for 1 or 4 lanes in this precision"},
        {1 | 2 | 4, "the processor has registers for 1, 2 or 4 lanes in this precision"},
        {1 | 4 | 8, "the processor has registers for 1, 4 or 8 lanes in this precision"},
        {1 | 4 | 8 | 16, "the processor has registers for 1, 4, 8 or 16 lanes in this precision"},
    };
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++)
        if (lists[i].offered == offered)
            return lists[i].text;
    return "the processor has no kernels with that number of lanes in this precision";
}

const char *hd_device_unsupported_reason(const HdDevice *device, const HdRenderOptions *options) {
    if (device->unusable[0] != '\0')
        return device->unusable;
    if (options->math == HD_MATH_STRICT && device->not_strict[0] != '\0')
        return device->not_strict;
    if (options->precision == HD_PRECISION_DOUBLE && !device->has_double)
        return "the device has no double precision; --precision float would work";
    bool has_groups = !device->is_cpu || options->test.groups;
    if (options->lanes > 1 && has_groups)
        return "several lanes need a CPU";
    const int offered = device->lanes[options->precision];
    if (options->lanes > 0 && offered > 0 && (options->lanes & offered) == 0)
        return list_lanes(offered);
    if (has_groups && !device->has_wide_atomics &&
        hd_pipeline_is_wavefront(hd_choose_pipeline(device, options, NULL)))
        return "the wavefront pipeline needs 64-bit integer atomics, which the device lacks; "
               "--pipeline mega would work";
    return NULL;
}

/* Number of lights without a distance limit from which on full packets outweigh a queue. */
enum { MANY_LIGHTS = 100 };

double hd_longest_launch(const HdDevice *device, const HdRenderOptions *options) {
    if (options->launch_ms > 0.0)
        return 1e-3 * options->launch_ms;
    return device->has_timeout ? HD_LAUNCH_SECONDS : HD_LAUNCH_SECONDS_FREE;
}

bool hd_megakernel_is_too_long(const HdDevice *device, const HdRenderOptions *options) {
    return options->has_deep_trees && !device->is_cpu &&
           hd_longest_launch(device, options) < HD_LAUNCH_SECONDS_FREE;
}

HdPipeline hd_choose_pipeline(const HdDevice *device, const HdRenderOptions *options,
                              const HdScene *scene) {
    if (options->pipeline != HD_PIPELINE_AUTO)
        return options->pipeline;
    bool has_many = scene != NULL && hd_scene_endless_light_count(scene) >= MANY_LIGHTS;
    bool is_wavefront =
        device->is_cpu ? has_many
                       : hd_megakernel_is_too_long(device, options) && device->has_wide_atomics;
    return is_wavefront ? HD_PIPELINE_WAVEFRONT : HD_PIPELINE_MEGA;
}

static const char lost_message[] =
    "the device is lost to this program (reset, stopped by the system after too long a kernel, "
    "broken or removed); the system's log may say why, and --device and --backend choose another";

HdStatus hd_fail_lost(HdError *error, const char *what) {
    return hd_fail(error, HD_UNAVAILABLE, "%s: %s", what, lost_message);
}

bool hd_is_loss(const HdError *error) {
    return error->status == HD_UNAVAILABLE && strstr(error->message, lost_message) != NULL;
}
