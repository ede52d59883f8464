/* SPDX-License-Identifier: MIT */
/* Frames whose pixels are known from mathematics. */
#ifndef HD_CONFORMANCE_TRUTHS_H
#define HD_CONFORMANCE_TRUTHS_H

#include "backend.h"

/* Renders every truth with an open renderer and prints those that fail. */
void check_truths(HdRenderer *renderer, HdPrecision precision, const char *label, int *checked,
                  int *failed);

#endif
