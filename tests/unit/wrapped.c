/* SPDX-License-Identifier: MIT */
#include "wrapped.h"

#define HD_DEFINE_WRAPPED(type, name, parameters, arguments)                                       \
    type(*replaced_##name) parameters;                                                             \
    type __real_##name parameters;                                                                 \
    type __wrap_##name parameters;                                                                 \
    type real_##name parameters {                                                                  \
        return __real_##name arguments;                                                            \
    }                                                                                              \
    type __wrap_##name parameters {                                                                \
        return replaced_##name != NULL ? replaced_##name arguments : __real_##name arguments;      \
    }
HD_WRAPPED(HD_DEFINE_WRAPPED)

const HdBackend *replaced_hd_backends[HD_BACKEND_COUNT] = {HD_BACKENDS(HD_BACKEND_ADDRESS)};
