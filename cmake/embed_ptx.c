/* SPDX-License-Identifier: MIT */
/* Compiles the kernels to PTX at build time, as a C file that src/device/cuda/compile.h declares:

       embed_ptx OUTPUT.c [NVRTC [COUNT]]

   Without an NVRTC that compiles for the card the list is empty, and a line gives the reason.
   COUNT: number of shapes, at most. */
#include <stdio.h>
#include <stdlib.h>

#include "device/cuda/compile.h"

#define COMMON                                                                                     \
    .lanes = 1, .pixels_per_item = 1, .group_size = HD_CUDA_PTX_BLOCK,                             \
    .ptx_arch = HD_CUDA_PTX_ARCH, .math = HD_MATH_STRICT
#define PROBE(is_double)                                                                           \
    { COMMON, .precision = PRECISION(is_double), .is_probe = true }
#define RENDERER(is_double, is_wavefront, has_bound)                                               \
    {                                                                                              \
        COMMON, .precision = PRECISION(is_double), .wavefront = (is_wavefront),                    \
                .first_hits = true, .needs = {                                                     \
                    .plane_bound = HD_CUDA_PTX_PLANES,                                             \
                    .depth_bound = HD_CUDA_PTX_DEPTH,                                              \
                    .node_stack_bound = HD_CUDA_PTX_NODE_STACK,                                    \
                    .refracts = true,                                                              \
                    .lit_from_behind = true,                                                       \
                    .many_lights = true,                                                           \
                    .cut_outs = true,                                                              \
                    .environment = true,                                                           \
                    .bounded = (has_bound)                                                         \
                }                                                                                  \
    }
#define PRECISION(is_double) ((is_double) ? HD_PRECISION_DOUBLE : HD_PRECISION_FLOAT)

static const HdKernelShape shapes[] = {
    PROBE(false),
    PROBE(true),
    RENDERER(false, false, false),
    RENDERER(false, false, true),
    RENDERER(false, true, false),
    RENDERER(false, true, true),
    RENDERER(true, false, false),
    RENDERER(true, false, true),
    RENDERER(true, true, false),
    RENDERER(true, true, true),
};
enum { SHAPES = sizeof shapes / sizeof *shapes };

static void write_bytes(FILE *file, int index, const HdCudaCode *code) {
    enum { PER_LINE = 32 };
    fprintf(file, "static const unsigned char text_%d[] = {", index);
    for (size_t i = 0; i < code->size; i++)
        fprintf(file, "%s%d,", i % PER_LINE == 0 ? "\n" : "", (unsigned char)code->image[i]);
    fprintf(file, "\n};\n");
}

/* Returns false if the shape does not compile. */
static bool write_text(FILE *file, int index, const HdNvrtc *nvrtc, HdError *error) {
    enum { OPTIONS_LENGTH = 1024 };
    char options[OPTIONS_LENGTH];
    const HdKernelShape *shape = &shapes[index];
    const HdCudaTarget target = hd_cuda_target(shape, HD_CUDA_PTX_ARCH);
    HdCudaCode code;
    hd_cuda_options(options, sizeof options, target, shape);
    if (hd_cuda_compile(&code, nvrtc, target, options, error) != HD_OK)
        return false;
    write_bytes(file, index, &code);
    hd_cuda_code_free(&code);
    return true;
}

static void write_table(FILE *file, int count, const HdNvrtc *nvrtc) {
    fprintf(file, "const HdCudaPtx hd_cuda_ptx[] = {\n");
    for (int i = 0; i < count; i++) {
        const HdKernelShape *shape = &shapes[i];
        fprintf(file,
                "    {.shape = {.is_probe = %d, .wavefront = %d, .first_hits = %d, .precision = "
                "(HdPrecision)%d, "
                ".math = (HdMath)%d, "
                ".group_size = %d, .ptx_arch = %d,\n"
                "               .needs = {.plane_bound = %d, .depth_bound = %d, "
                ".node_stack_bound = %d, .bounded = %d}},\n"
                "     .maker = \"NVRTC %d.%d\", .text = text_%d, .size = sizeof text_%d},\n",
                shape->is_probe, shape->wavefront, shape->first_hits, (int)shape->precision,
                (int)shape->math, shape->group_size, shape->ptx_arch, shape->needs.plane_bound,
                shape->needs.depth_bound, shape->needs.node_stack_bound, shape->needs.bounded,
                nvrtc->major, nvrtc->minor, i, i);
    }
    fprintf(file, "%s};\nconst int hd_cuda_ptx_count = %d;\n", count > 0 ? "" : "    {.size = 0}\n",
            count);
}

static bool write_all(FILE *file, int count, const HdNvrtc *nvrtc, HdError *error) {
    fprintf(file, "/* Written by embed_ptx. */\n#include \"device/cuda/compile.h\"\n\n");
    for (int i = 0; i < count; i++)
        if (!write_text(file, i, nvrtc, error))
            return false;
    write_table(file, count, nvrtc);
    return true;
}

int main(int argc, char **argv) {
    static HdError error;
    HdNvrtc nvrtc = {0};
    int count = argc > 2 ? SHAPES : 0;
    if (argc < 2 || argc > 4) {
        fprintf(stderr, "usage: embed_ptx OUTPUT.c [NVRTC [COUNT]]\n");
        return 2;
    }
    if (argc > 3 && atoi(argv[3]) < count)
        count = atoi(argv[3]);
    if (count > 0 &&
        hd_nvrtc_open(&nvrtc, "the program", HD_CUDA_PTX_ARCH, 0, argv[2], &error) != HD_OK) {
        fprintf(stderr, "embed_ptx: no PTX is embedded: %s\n", error.message);
        count = 0;
    }
    FILE *file = fopen(argv[1], "w");
    bool good = file != NULL && write_all(file, count, &nvrtc, &error);
    if (file == NULL)
        perror(argv[1]);
    else if (!good)
        fprintf(stderr, "embed_ptx: %s\n", error.message);
    if (file != NULL && (fclose(file) != 0 || !good)) {
        remove(argv[1]);
        good = false;
    }
    return good ? 0 : 1;
}
