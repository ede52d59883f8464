/* SPDX-License-Identifier: MIT */
/* Among several devices, the one to render a job with: the fastest on its own scene. */
#ifndef HD_CHOICE_FASTEST_DEVICE_H
#define HD_CHOICE_FASTEST_DEVICE_H

#include "choice/trial.h"

/* A job that plain C does in less is not worth waking another device for. */
#define HD_AUTO_SMALL_SECONDS 0.25

/* A job that plain C does in less is not worth compiling kernels and measuring for. */
#define HD_AUTO_MEASURE_SECONDS 2.0

typedef struct HdAutoChoice {
    const HdDevice *candidates; /* all can do what the options ask; the first is the one to take */
    int count;                  /* where nothing is known of their speed; at least 1 */
    int measured;               /* so many, from the first on, are compared */
    const HdRenderOptions *options;
    const HdJob *job;
    double frame_seconds; /* of plain C, estimated */
} HdAutoChoice;

/* Opens one of the candidates; kernels that are compiled at run time are compiled for the scene.
   Which one: where the job is worth it, the fastest of those compared, which is measured once for a
   machine, a version of the program and scenes alike (as many planes, triangles, lights, pixels,
   rounded to powers of two) and then remembered in the cache folder. Otherwise plain C, if it is
   among those compared, else the first. A device that turns out to be unavailable, such as one that
   computes wrongly, is passed over; `note` then has a sentence about it, and else is empty. `why`
   says why this device. */
HdStatus hd_auto_open(HdRenderer **renderer, HdDevice *device, const HdAutoChoice *choice,
                      char why[1024], char note[2048], HdError *error);

#endif
