/* SPDX-License-Identifier: MIT */
/* The kernels that one renderer compiles while the program runs, kept on disk (cache_folder.h).
   What was compiled is stored only after it was accepted: with strict arithmetic, when it has
   rendered golden frames rightly (verify/trust.h). An entry tells so and by what it was compiled;
   what another one says is compiled anew. */
#ifndef HD_DEVICE_KERNEL_CACHE_H
#define HD_DEVICE_KERNEL_CACHE_H

#include <stdbool.h>
#include <stddef.h>

#include "device/kernel_source.h"

enum { HD_KERNEL_KEY_LENGTH = 4096 };

/* Hands out the binary of compiled kernels, the caller's to free; NULL where that cannot be. */
typedef unsigned char *HdKernelReader(const void *context, size_t *size);

typedef struct HdKernelCache {
    const char *backend;
    char device[640];               /* name and driver, a part of every key */
    HdKernelShape shape;            /* of the kernels; the renderer's to set */
    char key[HD_KERNEL_KEY_LENGTH]; /* of the kernels in use */
    char maker[80];                 /* what compiled them; "": nobody knows */
    char note[1024];                /* where they came from, for people; "": there are none yet */
    bool is_settled;                /* the device's arithmetic is known to be right */
    bool is_untested;               /* compiled anew and not yet accepted */
    bool is_on_trial;               /* they may render meanwhile */
    HdKernelReader *read;           /* until they are accepted, */
    const void *context;            /* with this */
} HdKernelCache;

/* For a device, by its name and driver. There is nothing to free. */
void hd_kernel_cache_begin(HdKernelCache *cache, const char *backend, const char *device,
                           const char *driver);

/* Looks for kernels: `source` and `options` are all that they are compiled from, `driver` what else
   they depend on, apart from the device. True where they are there; `*binary` is the caller's to
   free. Otherwise the caller compiles. */
bool hd_kernel_cache_find(HdKernelCache *cache, const void *source, size_t source_size,
                          const char *options, const char *driver, unsigned char **binary,
                          size_t *size);

/* What was found is of no use: the driver refuses it, and the reason. The caller compiles. */
void hd_kernel_cache_refuse(HdKernelCache *cache, const char *reason);

/* The kernels, which were not found, are compiled, by `maker`. They are read once they are
   accepted: a driver may have more to hand out when they have run. */
void hd_kernel_cache_compiled(HdKernelCache *cache, HdKernelReader *read, const void *context,
                              const char *maker, double seconds);

/* The compiled kernels are in order: stores them, if that can be. */
void hd_kernel_cache_accept(HdKernelCache *cache);

/* ---- what the probe found of a device's arithmetic (verify/probe.h), kept by the device's name,
   its driver, the kernels and the version of this program ---- */

typedef struct HdArithmetic {
    bool rounds_by_fma;   /* division and roots are right only if they are made of fma */
    char difference[512]; /* what was wrong first; "": nothing was */
} HdArithmetic;

void hd_arithmetic_remember(const char *device, const char *driver, HdPrecision precision,
                            const HdArithmetic *found);

/* False where nothing is remembered. */
bool hd_arithmetic_recall(const char *device, const char *driver, HdPrecision precision,
                          HdArithmetic *known);

#endif
