/* SPDX-License-Identifier: MIT */
/* Waiting that an interrupt ends (interrupt.h), on whatever thread the signal comes. */
#ifndef HD_SYSTEM_PATIENCE_H
#define HD_SYSTEM_PATIENCE_H

#include <stdbool.h>

/* Waits until a write of a few hundred bytes will not block, because there is room or because it
   will fail; false where an interrupt came first. */
bool hd_wait_to_write(int descriptor);

#endif
