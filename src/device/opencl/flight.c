/* SPDX-License-Identifier: MIT */
#include "device/opencl/flight.h"

#include <string.h>

#include "device/device_launch.h"
#include "system/machine.h"

static const size_t SUM_BYTES = sizeof(HdRayCounts) * HD_SUM_WORKERS;

HdStatus hd_opencl_flights_open(HdOpenclFlights *flights, const HdOpenclOwner *owner,
                                HdError *error) {
    cl_int code;
    *flights = (HdOpenclFlights){.owner = *owner};
    flights->queue = clCreateCommandQueue(owner->context, owner->device->id, 0, &code);
    return flights->queue ? HD_OK : hd_opencl_fail(error, "clCreateCommandQueue", code);
}

void hd_opencl_flights_close(HdOpenclFlights *flights) {
    for (int i = 0; i < HD_FRAMES_IN_FLIGHT; i++) {
        HdOpenclFlight *flight = &flights->flights[i];
        hd_opencl_release(&flight->pixels);
        hd_opencl_release(&flight->sums);
        hd_opencl_release(&flight->image);
        hd_opencl_release_host(&flight->copy, flights->queue);
    }
    if (flights->queue)
        clReleaseCommandQueue(flights->queue);
    flights->queue = NULL;
}

static size_t pixel_count(const HdOpenclFlight *flight) {
    return (size_t)flight->width * (size_t)flight->height;
}

/* Of what is copied. */
static size_t picture_bytes(const HdOpenclFlight *flight) {
    return pixel_count(flight) * (flight->encodes ? 4 : (size_t)flight->floats * sizeof(float));
}

HdStatus hd_opencl_flight_begin(HdOpenclFlights *flights, const HdFrameTables *tables, bool encodes,
                                HdOpenclFlight **out, HdError *error) {
    HdOpenclFlight *flight =
        &flights->flights[(flights->oldest + flights->count) % HD_FRAMES_IN_FLIGHT];
    const HdOpenclOwner *owner = &flights->owner;
    flight->encodes = encodes;
    flight->width = tables->width;
    flight->height = tables->height;
    flight->samples = tables->samples;
    flight->floats = tables->floats;
    flight->longest_launch = -1.0;
    flight->submitted = hd_monotonic_seconds();
    *out = flight;
    HdStatus status = hd_opencl_reserve(
        owner, &flight->pixels, sizeof(float) * (size_t)flight->floats * pixel_count(flight),
        CL_MEM_READ_WRITE, "pixels", error);
    if (status == HD_OK)
        status = hd_opencl_reserve(owner, &flight->sums, SUM_BYTES, CL_MEM_READ_WRITE,
                                   "sums of the counts", error);
    if (status == HD_OK && encodes)
        status = hd_opencl_reserve(owner, &flight->image, 4 * pixel_count(flight),
                                   CL_MEM_READ_WRITE, "encoded pixels", error);
    if (status == HD_OK)
        status = hd_opencl_reserve_host(owner, &flight->copy, SUM_BYTES + picture_bytes(flight),
                                        flights->queue, error);
    return status;
}

static void release_event(cl_event *event) {
    if (*event)
        clReleaseEvent(*event);
    *event = NULL;
}

void hd_opencl_flight_cancel(HdOpenclFlight *flight) {
    release_event(&flight->first);
    release_event(&flight->last);
    release_event(&flight->launch);
    release_event(&flight->ready);
    release_event(&flight->copied);
}

static HdStatus read(HdOpenclFlights *flights, HdOpenclFlight *flight, const HdOpenclBuffer *from,
                     size_t bytes, size_t offset, cl_event *done, HdError *error) {
    cl_int code = clEnqueueReadBuffer(flights->queue, from->memory, CL_FALSE, 0, bytes,
                                      (char *)flight->copy.data + offset, 1, &flight->ready, done);
    return code == CL_SUCCESS ? HD_OK : hd_opencl_fail(error, "clEnqueueReadBuffer", code);
}

HdStatus hd_opencl_flight_send(HdOpenclFlights *flights, HdOpenclFlight *flight, HdError *error) {
    const HdOpenclBuffer *picture = flight->encodes ? &flight->image : &flight->pixels;
    HdStatus status = read(flights, flight, &flight->sums, SUM_BYTES, 0, NULL, error);
    if (status == HD_OK)
        status = read(flights, flight, picture, picture_bytes(flight), SUM_BYTES, &flight->copied,
                      error);
    cl_int code = clFlush(flights->queue);
    if (status == HD_OK && code != CL_SUCCESS)
        status = hd_opencl_fail(error, "clFlush", code);
    if (status == HD_OK)
        flights->count++;
    else
        clFinish(flights->queue);
    return status;
}

/* From the start of the first to the end of the last; 0 without a profile. */
static double profiled_seconds(cl_event first, cl_event last) {
    cl_ulong start = 0, end = 0;
    bool has_start = clGetEventProfilingInfo(first, CL_PROFILING_COMMAND_START, sizeof start,
                                             &start, NULL) == CL_SUCCESS;
    bool has_end = clGetEventProfilingInfo(last, CL_PROFILING_COMMAND_END, sizeof end, &end,
                                           NULL) == CL_SUCCESS;
    return has_start && has_end && end > start ? 1e-9 * (double)(end - start) : 0.0;
}

void hd_opencl_flight_time_launch(HdOpenclFlights *flights, HdOpenclFlight *flight) {
    double seconds = profiled_seconds(flight->launch, flight->launch);
    release_event(&flight->launch);
    if (!(seconds > 0.0))
        return;
    hd_launch_size_note(&flights->size, flight->work, seconds);
    if (seconds > flight->longest_launch)
        flight->longest_launch = seconds;
}

/* Without a profile what the host sees: frames are traced one after the other. */
static double trace_seconds(const HdOpenclFlights *flights, const HdOpenclFlight *flight) {
    double seconds = profiled_seconds(flight->first, flight->last);
    if (seconds > 0.0)
        return seconds;
    double from = flight->submitted > flights->collected ? flight->submitted : flights->collected;
    return hd_monotonic_seconds() - from;
}

HdStatus hd_opencl_flight_collect(HdOpenclFlights *flights, HdFrame *frame, HdError *error) {
    HdOpenclFlight *flight = &flights->flights[flights->oldest];
    HdStatus status = HD_OK;
    cl_int code = clWaitForEvents(1, &flight->copied);
    if (code != CL_SUCCESS)
        status = hd_opencl_fail(error, "clWaitForEvents", code);
    if (status == HD_OK) {
        frame->trace_seconds = trace_seconds(flights, flight);
        if (flight->launch)
            hd_opencl_flight_time_launch(flights, flight);
        flights->longest_launch = flight->longest_launch;
        frame->is_encoded = flight->encodes;
        memcpy(flight->encodes ? (void *)frame->rgba : (void *)frame->rgb,
               (const char *)flight->copy.data + SUM_BYTES, picture_bytes(flight));
        hd_frame_set_counts(frame, flight->samples, flight->copy.data, HD_SUM_WORKERS);
    }
    hd_opencl_flight_cancel(flight);
    flights->collected = hd_monotonic_seconds();
    flights->oldest = (flights->oldest + 1) % HD_FRAMES_IN_FLIGHT;
    flights->count--;
    return status;
}

void hd_opencl_flights_drop(HdOpenclFlights *flights) {
    clFinish(flights->queue);
    for (int i = 0; i < HD_FRAMES_IN_FLIGHT; i++)
        hd_opencl_flight_cancel(&flights->flights[i]);
    flights->count = 0;
}
