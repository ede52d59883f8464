/* SPDX-License-Identifier: MIT */
/* Functions and tables that tests may replace: the linker sends calls to wrapped.c (--wrap), which
   calls the replacement or, if it is NULL, the original. The original is real_FUNCTION. */
#ifndef HD_WRAPPED_H
#define HD_WRAPPED_H

#include <pthread.h>
#include <stddef.h>

#include "device/backend.h"
#include "device/opencl/api.h"
#include "render/backends.h"

/* X(type, name, parameters, arguments), from which CMakeLists.txt takes the names. */
#define HD_WRAPPED(X)                                                                              \
    X(int, fsync, (int descriptor), (descriptor))                                                  \
    X(int, flock, (int descriptor, int operation), (descriptor, operation))                        \
    X(int, unlinkat, (int folder, const char *name, int flags), (folder, name, flags))             \
    X(int, pthread_create,                                                                         \
      (pthread_t * thread, const pthread_attr_t *attributes, void *(*begin)(void *),               \
       void *context),                                                                             \
      (thread, attributes, begin, context))                                                        \
    X(void *, hd_large_allocate, (size_t bytes), (bytes))                                          \
    X(double, hd_monotonic_seconds, (void), ())                                                    \
    X(const HdBackend *, hd_backend_find, (const char *name), (name))                              \
    X(const HdBackend *, hd_backend_always_there, (void), ())                                      \
    X(HdStatus, hd_opencl_load_library, (HdOpenclLibrary * cl, HdError * error), (cl, error))

#define HD_DECLARE_WRAPPED(type, name, parameters, arguments)                                      \
    extern type(*replaced_##name) parameters;                                                      \
    type real_##name parameters;
HD_WRAPPED(HD_DECLARE_WRAPPED)

/* The program's hd_backends. */
extern const HdBackend *replaced_hd_backends[HD_BACKEND_COUNT] __asm__("__wrap_hd_backends");

#endif
