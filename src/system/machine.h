/* SPDX-License-Identifier: MIT */
#ifndef HD_SYSTEM_MACHINE_H
#define HD_SYSTEM_MACHINE_H

#include <stddef.h>

/* Memory for tables and pictures, for free() to free: aligned to 64 bytes and not zeroed. Where
   there is much of it the system is asked for large pages, because the first touch of each small
   one takes longer than filling it. NULL where there is none left. */
void *hd_large_allocate(size_t bytes);

#endif
