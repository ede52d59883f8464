/* SPDX-License-Identifier: MIT */
#include "device/cuda/flight.h"

#include <string.h>

#include "device/device_launch.h"

#define CALL(flights, member, function, arguments, error)                                          \
    hd_cuda_check((flights)->owner.driver, (flights)->owner.driver->member arguments, #function,   \
                  error)

static const size_t SUM_BYTES = sizeof(HdRayCounts) * HD_SUM_WORKERS;

HdStatus hd_cuda_create_stream(const HdCudaDriver *driver, HdCuStream *stream, HdError *error) {
    return hd_cuda_check(driver, driver->stream_create(stream, HD_CU_STREAM_NON_BLOCKING),
                         "cuStreamCreate", error);
}

static HdStatus create_event(HdCudaFlights *flights, HdCuEvent *event, unsigned int flags,
                             HdError *error) {
    return CALL(flights, event_create, cuEventCreate, (event, flags), error);
}

static HdStatus open_flight(HdCudaFlights *flights, HdCudaFlight *flight, HdError *error) {
    HdStatus status = create_event(flights, &flight->start, 0, error);
    if (status == HD_OK)
        status = create_event(flights, &flight->end, 0, error);
    if (status == HD_OK)
        status = create_event(flights, &flight->before, 0, error);
    if (status == HD_OK) /* to wait for it must not cost a core */
        status = create_event(flights, &flight->between, HD_CU_EVENT_BLOCKING_SYNC, error);
    if (status == HD_OK)
        status = create_event(flights, &flight->ready, HD_CU_EVENT_DISABLE_TIMING, error);
    if (status == HD_OK)
        status = create_event(flights, &flight->copied,
                              HD_CU_EVENT_BLOCKING_SYNC | HD_CU_EVENT_DISABLE_TIMING, error);
    return status;
}

HdStatus hd_cuda_flights_open(HdCudaFlights *flights, const HdCudaOwner *owner, HdError *error) {
    *flights = (HdCudaFlights){.owner = *owner};
    HdStatus status = hd_cuda_create_stream(owner->driver, &flights->stream, error);
    for (int i = 0; status == HD_OK && i < HD_FRAMES_IN_FLIGHT; i++)
        status = open_flight(flights, &flights->flights[i], error);
    return status;
}

static void close_flight(const HdCudaFlights *flights, HdCudaFlight *flight) {
    const HdCudaOwner *owner = &flights->owner;
    enum { EVENTS = 6 };
    HdCuEvent events[EVENTS] = {flight->start,   flight->end,   flight->before,
                                flight->between, flight->ready, flight->copied};
    hd_cuda_release(owner, &flight->pixels);
    hd_cuda_release(owner, &flight->sums);
    hd_cuda_release(owner, &flight->image);
    hd_cuda_release_host(owner, &flight->tables);
    hd_cuda_release_host(owner, &flight->copy);
    for (int i = 0; i < EVENTS; i++)
        if (events[i])
            owner->driver->event_destroy(events[i]);
}

void hd_cuda_flights_close(HdCudaFlights *flights) {
    for (int i = 0; i < HD_FRAMES_IN_FLIGHT; i++)
        close_flight(flights, &flights->flights[i]);
    if (flights->stream)
        flights->owner.driver->stream_destroy(flights->stream);
    *flights = (HdCudaFlights){0};
}

static size_t pixel_count(const HdCudaFlight *flight) {
    return (size_t)flight->width * (size_t)flight->height;
}

/* Of what is copied. */
static size_t picture_bytes(const HdCudaFlight *flight) {
    return pixel_count(flight) * (flight->encodes ? 4 : (size_t)flight->floats * sizeof(float));
}

static size_t bytes_of_tables(const HdFrameTables *tables) {
    size_t bytes = 0;
    for (int i = 0; i < tables->table_count; i++)
        bytes += tables->table[i].bytes;
    return bytes;
}

HdStatus hd_cuda_flight_begin(HdCudaFlights *flights, const HdFrameTables *tables, bool encodes,
                              HdCudaFlight **out, HdError *error) {
    HdCudaFlight *flight =
        &flights->flights[(flights->oldest + flights->count) % HD_FRAMES_IN_FLIGHT];
    const HdCudaOwner *owner = &flights->owner;
    flight->encodes = encodes;
    flight->width = tables->width;
    flight->height = tables->height;
    flight->samples = tables->samples;
    flight->floats = tables->floats;
    flight->began = NULL;
    flight->longest_launch = 0.0;
    *out = flight;
    HdStatus status = hd_cuda_reserve(owner, &flight->pixels,
                                      sizeof(float) * (size_t)flight->floats * pixel_count(flight),
                                      "pixels", error);
    if (status == HD_OK)
        status = hd_cuda_reserve(owner, &flight->sums, SUM_BYTES, "sums of the counts", error);
    if (status == HD_OK && encodes)
        status = hd_cuda_reserve(owner, &flight->image, 4 * pixel_count(flight), "encoded pixels",
                                 error);
    if (status == HD_OK)
        status = hd_cuda_reserve_host(owner, &flight->tables, bytes_of_tables(tables),
                                      "tables of the frame", error);
    if (status == HD_OK)
        status = hd_cuda_reserve_host(owner, &flight->copy, SUM_BYTES + picture_bytes(flight),
                                      "pixels on their way to the host", error);
    return status;
}

HdStatus hd_cuda_flight_time_launch(HdCudaFlights *flights, HdCudaFlight *flight, HdCuEvent end,
                                    HdError *error) {
    float milliseconds = 0.0f;
    HdStatus status = CALL(flights, event_elapsed, cuEventElapsedTime,
                           (&milliseconds, flight->began, end), error);
    if (status != HD_OK)
        return status;
    double seconds = 1e-3 * (double)milliseconds;
    hd_launch_size_note(&flights->size, flight->work, seconds);
    if (seconds > flight->longest_launch)
        flight->longest_launch = seconds;
    flight->began = NULL;
    return HD_OK;
}

static HdStatus read(HdCudaFlights *flights, HdCudaFlight *flight, const HdCudaMemory *from,
                     size_t bytes, size_t offset, HdError *error) {
    void *to = (char *)flight->copy.data + offset;
    return CALL(flights, copy_to_host_async, cuMemcpyDtoHAsync,
                (to, from->pointer, bytes, flights->stream), error);
}

HdStatus hd_cuda_flight_send(HdCudaFlights *flights, HdCudaFlight *flight, HdError *error) {
    const HdCudaMemory *picture = flight->encodes ? &flight->image : &flight->pixels;
    HdStatus status = CALL(flights, stream_wait_event, cuStreamWaitEvent,
                           (flights->stream, flight->ready, 0), error);
    if (status == HD_OK)
        status = read(flights, flight, &flight->sums, SUM_BYTES, 0, error);
    if (status == HD_OK)
        status = read(flights, flight, picture, picture_bytes(flight), SUM_BYTES, error);
    if (status == HD_OK)
        status =
            CALL(flights, event_record, cuEventRecord, (flight->copied, flights->stream), error);
    if (status == HD_OK)
        flights->count++;
    return status;
}

HdStatus hd_cuda_flight_collect(HdCudaFlights *flights, HdFrame *frame, HdError *error) {
    HdCudaFlight *flight = &flights->flights[flights->oldest];
    float milliseconds = 0.0f;
    flights->oldest = (flights->oldest + 1) % HD_FRAMES_IN_FLIGHT;
    flights->count--;
    HdStatus status = CALL(flights, event_synchronize, cuEventSynchronize, (flight->copied), error);
    if (status == HD_OK)
        status = CALL(flights, event_elapsed, cuEventElapsedTime,
                      (&milliseconds, flight->start, flight->end), error);
    if (status == HD_OK && flight->began)
        status = hd_cuda_flight_time_launch(flights, flight, flight->end, error);
    if (status != HD_OK)
        return status;
    flights->longest_launch = flight->longest_launch;
    frame->trace_seconds = 1e-3 * (double)milliseconds;
    frame->is_encoded = flight->encodes;
    memcpy(flight->encodes ? (void *)frame->rgba : (void *)frame->rgb,
           (const char *)flight->copy.data + SUM_BYTES, picture_bytes(flight));
    hd_frame_set_counts(frame, flight->samples, flight->copy.data, HD_SUM_WORKERS);
    return HD_OK;
}

void hd_cuda_flights_drop(HdCudaFlights *flights) {
    flights->owner.driver->context_synchronize();
    flights->count = 0;
}
