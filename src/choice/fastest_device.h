/* SPDX-License-Identifier: MIT */
/* Among several devices, the one to render a job with: the fastest on its own scene. */
#ifndef HD_CHOICE_FASTEST_DEVICE_H
#define HD_CHOICE_FASTEST_DEVICE_H

#include "choice/candidates.h"

/* A job that plain C does in less is not worth compiling kernels and measuring for. */
#define HD_AUTO_MEASURE_SECONDS 2.0

/* Opens one of the candidates, of which there are some. Which one: where the job is worth it, the
   fastest of those compared, which is measured once for a machine and jobs alike (record.h).
   Otherwise plain C, if it is among those compared, else the first. A device that turns out to be
   unavailable, such as one that computes wrongly, is passed over where nobody named it: kernels
   that are compiled at run time are then compiled for the scene. The candidates' `why` and `note`
   tell about it. The open one is then `*opened`. */
HdStatus hd_fastest_open(HdCandidates *candidates, HdTeamDevice *opened, HdError *error);

#endif
