/* SPDX-License-Identifier: MIT */
/* The kernels, compiled for one NVIDIA architecture, which needs no device: by an NVRTC library
   of this machine, or earlier, while the program was built. */
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

/* Takes the newest library that compiles for sm_`arch`, one that is not newer than the driver
   (`driver_major`, 0: unknown) before one that is. Looks at the file `path`; if that is NULL, at
   the file that HEDRON_NVRTC names, or at none if it is "off"; else in the folders that
   docs/development/backends.md names. Otherwise the message says what was found and what to
   install for `device`. */
HdStatus hd_nvrtc_open(HdNvrtc *nvrtc, const char *device, int arch, int driver_major,
                       const char *path, HdError *error);
void hd_nvrtc_close(HdNvrtc *nvrtc);

/* Whether HEDRON_NVRTC names a file, so that nothing else will do. */
bool hd_nvrtc_is_named(void);

/* The package for Python whose NVRTC compiles for sm_`arch` what a driver for that CUDA takes. */
const char *hd_nvrtc_package(int arch, int driver_major);

/* Fails as hd_nvrtc_open does where nothing compiles for sm_`arch`. A library that did once is
   remembered in the cache folder (cache_folder.h); as long as the same file lies there and
   HEDRON_NVRTC names what it named, it is not loaded. */
HdStatus hd_nvrtc_check(const char *device, int arch, int driver_major, HdError *error);

/* Remembers that the library compiles for sm_`arch`. What cannot be remembered is not. */
void hd_nvrtc_remember(const char *library, int arch, int driver_major);

typedef struct HdCudaCode {
    char *image; /* owned; machine code, or PTX with its NUL */
    size_t size;
    char *log; /* owned; what the compiler had to say, "" at least */
} HdCudaCode;

typedef struct HdCudaTarget {
    int arch;    /* 61 */
    bool is_ptx; /* PTX for compute_61, otherwise the machine code of sm_61 */
} HdCudaTarget;

/* What the shape is compiled to for a device of sm_`arch`. */
HdCudaTarget hd_cuda_target(const HdKernelShape *shape, int arch);

/* The compiler's options for that target, a space between two. With PTX the limit of registers
   is the driver's business, and here for whoever compares options. */
void hd_cuda_options(char *options, size_t capacity, HdCudaTarget target,
                     const HdKernelShape *shape);

/* Compiles the embedded text with these options, for that target. On failure the whole log is in
   the message and there is nothing to free. */
HdStatus hd_cuda_compile(HdCudaCode *code, const HdNvrtc *nvrtc, HdCudaTarget target,
                         const char *options, HdError *error);

void hd_cuda_code_free(HdCudaCode *code);

/* ---- PTX that was compiled while the program was built, where an NVRTC was there to do it: for
   users who have none. It is general, for one text is to serve most scenes. ---- */

typedef struct HdCudaPtx {
    HdKernelShape shape;
    const char *maker; /* "NVRTC 12.6" */
    const unsigned char *text;
    size_t size; /* with the NUL */
} HdCudaPtx;

/* Made by cmake/embed_ptx.c: the kernels of the probe (verify/probe.h) and others, with strict
   arithmetic and all that a scene may need up to the bounds below; none without NVRTC. */
extern const HdCudaPtx hd_cuda_ptx[];
extern const int hd_cuda_ptx_count;

enum {
    HD_CUDA_PTX_ARCH = 61,
    HD_CUDA_PTX_BLOCK = 128,
    HD_CUDA_PTX_PLANES = 128,
    HD_CUDA_PTX_DEPTH = 64,
    HD_CUDA_PTX_NODE_STACK = 32
};

/* True where some of it can run on a device of sm_`arch`. */
bool hd_cuda_ptx_suits(int arch);

/* What does all that kernels of that shape would; NULL: there is none. */
const HdCudaPtx *hd_cuda_ptx_find(const HdKernelShape *shape, int arch);

#endif
