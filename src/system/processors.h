/* SPDX-License-Identifier: MIT */
#ifndef HD_SYSTEM_PROCESSORS_H
#define HD_SYSTEM_PROCESSORS_H

/* The number of processors that this process may run on, at least 1. */
int hd_processor_count(void);

#endif
