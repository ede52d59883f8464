/* SPDX-License-Identifier: MIT */
/* Embeds the kernels' text and specialises it. */
#ifndef HD_DEVICE_KERNEL_SOURCE_H
#define HD_DEVICE_KERNEL_SOURCE_H

#include <stdbool.h>
#include <stddef.h>

#include "device/options.h"

/* NUL-terminated, all #includes resolved, with #line directives. */
extern const unsigned char hd_opencl_source[];
extern const size_t hd_opencl_source_size; /* without the NUL */
extern const unsigned char hd_cuda_source[];
extern const size_t hd_cuda_source_size;

/* Features of a build for one scene; others are not compiled in. */
typedef struct HdKernelNeeds {
    int plane_bound, depth_bound; /* sizes of private arrays */
    int node_stack_bound;         /* likewise; 0: no meshes */
    bool refracts;
    bool lit_from_behind;
    bool many_lights;  /* enough of them to cull lights by clusters */
    bool bounded;      /* pixels come with an error bound */
    bool cut_outs;     /* materials of meshes have holes */
    bool environment;  /* rays that hit nothing see a picture */
    bool small_tables; /* the tables of solids fit in constant memory, if the device has it */
} HdKernelNeeds;

/* Properties that the text is specialised by. */
typedef struct HdKernelShape {
    int lanes;
    int pixels_per_item; /* a divisor of HD_BLOCK_PIXELS */
    int group_size;      /* threads of a group that share items, at most; 0: none share */
    bool wavefront;      /* kernels of the wavefront, otherwise of the megakernel */
    bool first_hits;     /* with the kernel for first hits */
    HdKernelNeeds needs;
    HdPrecision precision;
    HdMath math;
    int register_limit; /* registers of a thread on an NVIDIA device, at most; 0: no limit */
    int ptx_arch;       /* CUDA: PTX for compute_ of that number; 0: the device's machine code */
    bool is_probe;      /* only the probe's kernel (verify/probe.h) */
    bool rounds_by_fma; /* division and roots are made of fma: the device rounds its own wrongly */
} HdKernelShape;

/* Returns the register limit for a shape on sm_`nvidia_arch`: `asked`, or an automatic one if 0.
   Without a limit NVIDIA's compilers use so many registers that few threads are in flight. */
int hd_register_limit(const HdKernelShape *shape, int nvidia_arch, int asked);

enum { HD_KERNEL_DEFINES_SIZE = 512 };

/* Writes the compiler options " -DHD_LANES=1" and so on, among them -DHD_STRICT=1 for strict
   arithmetic, otherwise -DHD_STRICT=0. */
void hd_kernel_defines(const HdKernelShape *shape, char text[HD_KERNEL_DEFINES_SIZE]);

typedef enum HdKernel {
    HD_KERNEL_TRACE,  /* traces rays, or is the probe's */
    HD_KERNEL_STORE,  /* stores the pixels of a wavefront's batch, if threads work in groups */
    HD_KERNEL_SUM,    /* sums the counts */
    HD_KERNEL_ENCODE, /* encodes pixels with 8 bits, if threads work in groups */
    HD_KERNEL_FIRST_HITS,
    HD_KERNEL_COUNT
} HdKernel;

/* Returns the kernel's name in the text, or NULL if the shape lacks it. */
const char *hd_kernel_name(const HdKernelShape *shape, HdKernel kernel);

/* Returns the needs of a scene, rounded up so that scenes of similar size share a build. */
HdKernelNeeds hd_kernel_needs(const HdSceneTables *tables);
bool hd_kernel_needs_equal(const HdKernelNeeds *a, const HdKernelNeeds *b);

/* Writes one line for people. */
void hd_kernel_needs_describe(const HdKernelNeeds *needs, char *text, int capacity);

/* Returns the work items of a frame: blocks of 8 x 8 pixels, which may extend beyond the right and
   lower border, times the items of a block. */
int hd_kernel_item_count(int width, int height, int pixels_per_item);

#endif
