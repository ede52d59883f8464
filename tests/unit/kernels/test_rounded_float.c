/* SPDX-License-Identifier: MIT */
#define HD_DOUBLE 0
#include "rounded_functions.h"
