/* SPDX-License-Identifier: MIT */
/* What hosts share with the kernels: the rows of the tables, the kernels' arguments and the plan of
   a wavefront's queue. HD_DOUBLE is 0 or 1 where a file has to do with reals. */
#ifndef HD_HOST_SHARED_H
#define HD_HOST_SHARED_H

#include "kernels/host/language.h"

#include "kernels/common/kernel_arguments.h"
#include "kernels/common/scene_tables.h"
#include "kernels/common/wave_stack.h"

#endif
