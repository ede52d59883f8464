/* SPDX-License-Identifier: MIT */
/* Stands in for NVRTC 12.8, or with FAKE_NVRTC_MAJOR=13 for 13.0, which supports nothing before
   sm_75. The system's compiler builds the text, with device.h before it, as a shared object that
   the fake driver runs. With FAKE_NVRTC_WRONG it computes wrongly. The folder FAKE_NVRTC_CACHE,
   which must exist, keeps earlier builds. */
#define _GNU_SOURCE /* posix_spawn_file_actions_addchdir_np */
#include <fcntl.h>
#include <inttypes.h>
#include <spawn.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/hash.h"
#include "device/cuda/api.h"

enum {
    OUT_OF_MEMORY = 1,
    INVALID_INPUT = 3,
    INVALID_PROGRAM = 4,
    INVALID_OPTION = 5,
    COMPILATION = 6,
    MAX_WORDS = 128,
    MAX_FOLDER = 4000,
    MAX_PATH = 4096,
    MAX_NAME = 32
};

static const int archs[] = {50, 52, 60, 61, 70, 75, 80, 90};
enum { ARCH_COUNT = sizeof archs / sizeof *archs, OLD_ARCHS = 5 };

typedef struct Text {
    char *data;
    size_t size;
} Text;

struct _nvrtcProgram {
    char *source;
    int arch;
    Text log, image;
};

/* The command line of a compiler. */
typedef struct Words {
    const char *word[MAX_WORDS];
    int count;
} Words;

extern char **environ;

const char *nvrtcGetErrorString(HdNvrtcResult code) {
    static const char *const names[] = {
        "NVRTC_SUCCESS",
        "NVRTC_ERROR_OUT_OF_MEMORY",
        "NVRTC_ERROR_PROGRAM_CREATION_FAILURE",
        "NVRTC_ERROR_INVALID_INPUT",
        "NVRTC_ERROR_INVALID_PROGRAM",
        "NVRTC_ERROR_INVALID_OPTION",
        "NVRTC_ERROR_COMPILATION",
    };
    return code < sizeof names / sizeof *names ? names[code] : "NVRTC_ERROR unknown";
}

static bool is_13(void) {
    const char *major = getenv("FAKE_NVRTC_MAJOR");
    return major != NULL && strcmp(major, "13") == 0;
}

HdNvrtcResult nvrtcVersion(int *major, int *minor) {
    *major = is_13() ? 13 : 12;
    *minor = is_13() ? 0 : 8;
    return 0;
}

HdNvrtcResult nvrtcGetNumSupportedArchs(int *count) {
    *count = is_13() ? ARCH_COUNT - OLD_ARCHS : ARCH_COUNT;
    return 0;
}

HdNvrtcResult nvrtcGetSupportedArchs(int *list) {
    if (is_13())
        memcpy(list, archs + OLD_ARCHS, sizeof archs - OLD_ARCHS * sizeof *archs);
    else
        memcpy(list, archs, sizeof archs);
    return 0;
}

HdNvrtcResult nvrtcCreateProgram(HdNvrtcProgram *program, const char *source, const char *name,
                                 int header_count, const char *const *headers,
                                 const char *const *header_names) {
    (void)name, (void)headers, (void)header_names;
    if (source == NULL || header_count != 0)
        return INVALID_INPUT;
    HdNvrtcProgram made = calloc(1, sizeof *made);
    char *copy = strdup(source);
    if (made == NULL || copy == NULL) {
        free(made);
        free(copy);
        return OUT_OF_MEMORY;
    }
    made->source = copy;
    *program = made;
    return 0;
}

HdNvrtcResult nvrtcDestroyProgram(HdNvrtcProgram *program) {
    if (*program == NULL)
        return INVALID_PROGRAM;
    free((*program)->source);
    free((*program)->log.data);
    free((*program)->image.data);
    free(*program);
    *program = NULL;
    return 0;
}

/* ---- options ---- */

static void add(Words *words, const char *word) {
    if (words->count < MAX_WORDS - 1)
        words->word[words->count++] = word;
}

/* A C++ compiler's equivalents of NVRTC's options, or of their beginnings; NULL: nothing, "": the
   same. */
static const struct {
    const char *option, *meaning;
} options_known[] = {
    {"-D", ""},
    {"--fmad=false", "-ffp-contract=off"},
    {"--use_fast_math", "-ffp-contract=fast"},
    {"--gpu-architecture=", NULL},
    {"--maxrregcount=", NULL},
    {"--prec-div=true", NULL},
    {"--prec-sqrt=true", NULL},
    {"--ftz=false", NULL},
    {"--ptxas-options=", NULL},
};

static bool add_option(Words *words, const char *option) {
    for (size_t i = 0; i < sizeof options_known / sizeof *options_known; i++) {
        const char *known = options_known[i].option, *meaning = options_known[i].meaning;
        if (strncmp(option, known, strlen(known)) != 0)
            continue;
        if (meaning != NULL)
            add(words, meaning[0] != '\0' ? meaning : option);
        return true;
    }
    return false;
}

/* Returns 61 for sm_61 and compute_61; 0 for neither. */
static int find_arch(const char *option) {
    int arch = 0;
    if (sscanf(option, "--gpu-architecture=sm_%d", &arch) != 1)
        (void)sscanf(option, "--gpu-architecture=compute_%d", &arch);
    return arch;
}

static bool is_known(int arch) {
    for (int i = is_13() ? OLD_ARCHS : 0; i < ARCH_COUNT; i++)
        if (archs[i] == arch)
            return true;
    return false;
}

/* ---- files ---- */

static bool read_file(const char *folder, const char *name, Text *text) {
    char path[MAX_PATH];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "rb");
    if (file == NULL)
        return false;
    fseek(file, 0, SEEK_END);
    long size = ftell(file);
    rewind(file);
    free(text->data);
    *text = (Text){.data = calloc((size_t)size + 1, 1), .size = (size_t)size};
    bool good = text->data != NULL && fread(text->data, 1, text->size, file) == text->size;
    fclose(file);
    return good;
}

static FILE *open_to_write(const char *folder, const char *name) {
    char path[MAX_PATH];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return fopen(path, "w");
}

static void remove_folder(const char *folder) {
    static const char *const names[] = {"kernels.cu", "kernels.cpp", "kernels.so", "log"};
    char path[MAX_PATH];
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        snprintf(path, sizeof path, "%s/%s", folder, names[i]);
        unlink(path);
    }
    rmdir(folder);
}

/* ---- compiling ---- */

/* Runs the compiler in the folder; its messages go to `log`. */
static bool run(const char *folder, Words *words) {
    posix_spawn_file_actions_t actions;
    pid_t child;
    int status = -1;
    words->word[words->count] = NULL;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addchdir_np(&actions, folder);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "log", O_WRONLY | O_CREAT | O_APPEND,
                                     0600);
    if (posix_spawnp(&child, words->word[0], &actions, NULL, (char *const *)words->word, environ) ==
        0)
        waitpid(child, &status, 0);
    posix_spawn_file_actions_destroy(&actions);
    return status == 0;
}

static bool expand(const char *folder, const char *source, Words words) {
    FILE *file = open_to_write(folder, "kernels.cu");
    if (file == NULL)
        return false;
    fputs(source, file);
    fclose(file);
    add(&words, "-E");
    add(&words, "-D__CUDACC_RTC__");
    add(&words, "kernels.cu");
    add(&words, "-o");
    add(&words, "kernels.cpp");
    return run(folder, &words);
}

/* Writes a FAKE_KERNEL for every __global__ void NAME( of the expanded text behind it. */
static bool describe_kernels(const char *folder) {
    static const char event[] = "__global__ void ";
    Text text = {0};
    bool good = read_file(folder, "kernels.cpp", &text);
    FILE *file = good ? open_to_write(folder, "kernels.cpp") : NULL;
    if (file != NULL) {
        fprintf(file, "%s\n", text.data);
        for (const char *at = text.data; (at = strstr(at, event)) != NULL;) {
            at += strlen(event);
            fprintf(file, "FAKE_KERNEL(%.*s)\n", (int)strcspn(at, " ("), at);
        }
        fclose(file);
    }
    free(text.data);
    return file != NULL;
}

/* ---- earlier builds ---- */

static uint64_t hash_file(uint64_t hash, const char *folder, const char *name) {
    Text text = {0};
    if (read_file(folder, name, &text))
        hash = hd_hash_bytes(hash, text.data, text.size);
    free(text.data);
    return hash;
}

/* Hashes all that the object depends on: text, device.h and its includes, command line,
   compiler. */
static uint64_t hash_build(const char *folder, const Words *words) {
    uint64_t hash = hash_file(HD_HASH_START, folder, "kernels.cpp");
    struct stat compiler;
    hash = hash_file(hash, FAKE_CUDA_FOLDER, "device.h");
    hash = hash_file(hash, FAKE_CUDA_FOLDER, "kernel.h");
    for (int i = 0; i < words->count; i++)
        hash = hd_hash_bytes(hash, words->word[i], strlen(words->word[i]) + 1);
    if (stat(FAKE_NVRTC_COMPILER, &compiler) == 0) {
        hash = hd_hash_bytes(hash, &compiler.st_size, sizeof compiler.st_size);
        hash = hd_hash_bytes(hash, &compiler.st_mtim, sizeof compiler.st_mtim);
    }
    return hash;
}

static bool name_kept(char name[MAX_NAME], const char *folder, const Words *words) {
    if (getenv("FAKE_NVRTC_CACHE") == NULL)
        return false;
    snprintf(name, MAX_NAME, "%016" PRIx64 ".so", hash_build(folder, words));
    return true;
}

/* Writes under another name first: a reader finds all or nothing. */
static void keep(const char *name, const Text *image) {
    const char *folder = getenv("FAKE_NVRTC_CACHE");
    char unfinished[MAX_PATH], path[MAX_PATH], own[MAX_NAME + 16];
    snprintf(own, sizeof own, "%s.%ld", name, (long)getpid());
    snprintf(unfinished, sizeof unfinished, "%s/%s", folder, own);
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = open_to_write(folder, own);
    if (file == NULL)
        return;
    bool good = fwrite(image->data, 1, image->size, file) == image->size;
    good = fclose(file) == 0 && good;
    if (!good || rename(unfinished, path) != 0)
        unlink(unfinished);
}

static bool build(const char *folder, Words words, Text *image) {
    static const char *const more[] = {"-std=c++17",
                                       "-O2",
                                       "-fPIC",
                                       "-shared",
                                       "-fno-math-errno",
                                       "-w",
                                       "-s",
                                       "-o",
                                       "kernels.so",
                                       "-include",
                                       FAKE_CUDA_FOLDER "/device.h",
                                       "kernels.cpp",
                                       "-lm"};
    for (size_t i = 0; i < sizeof more / sizeof *more; i++)
        add(&words, more[i]);
#ifdef __x86_64__
    if (__builtin_cpu_supports("fma"))
        add(&words, "-mfma");
#endif
    if (getenv("FAKE_NVRTC_WRONG") != NULL)
        add(&words, "-DFAKE_WRONG");
    char kept[MAX_NAME];
    bool is_kept = name_kept(kept, folder, &words);
    if (is_kept && read_file(getenv("FAKE_NVRTC_CACHE"), kept, image))
        return true;
    if (!run(folder, &words) || !read_file(folder, "kernels.so", image))
        return false;
    if (is_kept)
        keep(kept, image);
    return true;
}

HdNvrtcResult nvrtcCompileProgram(HdNvrtcProgram program, int option_count,
                                  const char *const *options) {
    const char *where = getenv("TMPDIR");
    char folder[MAX_FOLDER];
    Words words = {.word = {FAKE_NVRTC_COMPILER, "-x", "c++"}, .count = 3};
    for (int i = 0; i < option_count; i++) {
        if (!add_option(&words, options[i]))
            return INVALID_OPTION;
        int arch = find_arch(options[i]);
        program->arch = arch > 0 ? arch : program->arch;
    }
    if (!is_known(program->arch))
        return INVALID_OPTION;
    snprintf(folder, sizeof folder, "%s/fake_nvrtc_XXXXXX", where != NULL ? where : "/tmp");
    if (mkdtemp(folder) == NULL)
        return OUT_OF_MEMORY;
    bool good = expand(folder, program->source, words) && describe_kernels(folder) &&
                build(folder, words, &program->image);
    read_file(folder, "log", &program->log);
    remove_folder(folder);
    return good ? 0 : COMPILATION;
}

/* ---- results ---- */

HdNvrtcResult nvrtcGetProgramLogSize(HdNvrtcProgram program, size_t *size) {
    *size = program->log.size + 1;
    return 0;
}

HdNvrtcResult nvrtcGetProgramLog(HdNvrtcProgram program, char *log) {
    memcpy(log, program->log.data != NULL ? program->log.data : "", program->log.size + 1);
    return 0;
}

enum { HEAD_SIZE = 64 };

/* Returns the size of PTX, with its NUL. */
static size_t write_head(HdNvrtcProgram program, char head[HEAD_SIZE]) {
    return (size_t)snprintf(head, HEAD_SIZE, ".version 8.7\n.target sm_%d\n", program->arch) + 1;
}

/* Returns the size of machine code. */
static size_t write_tail(HdNvrtcProgram program, char tail[HEAD_SIZE]) {
    return (size_t)snprintf(tail, HEAD_SIZE, "sm_%d", program->arch) + 1;
}

static HdNvrtcResult report_size(HdNvrtcProgram program, size_t more, size_t *size) {
    *size = program->image.size + more;
    return program->image.size > 0 ? 0 : INVALID_PROGRAM;
}

HdNvrtcResult nvrtcGetCUBINSize(HdNvrtcProgram program, size_t *size) {
    char tail[HEAD_SIZE];
    return report_size(program, write_tail(program, tail), size);
}

HdNvrtcResult nvrtcGetCUBIN(HdNvrtcProgram program, char *cubin) {
    char tail[HEAD_SIZE];
    size_t length = write_tail(program, tail);
    memcpy(cubin, program->image.data, program->image.size);
    memcpy(cubin + program->image.size, tail, length);
    return 0;
}

HdNvrtcResult nvrtcGetPTXSize(HdNvrtcProgram program, size_t *size) {
    char head[HEAD_SIZE];
    return report_size(program, write_head(program, head), size);
}

HdNvrtcResult nvrtcGetPTX(HdNvrtcProgram program, char *ptx) {
    char head[HEAD_SIZE];
    size_t length = write_head(program, head);
    memcpy(ptx, head, length);
    memcpy(ptx + length, program->image.data, program->image.size);
    return 0;
}
