/* SPDX-License-Identifier: MIT */
/* From what the user asked for to the devices that render together. */
#ifndef HD_CHOICE_DEVICES_H
#define HD_CHOICE_DEVICES_H

#include "choice/one_device.h"

typedef struct HdDeviceTeam {
    HdDevice devices[HD_MOST_TRACERS];
    HdRenderer *renderers[HD_MOST_TRACERS];
    int count;
} HdDeviceTeam;

/* Opens the device that was asked for, as hd_open_device does, or several: a list as in
   "cuda:0,cuda:1,c:0", each part of which names one as a single device is named, or "all". All are
   those of every backend, or of the one that is named, that can do what its options ask; what
   cannot be opened is left out, and so are GPUs by OpenCL that the team has by CUDA, and CPUs of
   other backends than plain C unless their backend is named; the reason's note tells of what is
   left out because it fails. Plain C beside GPUs leaves a core to each of them. A device of a list
   that cannot be opened is an error, and one that is named twice is HD_BAD_INPUT. */
HdStatus hd_open_devices(HdDeviceTeam *team, const HdDeviceWish *wish, HdDeviceReason *reason,
                         HdError *error);

void hd_close_devices(HdDeviceTeam *team);

#endif
