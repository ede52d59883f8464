/* SPDX-License-Identifier: MIT */
#define HD_DOUBLE 1
#include "tables/builder.inc"
