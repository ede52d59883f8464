/* SPDX-License-Identifier: MIT */
/* What is remembered in the cache folder of a device's arithmetic in float, by its name, its driver
   and this program's kernels, so that a device that computes wrongly need not be tried again. */
#ifndef HD_DEVICE_VERDICT_H
#define HD_DEVICE_VERDICT_H

#include <stdbool.h>
#include <stddef.h>

/* `difference` is what was wrong first; empty: nothing was. */
void hd_verdict_put(const char *device, const char *driver, const char *difference);

/* False where nothing is remembered. */
bool hd_verdict_get(const char *device, const char *driver, char *difference, size_t capacity);

#endif
