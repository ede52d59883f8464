/* SPDX-License-Identifier: MIT */
/* The frames that an OpenCL device works on: what its kernels write for each, and how that gets to
   the host while the next one is traced. */
#ifndef HD_DEVICE_OPENCL_FLIGHT_H
#define HD_DEVICE_OPENCL_FLIGHT_H

#include "device/launch_size.h"
#include "device/opencl/memory.h"
#include "image/frame.h"

typedef struct HdOpenclFlight {
    HdOpenclBuffer pixels, sums; /* radiance, and HD_SUM_WORKERS sums of the counts */
    HdOpenclBuffer image;        /* 8 bits, where the frame is encoded */
    bool encodes;
    int width, height, samples, floats; /* as of the frame's tables */
    double submitted;                   /* by hd_monotonic_seconds */
    cl_event first, last;               /* of the tracing; the flight's own */
    cl_event launch;         /* that is not timed yet, if there is one; the flight's own */
    double work;             /* of it */
    double longest_launch;   /* seconds, of those that are timed; negative: there is none */
    cl_event ready;          /* after it the results can be copied; the flight's own */
    HdOpenclHostMemory copy; /* the sums, then the pixels or the image */
    cl_event copied;
} HdOpenclFlight;

typedef struct HdOpenclFlights {
    HdOpenclOwner owner;
    cl_command_queue queue; /* of the copies, so that kernels of the next frame run beside them */
    HdOpenclFlight flights[HD_FRAMES_IN_FLIGHT];
    int oldest, count;
    double collected;      /* when the last one was */
    HdLaunchSize size;     /* of the tracing kernel's launches */
    double longest_launch; /* seconds, of the flight collected last; negative: not known */
} HdOpenclFlights;

/* The owner's context must live on. After a failure there is nothing to close. */
HdStatus hd_opencl_flights_open(HdOpenclFlights *flights, const HdOpenclOwner *owner,
                                HdError *error);
void hd_opencl_flights_close(HdOpenclFlights *flights); /* none is under way */

/* The next flight, with room for the frame, for kernels to be queued and its events to be set. */
HdStatus hd_opencl_flight_begin(HdOpenclFlights *flights, const HdFrameTables *tables, bool encodes,
                                HdOpenclFlight **flight, HdError *error);

/* Learns from the flight's launch, which is over, what the size of the next ones should be; nothing
   where there is no profile. */
void hd_opencl_flight_time_launch(HdOpenclFlights *flights, HdOpenclFlight *flight);

/* Queues the copies, all kernels being queued: the flight is under way. */
HdStatus hd_opencl_flight_send(HdOpenclFlights *flights, HdOpenclFlight *flight, HdError *error);

/* Gives a flight up that could not be sent. */
void hd_opencl_flight_cancel(HdOpenclFlight *flight);

/* Waits for the oldest flight, which ends in any case, and fills the frame. */
HdStatus hd_opencl_flight_collect(HdOpenclFlights *flights, HdFrame *frame, HdError *error);

/* Waits for the copies and forgets all flights. */
void hd_opencl_flights_drop(HdOpenclFlights *flights);

#endif
