/* SPDX-License-Identifier: MIT */
#include "device/loss.h"

#include <string.h>

static const char sentence[] =
    "the device is lost to this program (reset, stopped by the system after too long a kernel, out "
    "of order or taken away); the system's log may tell why, and --device and --backend choose "
    "another";

HdStatus hd_fail_lost(HdError *error, const char *what) {
    return hd_fail(error, HD_UNAVAILABLE, "%s: %s", what, sentence);
}

bool hd_is_loss(const HdError *error) {
    return error->status == HD_UNAVAILABLE && strstr(error->message, sentence) != NULL;
}
