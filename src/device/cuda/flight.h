/* SPDX-License-Identifier: MIT */
/* The frames that an NVIDIA device works on: what its kernels write for each, and how that gets to
   the host while the next one is traced. */
#ifndef HD_DEVICE_CUDA_FLIGHT_H
#define HD_DEVICE_CUDA_FLIGHT_H

#include "device/backend.h"
#include "device/cuda/memory.h"
#include "device/launch_size.h"

typedef struct HdCudaFlight {
    HdCudaMemory pixels, sums; /* radiance, and HD_SUM_WORKERS sums of the counts */
    HdCudaMemory image;        /* 8 bits, where the frame is encoded */
    HdCudaHostMemory tables;   /* of the frame, on their way to the device */
    bool encodes;
    int width, height, samples, floats; /* as of the frame's tables */
    HdCuEvent start, end;               /* of the tracing, for the caller to record */
    HdCuEvent before, between; /* launches after the first one, and after one that is waited for;
                                  likewise */
    HdCuEvent began;           /* which of them was recorded before the launch that is not timed
                                  yet; NULL: all are */
    double work;               /* of that launch */
    double longest_launch;     /* seconds, of those that are timed */
    HdCuEvent ready;           /* after it the results can be copied; for the caller as well */
    HdCudaHostMemory copy;     /* the sums, then the pixels or the image */
    HdCuEvent copied;
} HdCudaFlight;

typedef struct HdCudaFlights {
    HdCudaOwner owner;
    HdCuStream stream; /* of the copies, so that kernels of the next frame run beside them */
    HdCudaFlight flights[HD_FRAMES_IN_FLIGHT];
    int oldest, count;
    HdLaunchSize size;     /* of the tracing kernel's launches */
    double longest_launch; /* seconds, of the flight collected last */
} HdCudaFlights;

/* A stream that waits for no other one by itself. */
HdStatus hd_cuda_create_stream(const HdCudaDriver *driver, HdCuStream *stream, HdError *error);

/* The device's context is current in every call, and what the owner points to lives on. After a
   failure hd_cuda_flights_close is needed too. */
HdStatus hd_cuda_flights_open(HdCudaFlights *flights, const HdCudaOwner *owner, HdError *error);
void hd_cuda_flights_close(HdCudaFlights *flights); /* none is under way */

/* The next flight, with room for the frame; the kernels are then queued and its events recorded. */
HdStatus hd_cuda_flight_begin(HdCudaFlights *flights, const HdFrameTables *tables, bool encodes,
                              HdCudaFlight **flight, HdError *error);

/* Learns from a launch that is over, between its event `began` and `end`, what the size of the next
   ones should be. */
HdStatus hd_cuda_flight_time_launch(HdCudaFlights *flights, HdCudaFlight *flight, HdCuEvent end,
                                    HdError *error);

/* Queues the copies, all kernels being queued: the flight is under way. */
HdStatus hd_cuda_flight_send(HdCudaFlights *flights, HdCudaFlight *flight, HdError *error);

/* Waits for the oldest flight, which ends in any case, and fills the frame. */
HdStatus hd_cuda_flight_collect(HdCudaFlights *flights, HdFrame *frame, HdError *error);

/* Waits for the device and forgets all flights. */
void hd_cuda_flights_drop(HdCudaFlights *flights);

#endif
