/* SPDX-License-Identifier: MIT */
/* Every function of the driver that driver.c does not have: it succeeds and does nothing. */
#include "device/cuda/api.h"

#pragma GCC diagnostic ignored "-Wunused-parameter" /* none of them uses any */

#define DEFINE(member, symbol, parameters)                                                         \
    __attribute__((weak)) HdCuResult symbol parameters;                                            \
    HdCuResult symbol parameters {                                                                 \
        return HD_CU_SUCCESS;                                                                      \
    }

HD_CUDA_FUNCTIONS(DEFINE)
