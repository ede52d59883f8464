/* SPDX-License-Identifier: MIT */
/* The kernels' text, embedded in the program, and how it is specialised. */
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

/* What a build for one scene can do; what it cannot is not compiled in. */
typedef struct HdKernelNeeds {
    int plane_bound, depth_bound; /* private arrays are this large */
    int node_stack_bound;         /* likewise; 0: there are no meshes */
    bool refracts;
    bool lit_from_behind;
    bool many_lights;  /* so many that one lane may judge those that follow each other together */
    bool bounded;      /* pixels come with their survey */
    bool small_tables; /* those of solids fit in constant memory, where a device has it */
} HdKernelNeeds;

/* What the text is specialised by. */
typedef struct HdKernelShape {
    int lanes;
    int pixels_per_item; /* a divisor of HD_BLOCK_PIXELS */
    int group_size;      /* most threads of a group that share items; 0: none do */
    bool wavefront;      /* the kernels of that pipeline, or those of the other one */
    bool first_hits;     /* a kernel for these is there too */
    HdKernelNeeds needs;
    HdPrecision precision;
    HdMath math;
    int register_limit; /* of a thread on an NVIDIA device; 0: the compiler's own */
    int ptx_arch;       /* CUDA: PTX for compute_ of that number; 0: the device's machine code */
    bool is_probe;      /* the kernel of the probe (verify/probe.h) and no others */
    bool rounds_by_fma; /* division and roots are fused operations: the device's round wrongly */
} HdKernelShape;

/* The limit for a shape on sm_`nvidia_arch`: `asked`, or, if that is 0, what suits. Left alone,
   NVIDIA's compilers take so many registers that few threads are in flight. On an H100 128 is best,
   or 96 for floats with many lights or meshes, spills and all. A block's threads share 65536. */
int hd_register_limit(const HdKernelShape *shape, int nvidia_arch, int asked);

enum { HD_KERNEL_DEFINES_SIZE = 512 };

/* Writes the compiler options " -DHD_LANES=1" and so on. With strict arithmetic -DHD_STRICT=1 is
   among them, otherwise -DHD_STRICT=0. */
void hd_kernel_defines(const HdKernelShape *shape, char text[HD_KERNEL_DEFINES_SIZE]);

typedef enum HdKernel {
    HD_KERNEL_TRACE,  /* traces rays, or is the probe's */
    HD_KERNEL_STORE,  /* stores the pixels of a wavefront's batch, where threads work in groups */
    HD_KERNEL_SUM,    /* adds counts up */
    HD_KERNEL_ENCODE, /* makes 8 bits of pixels, where threads work in groups */
    HD_KERNEL_FIRST_HITS,
    HD_KERNEL_COUNT
} HdKernel;

/* What the kernel is called in the text; NULL: the shape has none. */
const char *hd_kernel_name(const HdKernelShape *shape, HdKernel kernel);

/* What a scene needs, its numbers rounded up for scenes of similar size to share a build. */
HdKernelNeeds hd_kernel_needs(const HdSceneTables *tables);
bool hd_kernel_needs_equal(const HdKernelNeeds *a, const HdKernelNeeds *b);

/* One line for people. */
void hd_kernel_needs_describe(const HdKernelNeeds *needs, char *text, int capacity);

/* Work items of a frame: blocks of 8 x 8 pixels, partly outside of the picture at its right and
   lower border, times the items of a block. */
int hd_kernel_item_count(int width, int height, int pixels_per_item);

#endif
