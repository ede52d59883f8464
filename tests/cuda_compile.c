/* SPDX-License-Identifier: MIT */
/* Compiles the kernels for an NVIDIA architecture, without a device, and tells what they need of
   it:

       cuda_compile --arch 61 [--nvrtc LIBRARY] [--double] [--fast] [--wavefront] [--refracts]
                    [--lit-from-behind] [--many-lights] [--meshes] [--surveyed] [--block N]
                    [--planes N] [--depth N] [--log] [--cubin FILE]

   Exits 0 when they compile and no convergence barrier is saved to a register (docs/lost-light.md),
   1 otherwise, 77 when no NVRTC here knows the architecture. */
#include <elf.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "device/cuda/compile.h"

enum { SKIPPED = 77, USAGE = 2 };

typedef struct Options {
    int arch;
    int registers; /* 0: as many as suit */
    const char *nvrtc, *cubin;
    bool show_log;
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
    for (int i = 1; i < argc; i++) {
        const char *value = i + 1 < argc ? argv[i + 1] : NULL;
        if (strcmp(argv[i], "--double") == 0)
            options->shape.precision = HD_PRECISION_DOUBLE;
        else if (strcmp(argv[i], "--fast") == 0)
            options->shape.math = HD_MATH_FAST;
        else if (strcmp(argv[i], "--wavefront") == 0)
            options->shape.wavefront = true;
        else if (strcmp(argv[i], "--refracts") == 0)
            options->shape.needs.refracts = true;
        else if (strcmp(argv[i], "--lit-from-behind") == 0)
            options->shape.needs.lit_from_behind = true;
        else if (strcmp(argv[i], "--many-lights") == 0)
            options->shape.needs.many_lights = true;
        else if (strcmp(argv[i], "--surveyed") == 0)
            options->shape.needs.surveyed = true;
        else if (strcmp(argv[i], "--meshes") == 0)
            options->shape.needs.node_stack_bound = 32;
        else if (strcmp(argv[i], "--log") == 0)
            options->show_log = true;
        else if (!value)
            return false;
        else if (strcmp(argv[i], "--arch") == 0)
            options->arch = atoi(argv[++i]);
        else if (strcmp(argv[i], "--nvrtc") == 0)
            options->nvrtc = argv[++i];
        else if (strcmp(argv[i], "--block") == 0)
            options->shape.group_size = atoi(argv[++i]);
        else if (strcmp(argv[i], "--registers") == 0)
            options->registers = atoi(argv[++i]);
        else if (strcmp(argv[i], "--planes") == 0)
            options->shape.needs.plane_bound = hd_kernel_bound(atoi(argv[++i]));
        else if (strcmp(argv[i], "--depth") == 0)
            options->shape.needs.depth_bound = hd_kernel_bound(atoi(argv[++i]));
        else if (strcmp(argv[i], "--cubin") == 0)
            options->cubin = argv[++i];
        else
            return false;
    }
    options->shape.register_limit =
        hd_register_limit(&options->shape, options->arch, options->registers);
    return options->arch > 0;
}

/* The number before `unit` in a line of the assembler's report; -1: there is none. */
static int number_before(const char *line, const char *end, const char *unit) {
    const char *at = strstr(line, unit);
    if (!at || at >= end)
        return -1;
    while (at > line && at[-1] == ' ')
        at--;
    const char *digits = at;
    while (digits > line && digits[-1] >= '0' && digits[-1] <= '9')
        digits--;
    return digits < at ? atoi(digits) : -1;
}

typedef struct Usage {
    int registers, stack, spill_stores, spill_loads;
} Usage;

/* The report names a kernel ("Compiling entry function 'X'"), then tells what it uses. */
static Usage kernel_usage(const char *log, const char *kernel) {
    Usage usage = {-1, -1, -1, -1};
    char heading[80];
    snprintf(heading, sizeof heading, "entry function '%s'", kernel);
    const char *line = strstr(log, heading);
    for (int i = 0; line && i < 6; i++) {
        const char *end = strchr(line, '\n');
        if (!end)
            end = line + strlen(line);
        if (i > 0 && strstr(line, "entry function") && strstr(line, "entry function") < end)
            break;
        int *const values[] = {&usage.registers, &usage.stack, &usage.spill_stores,
                               &usage.spill_loads};
        static const char *const units[] = {" registers", " bytes stack frame",
                                            " bytes spill stores", " bytes spill loads"};
        for (int k = 0; k < 4; k++)
            if (*values[k] < 0)
                *values[k] = number_before(line, end, units[k]);
        line = *end ? end + 1 : NULL;
    }
    return usage;
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
        Usage usage = kernel_usage(code->log, kernel);
        printf("%s: %d registers, %d bytes of stack, spills of %d bytes stored and %d loaded\n",
               kernel, usage.registers, usage.stack, usage.spill_stores, usage.spill_loads);
        complete = complete && usage.registers >= 0 && usage.stack >= 0;
    }
    if (!complete)
        fprintf(stderr, "cuda_compile: the assembler's report is not as expected:\n%s\n",
                code->log);
    if (options->show_log)
        printf("%s\n", code->log);
    return complete;
}

/* ---- convergence barriers of sm_70 and newer, in the machine code ---- */

enum { INSTRUCTION_BYTES = 16, OPCODE_MASK = 0xfff, OPEN_BARRIER = 0x945, SAVE_BARRIER = 0x355 };
enum { NO_REGISTER = 0xff, BARRIER_REGISTERS = 16 };

typedef struct Barriers {
    bool used[BARRIER_REGISTERS];
    int saved;
} Barriers;

/* Bits 16 to 23 name what an instruction writes: of BSSY a barrier, of BMOV a register. */
static void count_barriers(Barriers *barriers, const unsigned char *text, size_t size) {
    for (size_t at = 0; at + INSTRUCTION_BYTES <= size; at += INSTRUCTION_BYTES) {
        uint32_t word;
        memcpy(&word, text + at, sizeof word);
        unsigned int opcode = word & OPCODE_MASK, target = word >> 16 & 0xff;
        if (opcode == OPEN_BARRIER)
            barriers->used[target % BARRIER_REGISTERS] = true;
        barriers->saved += opcode == SAVE_BARRIER && target != NO_REGISTER;
    }
}

static Barriers barriers_of(const HdCudaCode *code) {
    const unsigned char *image = (const unsigned char *)code->image;
    Barriers barriers = {0};
    Elf64_Ehdr header;
    memcpy(&header, image, sizeof header);
    for (int i = 0; i < header.e_shnum; i++) {
        Elf64_Shdr section;
        memcpy(&section, image + header.e_shoff + (size_t)i * sizeof section, sizeof section);
        if (section.sh_type == SHT_PROGBITS && (section.sh_flags & SHF_EXECINSTR) != 0)
            count_barriers(&barriers, image + section.sh_offset, section.sh_size);
    }
    return barriers;
}

static bool check_barriers(const HdCudaCode *code) {
    Barriers barriers = barriers_of(code);
    int used = 0;
    for (int i = 0; i < BARRIER_REGISTERS; i++)
        used += barriers.used[i];
    printf("%d convergence barriers, %d saved to registers\n", used, barriers.saved);
    if (used == 0)
        fprintf(stderr, "cuda_compile: the machine code has no convergence barriers, so their "
                        "instructions are not known here\n");
    if (barriers.saved > 0)
        fprintf(stderr, "cuda_compile: branches and loops are too deep within each other; see "
                        "docs/lost-light.md\n");
    return used > 0 && barriers.saved == 0;
}

static bool write_cubin(const char *path, const HdCudaCode *code) {
    FILE *file = fopen(path, "wb");
    bool ok = file && fwrite(code->image, 1, code->size, file) == code->size;
    if (file && fclose(file) != 0)
        ok = false;
    if (!ok)
        fprintf(stderr, "cuda_compile: cannot write %s\n", path);
    return ok;
}

int main(int argc, char **argv) {
    static HdError error;
    Options options;
    if (!parse(&options, argc, argv)) {
        fprintf(stderr, "usage: cuda_compile --arch N [--nvrtc LIBRARY] [--double] [--fast] "
                        "[--wavefront] [--refracts] [--lit-from-behind] [--many-lights] [--meshes] "
                        "[--surveyed] [--block N] [--registers N] [--planes N] [--depth N] [--log] "
                        "[--cubin FILE]\n");
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
    size_t length = strlen(flags); /* the log is to tell each kernel's registers and spills */
    snprintf(flags + length, sizeof flags - length, " --ptxas-options=-v");
    bool ok = hd_cuda_compile(&code, &nvrtc, target, flags, &error) == HD_OK;
    if (!ok) {
        fprintf(stderr, "%s\n", error.message);
    } else {
        ok = report(&options, &nvrtc, &code);
        if (options.arch >= 70)
            ok = check_barriers(&code) && ok;
        if (options.cubin)
            ok = write_cubin(options.cubin, &code) && ok;
        hd_cuda_code_free(&code);
    }
    hd_nvrtc_close(&nvrtc);
    return ok ? 0 : 1;
}
