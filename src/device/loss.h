/* SPDX-License-Identifier: MIT */
/* Devices that were there and are lost to the program. */
#ifndef HD_DEVICE_LOSS_H
#define HD_DEVICE_LOSS_H

#include <stdbool.h>

#include "base/error.h"

/* Fails with HD_UNAVAILABLE: `what` failed, since the device is lost; the message adds what to do.
 */
HdStatus hd_fail_lost(HdError *error, const char *what);

/* True for an error of the above, which is passing: another time the device may be there again. */
bool hd_is_loss(const HdError *error);

#endif
