/* SPDX-License-Identifier: MIT */
/* Measuring time. */
#ifndef HD_SYSTEM_CLOCK_H
#define HD_SYSTEM_CLOCK_H

/* Seconds on a clock that only goes forward. */
double hd_monotonic_seconds(void);

#endif
