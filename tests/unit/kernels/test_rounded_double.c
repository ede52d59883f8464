/* SPDX-License-Identifier: MIT */
#define HD_DOUBLE 1
#include "rounded_functions.h"
