/* SPDX-License-Identifier: MIT */
/* Caches on disk (cache_folder.h) the kernels that a renderer compiles at run time. Stores them
   only after they are accepted: strict kernels must have rendered golden frames correctly
   (verify/trust.h). An entry names its test and its compiler; kernels of any other entry are
   recompiled. */
#ifndef HD_DEVICE_KERNEL_CACHE_H
#define HD_DEVICE_KERNEL_CACHE_H

#include <stdbool.h>
#include <stddef.h>

#include "device/kernel_source.h"

enum { HD_KERNEL_KEY_LENGTH = 4096 };

/* Returns the binary of compiled kernels, owned by the caller; NULL if unavailable. */
typedef unsigned char *HdKernelReader(const void *context, size_t *size);

typedef struct HdKernelCache {
    const char *backend;
    char device[640];               /* name and driver, a part of every key */
    HdKernelShape shape;            /* shape of the kernels, set by the renderer */
    char key[HD_KERNEL_KEY_LENGTH]; /* key of the kernels in use */
    char maker[80];                 /* compiler of the kernels; "": unknown */
    char note[1024];                /* origin of the kernels, for people; "": none yet */
    bool is_settled;                /* the device's arithmetic is known to be correct */
    bool is_untested;               /* compiled and not yet accepted */
    bool is_on_trial;               /* may render before they are accepted */
    HdKernelReader *read;           /* reader until they are accepted */
    const void *context;            /* argument of `read` */
} HdKernelCache;

/* Initialises the cache for a device, by its name and driver. Nothing needs freeing. */
void hd_kernel_cache_begin(HdKernelCache *cache, const char *backend, const char *device,
                           const char *driver);

/* Looks for kernels. `source` and `options` are all that they are compiled from; `driver` is what
   else they depend on, without the device. Returns whether they were found; `*binary` is owned by
   the caller. If not, the caller compiles. */
bool hd_kernel_cache_find(HdKernelCache *cache, const void *source, size_t source_size,
                          const char *options, const char *driver, unsigned char **binary,
                          size_t *size);

/* Rejects the found kernels, which the driver refused for that reason. The caller compiles. */
void hd_kernel_cache_refuse(HdKernelCache *cache, const char *reason);

/* Notes that `maker` compiled the kernels. They are read when they are accepted: some drivers
   return more after a run. */
void hd_kernel_cache_compiled(HdKernelCache *cache, HdKernelReader *read, const void *context,
                              const char *maker, double seconds);

/* Accepts the compiled kernels and stores them if possible. */
void hd_kernel_cache_accept(HdKernelCache *cache);

/* ---- arithmetic of a device as the probe found it (verify/probe.h), by the device's name, its
   driver, the kernels and the version of the program ---- */

typedef struct HdArithmetic {
    bool rounds_by_fma;   /* division and roots are correct only if made of fma */
    char difference[512]; /* first error found; "": none */
} HdArithmetic;

void hd_arithmetic_remember(const char *device, const char *driver, HdPrecision precision,
                            const HdArithmetic *found);

/* Returns false if nothing is remembered. */
bool hd_arithmetic_recall(const char *device, const char *driver, HdPrecision precision,
                          HdArithmetic *known);

#endif
