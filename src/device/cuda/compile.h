/* SPDX-License-Identifier: MIT */
/* Compiles the kernels for one NVIDIA architecture, without a device: by an NVRTC library of this
   machine, or while the program is built. */
#ifndef HD_DEVICE_CUDA_COMPILE_H
#define HD_DEVICE_CUDA_COMPILE_H

#include <stdbool.h>
#include <stddef.h>

#include "device/cuda/api.h"
#include "device/kernel_source.h"

typedef struct HdNvrtc {
    HdNvrtcFunctions functions;
    int major, minor;
    void *library; /* owned */
} HdNvrtc;

/* Opens the newest library that compiles for sm_`arch`; prefers those not newer than the driver
   (`driver_major`, 0: unknown). Tries only `path`; if that is NULL, only the file in HEDRON_NVRTC,
   or none if that is "off"; if it is unset, the folders of docs/development/backends.md. The error
   lists the libraries found and what to install for `device`. */
HdStatus hd_nvrtc_open(HdNvrtc *nvrtc, const char *device, int arch, int driver_major,
                       const char *path, HdError *error);
void hd_nvrtc_close(HdNvrtc *nvrtc);

/* Returns whether HEDRON_NVRTC names a file, which excludes all other compilers. */
bool hd_nvrtc_is_named(void);

/* Returns the Python package whose NVRTC compiles for sm_`arch` and for a driver of that CUDA
   version. */
const char *hd_nvrtc_package(int arch, int driver_major);

/* Fails as hd_nvrtc_open does if nothing compiles for sm_`arch`. Does not load a library that is
   remembered in the cache folder (cache_folder.h), if the file and HEDRON_NVRTC are unchanged. */
HdStatus hd_nvrtc_check(const char *device, int arch, int driver_major, HdError *error);

/* Remembers that the library compiles for sm_`arch`. Ignores failures. */
void hd_nvrtc_remember(const char *library, int arch, int driver_major);

typedef struct HdCudaCode {
    char *image; /* owned; machine code, or PTX with its NUL */
    size_t size;
    char *log; /* owned; output of the compiler, "" if there is none */
} HdCudaCode;

typedef struct HdCudaTarget {
    int arch;    /* 61 */
    bool is_ptx; /* PTX for compute_61, otherwise the machine code of sm_61 */
} HdCudaTarget;

/* Returns the target of the shape on a device of sm_`arch`. */
HdCudaTarget hd_cuda_target(const HdKernelShape *shape, int arch);

/* Writes the compiler's options for that target, separated by spaces. For PTX the register limit is
   applied by the driver; here it distinguishes options. */
void hd_cuda_options(char *options, size_t capacity, HdCudaTarget target,
                     const HdKernelShape *shape);

/* Compiles the embedded text with these options, for that target. On failure the message holds the
   whole log, and nothing needs freeing. */
HdStatus hd_cuda_compile(HdCudaCode *code, const HdNvrtc *nvrtc, HdCudaTarget target,
                         const char *options, HdError *error);

void hd_cuda_code_free(HdCudaCode *code);

/* ---- PTX compiled at build time if NVRTC was available, for users without NVRTC. It is general:
   one text serves most scenes. ---- */

typedef struct HdCudaPtx {
    HdKernelShape shape;
    const char *maker; /* "NVRTC 12.6" */
    const unsigned char *text;
    size_t size; /* with the NUL */
} HdCudaPtx;

/* Made by cmake/embed_ptx.c: the kernels of the probe (verify/probe.h) and others, with strict
   arithmetic and all features of a scene up to the bounds below. Empty without NVRTC. */
extern const HdCudaPtx hd_cuda_ptx[];
extern const int hd_cuda_ptx_count;

enum {
    HD_CUDA_PTX_ARCH = 61,
    HD_CUDA_PTX_BLOCK = 128,
    HD_CUDA_PTX_PLANES = 128,
    HD_CUDA_PTX_DEPTH = 64,
    HD_CUDA_PTX_NODE_STACK = 32
};

/* Returns whether any of it runs on a device of sm_`arch`. */
bool hd_cuda_ptx_suits(int arch);

/* Returns the PTX that covers kernels of that shape, or NULL. */
const HdCudaPtx *hd_cuda_ptx_find(const HdKernelShape *shape, int arch);

#endif
