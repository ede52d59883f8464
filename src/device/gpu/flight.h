/* SPDX-License-Identifier: MIT */
/* The frames that a GPU works on: what its kernels write for each, and how that gets to the host
   while the next one is traced. */
#ifndef HD_DEVICE_GPU_FLIGHT_H
#define HD_DEVICE_GPU_FLIGHT_H

#include "device/gpu/memory.h"
#include "device/launch_size.h"

enum { HD_SUM_WORKERS = 1024 }; /* work items of hedron_sum_counts; each writes one sum */

typedef struct HdGpuFlight {
    HdGpuMemory pixels, sums; /* radiance, and HD_SUM_WORKERS sums of the counts */
    HdGpuMemory image;        /* 8 bits, where the frame is encoded */
    HdGpuMemory tables;       /* of the host: of the frame, on their way to the device */
    HdGpuMemory copy;         /* of the host: the sums, then the pixels or the image */
    bool encodes;
    const HdFrameTables *of; /* the frame */
    int items, told;         /* of the frame, and how many of them are told to be done */
    double submitted;        /* by hd_monotonic_seconds */
    int launches;            /* of the tracing kernel */
    HdGpuMark first, later;  /* of its launches: the first one, and the last of others */
    HdGpuMark *untimed;      /* which of them is not timed yet, if one is */
    double work;             /* of that launch */
    double launched;         /* by hd_monotonic_seconds, that launch */
    bool is_alone;           /* nothing was queued before that launch that may not be over */
    double longest_launch;   /* seconds, of those that are timed; negative: there is none */
    HdGpuMark summed, encoded, copied;
} HdGpuFlight;

typedef struct HdGpuFlights {
    HdGpuFlight flights[HD_FRAMES_IN_FLIGHT];
    int oldest, count;
    double collected;      /* when the last one was */
    HdLaunchSize size;     /* of the tracing kernel's launches */
    double longest_launch; /* seconds, of the flight collected last; negative: not known */
} HdGpuFlights;

void hd_gpu_flights_close(HdGpuFlights *flights, const HdGpu *gpu); /* none is under way */

/* The next flight, with room for the frame of so many items, for kernels to be queued with its
   marks. */
HdStatus hd_gpu_flight_begin(HdGpuFlights *flights, const HdGpu *gpu, const HdFrameTables *tables,
                             int items, bool encodes, HdGpuFlight **flight, HdError *error);

/* A launch of the tracing kernel, with so much work. */
HdStatus hd_gpu_flight_launch(HdGpuFlight *flight, const HdGpu *gpu, const HdGpuLaunch *launch,
                              double work, HdError *error);

/* Learns from the last of these launches, which is over, what the size of the next ones should be.
   Where the device does not tell how long it took, the host's clock does, as far as it can:
   `waited` is when the host, by hd_monotonic_seconds, began to wait for it. */
HdStatus hd_gpu_flight_time_launch(HdGpuFlights *flights, HdGpuFlight *flight, const HdGpu *gpu,
                                   double waited, HdError *error);

/* The items before number `end` are done. */
void hd_gpu_flight_tell(HdGpuFlight *flight, int end);

/* Queues the copies, all kernels being queued: the flight is under way. */
HdStatus hd_gpu_flight_send(HdGpuFlights *flights, HdGpuFlight *flight, const HdGpu *gpu,
                            HdError *error);

/* Waits for the oldest flight, which ends in any case, and fills the frame. */
HdStatus hd_gpu_flight_collect(HdGpuFlights *flights, const HdGpu *gpu, HdFrame *frame,
                               HdError *error);

#endif
