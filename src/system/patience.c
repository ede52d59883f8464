/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "system/patience.h"

#include <errno.h>
#include <poll.h>

#include "system/interrupt.h"

enum { GLANCE_MS = 200 };

bool hd_wait_to_write(int descriptor) {
    struct pollfd ready = {.fd = descriptor, .events = POLLOUT};
    for (;;) {
        int count = poll(&ready, 1, GLANCE_MS);
        if (count > 0 || (count < 0 && errno != EINTR))
            return true;
        if (hd_interrupt_signal() != 0)
            return false;
    }
}
