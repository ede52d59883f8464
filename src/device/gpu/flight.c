/* SPDX-License-Identifier: MIT */
#include "device/gpu/gpu.h"

#include <math.h>
#include <string.h>

#include "kernels/host/shared.h"
#include "system/machine.h"

_Static_assert(sizeof(HdRayCounts) == sizeof(RayCounts), "the counts are copied as they are");

static const size_t SUM_BYTES = sizeof(HdRayCounts) * HD_SUM_WORKERS;

static void close_flight(HdGpuFlight *flight, const HdGpu *gpu) {
    enum { MARKS = 5 };
    HdGpuMark *const marks[MARKS] = {&flight->first, &flight->later, &flight->summed,
                                     &flight->encoded, &flight->copied};
    hd_gpu_release(gpu, &flight->pixels);
    hd_gpu_release(gpu, &flight->sums);
    hd_gpu_release(gpu, &flight->image);
    hd_gpu_release(gpu, &flight->tables);
    hd_gpu_release(gpu, &flight->copy);
    for (int i = 0; i < MARKS; i++)
        gpu->driver->forget(gpu->handle, marks[i]);
}

void hd_gpu_flights_close(HdGpuRenderer *renderer) {
    for (int i = 0; i < HD_FRAMES_IN_FLIGHT; i++)
        close_flight(&renderer->flights.flights[i], &renderer->gpu);
}

static size_t pixel_count(const HdGpuFlight *flight) {
    return (size_t)flight->of->width * (size_t)flight->of->height;
}

/* Of what is copied. */
static size_t picture_bytes(const HdGpuFlight *flight) {
    return pixel_count(flight) * (flight->encodes ? 4 : (size_t)flight->of->floats * sizeof(float));
}

static HdStatus reserve(HdGpuFlight *flight, const HdGpu *gpu, HdError *error) {
    size_t pixels = pixel_count(flight), tables = 0;
    size_t bytes = sizeof(float) * (size_t)flight->of->floats * pixels;
    for (int i = 0; i < flight->of->table_count; i++)
        tables += flight->of->table[i].bytes;
    const struct {
        HdGpuMemory *memory;
        HdGpuPlace place;
        size_t bytes;
        const char *what;
    } list[] = {
        {&flight->pixels, HD_GPU_DEVICE, bytes, "pixels"},
        {&flight->sums, HD_GPU_DEVICE, SUM_BYTES, "sums of the counts"},
        {&flight->tables, HD_GPU_HOST, tables, "tables of the frame"},
        {&flight->copy, HD_GPU_HOST, SUM_BYTES + picture_bytes(flight),
         "pixels on their way to the host"},
        {&flight->image, HD_GPU_DEVICE, 4 * pixels, "encoded pixels"},
    };
    int count = flight->encodes ? 5 : 4;
    for (int i = 0; i < count; i++)
        HD_TRY(
            hd_gpu_reserve(gpu, list[i].memory, list[i].place, list[i].bytes, list[i].what, error));
    return HD_OK;
}

HdStatus hd_gpu_flight_begin(HdGpuRenderer *renderer, const HdFrameTables *tables, int items,
                             bool encodes, HdGpuFlight **out, HdError *error) {
    HdGpuFlights *flights = &renderer->flights;
    HdGpuFlight *flight =
        &flights->flights[(flights->oldest + flights->count) % HD_FRAMES_IN_FLIGHT];
    flight->encodes = encodes;
    flight->of = tables;
    flight->items = items;
    flight->told = 0;
    flight->submitted = hd_monotonic_seconds();
    flight->launches = 0;
    flight->untimed = NULL;
    flight->longest_launch = -1.0;
    flight->is_alone = flights->count == 0;
    *out = flight;
    return reserve(flight, &renderer->gpu, error);
}

HdStatus hd_gpu_flight_launch(const HdGpuRenderer *renderer, HdGpuFlight *flight,
                              const HdGpuLaunch *launch, double work, HdError *error) {
    const HdGpu *gpu = &renderer->gpu;
    flight->untimed = flight->launches++ == 0 ? &flight->first : &flight->later;
    flight->work = work;
    flight->launched = hd_monotonic_seconds();
    return gpu->driver->launch(gpu->handle, launch, flight->untimed, error);
}

/* The launch took at most what passed since it was queued, and at least what the host waited for it
   alone. So one that was short enough is known, and one that was too long; otherwise negative. */
static double launch_by_host(const HdGpuFlights *flights, const HdGpuFlight *flight,
                             double waited) {
    double now = hd_monotonic_seconds(), most = now - flight->launched;
    double least = flight->is_alone ? now - waited : 0.0;
    if (most <= flights->size.longest)
        return most;
    return least > flights->size.longest ? least : -1.0;
}

HdStatus hd_gpu_flight_time_launch(HdGpuRenderer *renderer, HdGpuFlight *flight, double waited,
                                   HdError *error) {
    const HdGpu *gpu = &renderer->gpu;
    HdGpuFlights *flights = &renderer->flights;
    double seconds;
    HdStatus status =
        gpu->driver->seconds(gpu->handle, flight->untimed, flight->untimed, &seconds, error);
    if (status == HD_OK && seconds < 0.0)
        seconds = launch_by_host(flights, flight, waited);
    flight->untimed = NULL;
    flight->is_alone = true;
    if (status != HD_OK || seconds < 0.0)
        return status;
    hd_launch_size_note(&flights->size, flight->work, seconds);
    flight->longest_launch = fmax(seconds, flight->longest_launch);
    return HD_OK;
}

void hd_gpu_flight_tell(HdGpuFlight *flight, int end) {
    hd_watched_add(&flight->of->watched, flight->told, end, flight->items);
    flight->told = end;
}

HdStatus hd_gpu_flight_send(HdGpuRenderer *renderer, HdGpuFlight *flight, HdError *error) {
    const HdGpu *gpu = &renderer->gpu;
    char *to = flight->copy.data;
    const HdGpuCopy copies[] = {
        {&flight->sums, to, SUM_BYTES},
        {flight->encodes ? &flight->image : &flight->pixels, to + SUM_BYTES, picture_bytes(flight)},
    };
    const HdGpuMark *ready = flight->encodes ? &flight->encoded : &flight->summed;
    HdStatus status = gpu->driver->copy_back(gpu->handle, ready, copies, 2, &flight->copied, error);
    if (status == HD_OK)
        renderer->flights.count++;
    return status;
}

static HdStatus fill(HdGpuRenderer *renderer, HdGpuFlight *flight, HdFrame *frame, HdError *error) {
    const HdGpu *gpu = &renderer->gpu;
    double seconds, waited = hd_monotonic_seconds();
    flight->is_alone = true;
    HD_TRY(gpu->driver->wait_for_copies(gpu->handle, &flight->copied, error));
    HD_TRY(gpu->driver->seconds(gpu->handle, &flight->first, &flight->summed, &seconds, error));
    if (flight->untimed != NULL)
        HD_TRY(hd_gpu_flight_time_launch(renderer, flight, waited, error));
    hd_gpu_flight_tell(flight, flight->items);
    frame->longest_launch = flight->longest_launch;
    /* Where the device does not tell, what the host sees: frames are traced one after the other. */
    if (seconds < 0.0)
        seconds = hd_monotonic_seconds() - fmax(flight->submitted, renderer->flights.collected);
    frame->trace_seconds = seconds;
    frame->is_encoded = flight->encodes;
    memcpy(flight->encodes ? (void *)frame->rgba : (void *)frame->rgb,
           (const char *)flight->copy.data + SUM_BYTES, picture_bytes(flight));
    hd_frame_set_counts(frame, flight->of->samples, flight->copy.data, HD_SUM_WORKERS);
    return HD_OK;
}

HdStatus hd_gpu_flight_collect(HdGpuRenderer *renderer, HdFrame *frame, HdError *error) {
    HdGpuFlights *flights = &renderer->flights;
    HdStatus status = fill(renderer, &flights->flights[flights->oldest], frame, error);
    flights->collected = hd_monotonic_seconds();
    flights->oldest = (flights->oldest + 1) % HD_FRAMES_IN_FLIGHT;
    flights->count--;
    return status;
}
