/* SPDX-License-Identifier: MIT */
/* Compiles the kernels for an NVIDIA architecture, without a device, and prints the
   resources that they need:

       cuda_compile --arch N [--nvrtc LIBRARY] [--double] [--fast] [--wavefront] [--refracts]
                    [--lit-from-behind] [--many-lights] [--meshes] [--bounded] [--cut-outs]
                    [--environment] [--block N] [--registers N]

   Exit codes: 0 they compile and save no convergence barrier to a register (docs/lost-light.md),
   1 otherwise, 77 no NVRTC here supports the architecture. */
#include <elf.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "device/cuda/compile.h"

enum { SKIPPED = 77, USAGE = 2 };

typedef struct Options {
    int arch;
    int registers; /* 0: the default */
    const char *nvrtc;
    HdKernelShape shape;
} Options;

static bool parse(Options *options, int argc, char **argv) {
    /* Three solids, a floor, and the depth of the default scene. */
    *options = (Options){
        .shape = {.lanes = 1,
                  .pixels_per_item = 1,
                  .group_size = 128,
                  .needs = {.plane_bound = 32, .depth_bound = 16, .small_tables = true}},
    };
    HdKernelShape *shape = &options->shape;
    const struct {
        const char *name;
        bool *flag;
    } flags[] = {{"--wavefront", &shape->wavefront},
                 {"--refracts", &shape->needs.refracts},
                 {"--lit-from-behind", &shape->needs.lit_from_behind},
                 {"--many-lights", &shape->needs.many_lights},
                 {"--bounded", &shape->needs.bounded},
                 {"--cut-outs", &shape->needs.cut_outs},
                 {"--environment", &shape->needs.environment}};
    const struct {
        const char *name;
        int *number;
    } numbers[] = {{"--arch", &options->arch},
                   {"--block", &shape->group_size},
                   {"--registers", &options->registers}};
    for (int i = 1; i < argc; i++) {
        bool is_known = true;
        if (strcmp(argv[i], "--double") == 0)
            shape->precision = HD_PRECISION_DOUBLE;
        else if (strcmp(argv[i], "--fast") == 0)
            shape->math = HD_MATH_FAST;
        else if (strcmp(argv[i], "--meshes") == 0)
            shape->needs.node_stack_bound = 32;
        else if (strcmp(argv[i], "--nvrtc") == 0 && i + 1 < argc)
            options->nvrtc = argv[++i];
        else
            is_known = false;
        for (int k = 0; !is_known && k < (int)(sizeof flags / sizeof *flags); k++)
            if (strcmp(argv[i], flags[k].name) == 0)
                is_known = *flags[k].flag = true;
        for (int k = 0; !is_known && k < 3; k++)
            if (strcmp(argv[i], numbers[k].name) == 0 && i + 1 < argc) {
                *numbers[k].number = atoi(argv[++i]);
                is_known = true;
            }
        if (!is_known)
            return false;
    }
    shape->register_limit = hd_register_limit(shape, options->arch, options->registers);
    return options->arch > 0;
}

/* Finds a kernel's use in the assembler's report, in the lines after "Compiling entry function
   'X'": registers, bytes of stack frame, of spill stores and of spill loads. */
static bool find_usage(const char *log, const char *kernel, int usage[4]) {
    char heading[80];
    snprintf(heading, sizeof heading, "entry function '%s'", kernel);
    const char *at = strstr(log, heading);
    const char *stack = at != NULL ? strstr(at, "bytes stack frame") : NULL;
    const char *used = at != NULL ? strstr(at, "Used ") : NULL;
    if (stack == NULL || used == NULL)
        return false;
    while (strchr(" 0123456789", stack[-1]) != NULL)
        stack--;
    return sscanf(used, "Used %d registers", &usage[0]) == 1 &&
           sscanf(stack, " %d bytes stack frame, %d bytes spill stores, %d bytes spill loads",
                  &usage[1], &usage[2], &usage[3]) == 3;
}

static bool report(const Options *options, const HdNvrtc *nvrtc, const HdCudaCode *code) {
    printf("NVRTC %d.%d, sm_%d, %s, %d planes, depth %d: %zu bytes of machine code\n", nvrtc->major,
           nvrtc->minor, options->arch,
           options->shape.precision == HD_PRECISION_DOUBLE ? "double" : "float",
           options->shape.needs.plane_bound, options->shape.needs.depth_bound, code->size);
    bool complete = true;
    for (int i = 0; i < HD_KERNEL_COUNT; i++) {
        const char *kernel = hd_kernel_name(&options->shape, (HdKernel)i);
        if (kernel == NULL)
            continue;
        int usage[4] = {-1, -1, -1, -1};
        complete = find_usage(code->log, kernel, usage) && complete;
        printf("%s: %d registers, %d bytes of stack, spills of %d bytes stored and %d loaded\n",
               kernel, usage[0], usage[1], usage[2], usage[3]);
    }
    if (!complete)
        fprintf(stderr, "cuda_compile: the assembler's report is not as expected:\n%s\n",
                code->log);
    return complete;
}

/* ---- convergence barriers of sm_70 and newer, in the machine code ---- */

enum { INSTRUCTION_BYTES = 16, OPCODE_MASK = 0xfff, OPEN_BARRIER = 0x945, SAVE_BARRIER = 0x355 };
enum { NO_REGISTER = 0xff, BARRIER_REGISTERS = 16 };

/* Bits 16 to 23 name an instruction's target: of BSSY a barrier, of BMOV a register. */
static bool check_barriers(const HdCudaCode *code) {
    const unsigned char *image = (const unsigned char *)code->image;
    bool is_used[BARRIER_REGISTERS] = {false};
    int used = 0, saved = 0;
    Elf64_Ehdr header;
    memcpy(&header, image, sizeof header);
    for (int i = 0; i < header.e_shnum; i++) {
        Elf64_Shdr section;
        memcpy(&section, image + header.e_shoff + (size_t)i * sizeof section, sizeof section);
        const bool is_code =
            section.sh_type == SHT_PROGBITS && (section.sh_flags & SHF_EXECINSTR) != 0;
        for (size_t at = 0; is_code && at + INSTRUCTION_BYTES <= section.sh_size;
             at += INSTRUCTION_BYTES) {
            uint32_t word;
            memcpy(&word, image + section.sh_offset + at, sizeof word);
            const unsigned int opcode = word & OPCODE_MASK, target = word >> 16 & 0xff;
            if (opcode == OPEN_BARRIER && !is_used[target % BARRIER_REGISTERS]) {
                is_used[target % BARRIER_REGISTERS] = true;
                used++;
            }
            saved += opcode == SAVE_BARRIER && target != NO_REGISTER;
        }
    }
    printf("%d convergence barriers, %d saved to registers\n", used, saved);
    if (used == 0)
        fprintf(stderr, "cuda_compile: the machine code has no convergence barriers, so their "
                        "instructions are not known here\n");
    if (saved > 0)
        fprintf(stderr, "cuda_compile: branches and loops are too deep within each other; see "
                        "docs/lost-light.md\n");
    return used > 0 && saved == 0;
}

int main(int argc, char **argv) {
    static HdError error;
    Options options;
    if (!parse(&options, argc, argv)) {
        fprintf(stderr, "cuda_compile: called wrongly; see the head of tests/cuda_compile.c\n");
        return USAGE;
    }
    HdNvrtc nvrtc;
    if (hd_nvrtc_open(&nvrtc, "this test", options.arch, 0, options.nvrtc, &error) != HD_OK) {
        printf("skipped: %s\n", error.message);
        return SKIPPED;
    }
    HdCudaCode code;
    const HdCudaTarget target = {.arch = options.arch};
    char flags[1024];
    hd_cuda_options(flags, sizeof flags, target, &options.shape);
    size_t length = strlen(flags); /* the log must have each kernel's registers and spills */
    snprintf(flags + length, sizeof flags - length, " --ptxas-options=-v");
    bool ok = hd_cuda_compile(&code, &nvrtc, target, flags, &error) == HD_OK;
    if (!ok) {
        fprintf(stderr, "%s\n", error.message);
    } else {
        ok = report(&options, &nvrtc, &code);
        if (options.arch >= 70)
            ok = check_barriers(&code) && ok;
        hd_cuda_code_free(&code);
    }
    hd_nvrtc_close(&nvrtc);
    return ok ? 0 : 1;
}
