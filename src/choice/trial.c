/* SPDX-License-Identifier: MIT */
#include "choice/trial.h"

#include <math.h>

#include "render/backends.h"
#include "render/frame.h"
#include "system/machine.h"
#include "verify/trust.h"

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
    int shorter = (int)((double)side * factor + 0.5);
    return shorter < 1 ? 1 : shorter;
}

static HdStatus render(HdRenderer *renderer, const HdScene *scene, const HdCamera *camera,
                       int times, HdTrialTime *time, HdError *error) {
    const HdFrameMaker maker = {.renderer = renderer, .scene = scene};
    HdFrame frame;
    HdStatus status = hd_frame_create(&frame, scene->width, scene->height, error);
    for (int i = 0; status == HD_OK && i < times; i++) {
        double start = hd_monotonic_seconds();
        status = hd_frame_render(&maker, camera, &frame, error);
        double taken = hd_monotonic_seconds() - start;
        time->seconds = i == 0 ? taken : fmin(time->seconds, taken);
        time->trace_seconds =
            i == 0 ? frame.trace_seconds : fmin(time->trace_seconds, frame.trace_seconds);
    }
    hd_frame_free(&frame);
    return status;
}

HdStatus hd_trial_measure(HdRenderer *renderer, const HdJob *job, double share, int times,
                          HdTrialTime *time, HdError *error) {
    HdScene small = *job->scene; /* what it owns stays with the other */
    HdCamera camera;
    small.width = scaled(job->scene->width, sqrt(share));
    small.height = scaled(job->scene->height, sqrt(share));
    *time = (HdTrialTime){
        .width = small.width,
        .height = small.height,
        .share = (double)small.width * small.height /
                 ((double)job->scene->width * (double)job->scene->height),
    };
    HdStatus status = hd_camera_at(&camera, &small, job->first_frame, error);
    return status == HD_OK ? render(renderer, &small, &camera, times, time, error) : status;
}

/* Starts with few samples, for thousands of lights make each one slow, and takes more until the
   time can be believed. */
HdStatus hd_trial_estimate_on(HdRenderer *renderer, const HdJob *job, double enough,
                              double *frame_seconds, HdError *error) {
    const double first_samples = 4096.0, believed_seconds = 0.02;
    const HdScene *scene = job->scene;
    double samples =
        (double)scene->width * scene->height * scene->samples_per_side * scene->samples_per_side;
    double share = fmin(1.0, first_samples / samples);
    for (;;) {
        HdTrialTime time;
        HdStatus status = hd_trial_measure(renderer, job, share, 1, &time, error);
        if (status != HD_OK)
            return status;
        *frame_seconds = time.seconds / time.share;
        if (share >= 1.0 || time.seconds > believed_seconds ||
            *frame_seconds * job->frame_count <= enough)
            return HD_OK;
        share = fmin(1.0, 4.0 * share);
    }
}

HdStatus hd_trial_estimate(const HdRenderOptions *options, const HdJob *job, double enough,
                           double *frame_seconds, HdError *error) {
    HdDevice device;
    HdRenderer *renderer;
    int count;
    /* A texture takes longer to upload than a small picture to render, and little of its time. */
    HdScene plain = *job->scene;
    HdJob plain_job = *job;
    plain.floor.texture = (HdTexture){0};
    plain_job.scene = &plain;
    HdStatus status = hd_backend_enumerate(hd_backend_always_there(), &device, 1, &count, error);
    if (status == HD_OK)
        status = hd_trial_open(&renderer, &device, options, &plain_job, error);
    if (status != HD_OK)
        return status;
    status = hd_trial_estimate_on(renderer, &plain_job, enough, frame_seconds, error);
    hd_renderer_close(renderer);
    return status;
}
