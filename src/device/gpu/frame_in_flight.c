/* SPDX-License-Identifier: MIT */
#include "device/gpu/gpu.h"

#include <math.h>
#include <string.h>

#include "kernels/host/shared.h"
#include "system/machine.h"

_Static_assert(sizeof(HdRayCounts) == sizeof(RayCounts), "the counts are copied as they are");

static const size_t SUM_BYTES = sizeof(HdRayCounts) * HD_SUM_WORKERS;

static void close_frame(HdGpuFrameInFlight *in_flight, const HdGpu *gpu) {
    enum { EVENTS = 5 };
    HdGpuEvent *const events[EVENTS] = {&in_flight->first, &in_flight->later, &in_flight->summed,
                                        &in_flight->encoded, &in_flight->copied};
    hd_gpu_release(gpu, &in_flight->pixels);
    hd_gpu_release(gpu, &in_flight->sums);
    hd_gpu_release(gpu, &in_flight->image);
    hd_gpu_release(gpu, &in_flight->tables);
    hd_gpu_release(gpu, &in_flight->copy);
    for (int i = 0; i < EVENTS; i++)
        gpu->driver->forget(gpu->handle, events[i]);
}

void hd_gpu_frames_in_flight_close(HdGpuRenderer *renderer) {
    for (int i = 0; i < HD_FRAMES_IN_FLIGHT; i++)
        close_frame(&renderer->frames_in_flight.list[i], &renderer->gpu);
}

static size_t pixel_count(const HdGpuFrameInFlight *in_flight) {
    return (size_t)in_flight->of->width * (size_t)in_flight->of->height;
}

/* Bytes that are copied to the host. */
static size_t picture_bytes(const HdGpuFrameInFlight *in_flight) {
    return pixel_count(in_flight) *
           (in_flight->encodes ? 4 : (size_t)in_flight->of->floats * sizeof(float));
}

static HdStatus reserve(HdGpuFrameInFlight *in_flight, const HdGpu *gpu, HdError *error) {
    size_t pixels = pixel_count(in_flight), tables = 0;
    size_t bytes = sizeof(float) * (size_t)in_flight->of->floats * pixels;
    for (int i = 0; i < in_flight->of->table_count; i++)
        tables += in_flight->of->table[i].bytes;
    const struct {
        HdGpuMemory *memory;
        HdGpuPlace place;
        size_t bytes;
        const char *what;
    } list[] = {
        {&in_flight->pixels, HD_GPU_DEVICE, bytes, "pixels"},
        {&in_flight->sums, HD_GPU_DEVICE, SUM_BYTES, "sums of the counts"},
        {&in_flight->tables, HD_GPU_HOST, tables, "tables of the frame"},
        {&in_flight->copy, HD_GPU_HOST, SUM_BYTES + picture_bytes(in_flight),
         "pixels on their way to the host"},
        {&in_flight->image, HD_GPU_DEVICE, 4 * pixels, "encoded pixels"},
    };
    int count = in_flight->encodes ? 5 : 4;
    for (int i = 0; i < count; i++)
        HD_TRY(
            hd_gpu_reserve(gpu, list[i].memory, list[i].place, list[i].bytes, list[i].what, error));
    return HD_OK;
}

HdStatus hd_gpu_frame_begin(HdGpuRenderer *renderer, const HdFrameTables *tables, int items,
                            bool encodes, HdGpuFrameInFlight **out, HdError *error) {
    HdGpuFramesInFlight *frames_in_flight = &renderer->frames_in_flight;
    HdGpuFrameInFlight *in_flight =
        &frames_in_flight
             ->list[(frames_in_flight->oldest + frames_in_flight->count) % HD_FRAMES_IN_FLIGHT];
    in_flight->encodes = encodes;
    in_flight->of = tables;
    in_flight->items = items;
    in_flight->reported = 0;
    in_flight->submitted = hd_monotonic_seconds();
    in_flight->launches = 0;
    in_flight->untimed = NULL;
    in_flight->longest_launch = -1.0;
    in_flight->is_alone = frames_in_flight->count == 0;
    *out = in_flight;
    return reserve(in_flight, &renderer->gpu, error);
}

HdStatus hd_gpu_frame_launch(const HdGpuRenderer *renderer, HdGpuFrameInFlight *in_flight,
                             const HdGpuLaunch *launch, double work, HdError *error) {
    const HdGpu *gpu = &renderer->gpu;
    in_flight->untimed = in_flight->launches++ == 0 ? &in_flight->first : &in_flight->later;
    in_flight->work = work;
    in_flight->launched = hd_monotonic_seconds();
    return gpu->driver->launch(gpu->handle, launch, in_flight->untimed, error);
}

/* Bounds the time by the host's clock: at most since it was queued, at least what the host waited
   for it alone. Returns a bound that shows if the launch was too long, otherwise -1. */
static double launch_by_host(const HdGpuFramesInFlight *frames_in_flight,
                             const HdGpuFrameInFlight *in_flight, double waited) {
    double now = hd_monotonic_seconds(), most = now - in_flight->launched;
    double least = in_flight->is_alone ? now - waited : 0.0;
    if (most <= frames_in_flight->size.longest)
        return most;
    return least > frames_in_flight->size.longest ? least : -1.0;
}

HdStatus hd_gpu_frame_time_launch(HdGpuRenderer *renderer, HdGpuFrameInFlight *in_flight,
                                  double waited, HdError *error) {
    const HdGpu *gpu = &renderer->gpu;
    HdGpuFramesInFlight *frames_in_flight = &renderer->frames_in_flight;
    double seconds;
    HdStatus status =
        gpu->driver->seconds(gpu->handle, in_flight->untimed, in_flight->untimed, &seconds, error);
    if (status == HD_OK && seconds < 0.0)
        seconds = launch_by_host(frames_in_flight, in_flight, waited);
    in_flight->untimed = NULL;
    in_flight->is_alone = true;
    if (status != HD_OK || seconds < 0.0)
        return status;
    hd_launch_size_note(&frames_in_flight->size, in_flight->work, seconds);
    in_flight->longest_launch = fmax(seconds, in_flight->longest_launch);
    return HD_OK;
}

void hd_gpu_frame_report(HdGpuFrameInFlight *in_flight, int end) {
    hd_watched_add(&in_flight->of->watched, in_flight->reported, end, in_flight->items);
    in_flight->reported = end;
}

HdStatus hd_gpu_frame_send(HdGpuRenderer *renderer, HdGpuFrameInFlight *in_flight, HdError *error) {
    const HdGpu *gpu = &renderer->gpu;
    char *to = in_flight->copy.data;
    const HdGpuCopy copies[] = {
        {&in_flight->sums, to, SUM_BYTES},
        {in_flight->encodes ? &in_flight->image : &in_flight->pixels, to + SUM_BYTES,
         picture_bytes(in_flight)},
    };
    const HdGpuEvent *ready = in_flight->encodes ? &in_flight->encoded : &in_flight->summed;
    HdStatus status =
        gpu->driver->copy_back(gpu->handle, ready, copies, 2, &in_flight->copied, error);
    if (status == HD_OK)
        renderer->frames_in_flight.count++;
    return status;
}

static HdStatus fill(HdGpuRenderer *renderer, HdGpuFrameInFlight *in_flight, HdFrame *frame,
                     HdError *error) {
    const HdGpu *gpu = &renderer->gpu;
    double seconds, waited = hd_monotonic_seconds();
    in_flight->is_alone = true;
    HD_TRY(gpu->driver->wait_for_copies(gpu->handle, &in_flight->copied, error));
    HD_TRY(
        gpu->driver->seconds(gpu->handle, &in_flight->first, &in_flight->summed, &seconds, error));
    if (in_flight->untimed != NULL)
        HD_TRY(hd_gpu_frame_time_launch(renderer, in_flight, waited, error));
    hd_gpu_frame_report(in_flight, in_flight->items);
    frame->longest_launch = in_flight->longest_launch;
    /* Without the device's times, the host's count: frames are traced one after the other. */
    if (seconds < 0.0)
        seconds = hd_monotonic_seconds() -
                  fmax(in_flight->submitted, renderer->frames_in_flight.collected);
    frame->trace_seconds = seconds;
    frame->is_encoded = in_flight->encodes;
    memcpy(in_flight->encodes ? (void *)frame->rgba : (void *)frame->rgb,
           (const char *)in_flight->copy.data + SUM_BYTES, picture_bytes(in_flight));
    hd_frame_set_counts(frame, in_flight->of->samples, in_flight->copy.data, HD_SUM_WORKERS);
    return HD_OK;
}

HdStatus hd_gpu_frame_collect(HdGpuRenderer *renderer, HdFrame *frame, HdError *error) {
    HdGpuFramesInFlight *frames_in_flight = &renderer->frames_in_flight;
    HdStatus status =
        fill(renderer, &frames_in_flight->list[frames_in_flight->oldest], frame, error);
    frames_in_flight->collected = hd_monotonic_seconds();
    frames_in_flight->oldest = (frames_in_flight->oldest + 1) % HD_FRAMES_IN_FLIGHT;
    frames_in_flight->count--;
    return status;
}
