/* SPDX-License-Identifier: MIT */
#define HD_LANES  8
#define HD_DOUBLE 1
#include "kernel_functions.h"
