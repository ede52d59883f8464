/* SPDX-License-Identifier: MIT */
#define HD_DOUBLE 0
#include "tables/builder.inc"
