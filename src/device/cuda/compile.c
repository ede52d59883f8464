/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "device/cuda/compile.h"

#include <glob.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/text.h"
#include "system/cache_folder.h"
#include "system/dynamic_library.h"
#include "system/path.h"

/* ---- the library ---- */

enum { MAX_ARCHS = 256 };

/* Virtual environment below the home folder that messages advise: many systems do not let users
   install into the system's Python. */
#define HD_NVRTC_VENV ".local/share/hedron"

typedef struct Search {
    int arch, driver_major;
    bool has_best;
    HdNvrtc best;
    char found[512]; /* libraries that do not fit, for people */
} Search;

static bool load(HdNvrtc *nvrtc, const char *path) {
    static const HdLibrarySymbol symbols[] = {
#define SYMBOL(type, member, symbol, parameters) {#symbol, offsetof(HdNvrtcFunctions, member)},
        HD_NVRTC_FUNCTIONS(SYMBOL)
#undef SYMBOL
    };
    *nvrtc = (HdNvrtc){.library = hd_library_open(path)};
    if (nvrtc->library &&
        hd_library_load(nvrtc->library, symbols, sizeof symbols / sizeof *symbols,
                        &nvrtc->functions) == NULL &&
        nvrtc->functions.version(&nvrtc->major, &nvrtc->minor) == 0)
        return true;
    hd_nvrtc_close(nvrtc);
    return false;
}

/* Fills the architectures, in ascending order, and returns their number. */
static int list_archs(const HdNvrtc *nvrtc, int archs[MAX_ARCHS]) {
    int count = 0;
    if (nvrtc->functions.arch_count(&count) != 0 || count < 1 || count > MAX_ARCHS)
        return 0;
    return nvrtc->functions.list_archs(archs) == 0 ? count : 0;
}

static bool is_better(const Search *search, const HdNvrtc *nvrtc) {
    const HdNvrtc *best = &search->best;
    int limit = search->driver_major;
    bool fits = limit == 0 || nvrtc->major <= limit;
    bool best_fits = limit == 0 || best->major <= limit;
    if (!search->has_best || fits != best_fits)
        return !search->has_best || fits;
    return nvrtc->major != best->major ? nvrtc->major > best->major : nvrtc->minor > best->minor;
}

static void consider(Search *search, const char *path) {
    HdNvrtc nvrtc;
    if (!load(&nvrtc, path))
        return;
    int archs[MAX_ARCHS];
    int count = list_archs(&nvrtc, archs), place = 0;
    while (place < count && archs[place] != search->arch)
        place++;
    if (place == count) {
        char text[64];
        snprintf(text, sizeof text, "NVRTC %d.%d for sm_%d to sm_%d", nvrtc.major, nvrtc.minor,
                 count ? archs[0] : 0, count ? archs[count - 1] : 0);
        if (!strstr(search->found, text))
            hd_add_text(search->found, sizeof search->found, ", ", "%s", text);
    } else if (is_better(search, &nvrtc)) {
        HdNvrtc worse = search->best;
        search->best = nvrtc;
        nvrtc = worse;
        search->has_best = true;
    }
    hd_nvrtc_close(&nvrtc);
}

/* `folder` may be NULL or empty: nothing is found below it. */
static void consider_below(Search *search, const char *folder, const char *pattern) {
    char path[HD_MAX_PATH];
    glob_t paths;
    if (!folder || !folder[0])
        return;
    int length = snprintf(path, sizeof path, "%s/%s", folder, pattern);
    if (length < 0 || length >= HD_MAX_PATH)
        return;
    if (glob(path, 0, NULL, &paths) == 0)
        for (size_t i = 0; i < paths.gl_pathc; i++)
            consider(search, paths.gl_pathv[i]);
    globfree(&paths);
}

#define PYTHON_PACKAGES "lib/python3*/*-packages/nvidia/*/lib/libnvrtc.so*"

static void search_everywhere(Search *search) {
    static const char *const names[] = {"libnvrtc.so.13", "libnvrtc.so.12", "libnvrtc.so.11.2",
                                        "libnvrtc.so"};
    char build[HD_MAX_PATH]; /* folder of the program */
    const char *home = getenv("HOME"), *conda = getenv("CONDA_PREFIX");
    const char *program = hd_path_of_program(build) ? build : NULL;
    const struct {
        const char *folder, *pattern;
    } below[] = {
        {"/usr/local", "cuda*/lib64/libnvrtc.so*"},
        {"/usr/local", PYTHON_PACKAGES},
        {"/usr", PYTHON_PACKAGES},
        {getenv("CUDA_HOME"), "lib64/libnvrtc.so*"},
        {getenv("CUDA_PATH"), "lib64/libnvrtc.so*"},
        {home, HD_NVRTC_VENV "/" PYTHON_PACKAGES},
        {home, ".local/" PYTHON_PACKAGES},
        {getenv("VIRTUAL_ENV"), PYTHON_PACKAGES},
        {conda, "lib/libnvrtc.so*"},
        {conda, PYTHON_PACKAGES},
        /* The place that ./dev installs to, seen from the build folder or one below it. */
        {program, "../nvrtc12/nvidia/*/lib/libnvrtc.so*"},
        {program, "../../nvrtc12/nvidia/*/lib/libnvrtc.so*"},
    };
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        consider(search, names[i]);
    for (size_t i = 0; i < sizeof below / sizeof *below; i++)
        consider_below(search, below[i].folder, below[i].pattern);
}

/* NVRTC 11 is the last for cards before sm_50, NVRTC 12 for those before sm_75. */
const char *hd_nvrtc_package(int arch, int driver_major) {
    if (arch < 50 || driver_major == 11)
        return "nvidia-cuda-nvrtc-cu11";
    if (arch < 75 || driver_major == 12)
        return "nvidia-cuda-nvrtc-cu12";
    return "nvidia-cuda-nvrtc";
}

/* Returns advice on the newest driver branch for the architecture. */
static const char *advise_driver(int arch) {
    if (arch < 50)
        return "; the driver's branch 470 is the last for this card";
    return arch < 75 ? "; the driver's branch 580 is the last for this card" : "";
}

static HdStatus fail_to_find(const Search *search, const char *device, const char *path,
                             HdError *error) {
    if (path && !search->found[0])
        return hd_fail(error, HD_UNAVAILABLE,
                       "%s cannot be loaded as an NVRTC library, version 11.2 or newer", path);
    return hd_fail(error, HD_UNAVAILABLE,
                   "no NVRTC library here compiles for %s (sm_%d); to install one that does: "
                   "python3 -m venv ~/" HD_NVRTC_VENV " && ~/" HD_NVRTC_VENV
                   "/bin/pip install %s, or name a libnvrtc.so in HEDRON_NVRTC%s; found: %s",
                   device, search->arch, hd_nvrtc_package(search->arch, search->driver_major),
                   advise_driver(search->arch), search->found[0] ? search->found : "none");
}

static bool is_off(const char *named) {
    return named != NULL && strcmp(named, "off") == 0;
}

bool hd_nvrtc_is_named(void) {
    const char *named = getenv("HEDRON_NVRTC");
    return named != NULL && named[0] != '\0' && !is_off(named);
}

HdStatus hd_nvrtc_open(HdNvrtc *nvrtc, const char *device, int arch, int driver_major,
                       const char *path, HdError *error) {
    char builtins[64];
    Search search = {.arch = arch, .driver_major = driver_major};
    const char *named = path ? path : hd_nvrtc_is_named() ? getenv("HEDRON_NVRTC") : NULL;
    if (named)
        consider(&search, named);
    else if (!is_off(getenv("HEDRON_NVRTC")))
        search_everywhere(&search);
    if (!search.has_best)
        return fail_to_find(&search, device, named, error);
    *nvrtc = search.best;
    /* NVRTC opens its helper by name and expects the loader to search NVRTC's own folder, which
       fails under a sanitizer. The loader finds a library that is loaded already. */
    snprintf(builtins, sizeof builtins, "libnvrtc-builtins.so.%d.%d", nvrtc->major, nvrtc->minor);
    hd_library_close(hd_library_open_adjacent(nvrtc->library, "nvrtcVersion", builtins));
    return HD_OK;
}

void hd_nvrtc_close(HdNvrtc *nvrtc) {
    hd_library_close(nvrtc->library);
    *nvrtc = (HdNvrtc){0};
}

/* ---- remembered libraries ---- */

enum { RECORD_KEY_LENGTH = HD_MAX_PATH + 128, RECORD_LENGTH = HD_MAX_PATH + 64 };

static const char record_kind[] = "nvrtc";

static void write_key(char key[RECORD_KEY_LENGTH], int arch, int driver_major) {
    const char *named = getenv("HEDRON_NVRTC");
    snprintf(key, RECORD_KEY_LENGTH, "hedron %s\nsm_%d, driver for CUDA %d\nHEDRON_NVRTC %.*s\n",
             HD_VERSION, arch, driver_major, HD_MAX_PATH, named != NULL ? named : "");
}

/* Size and time reveal a library that another one replaced. */
static bool write_record(char record[RECORD_LENGTH], const char *library) {
    struct stat found;
    if (library[0] != '/' || stat(library, &found) != 0 || !S_ISREG(found.st_mode))
        return false;
    int length = snprintf(record, RECORD_LENGTH, "%lld %lld %s", (long long)found.st_size,
                          (long long)found.st_mtime, library);
    return length < RECORD_LENGTH;
}

static bool is_remembered(int arch, int driver_major) {
    char key[RECORD_KEY_LENGTH], stored[RECORD_LENGTH], present[RECORD_LENGTH];
    HdError ignored;
    write_key(key, arch, driver_major);
    if (hd_cache_get_text(record_kind, key, stored, sizeof stored, &ignored) != HD_OK)
        return false;
    const char *library = strchr(stored, '/');
    return library != NULL && write_record(present, library) && strcmp(stored, present) == 0;
}

void hd_nvrtc_remember(const char *library, int arch, int driver_major) {
    char key[RECORD_KEY_LENGTH], record[RECORD_LENGTH];
    HdError ignored; /* the library is loaded again next time */
    write_key(key, arch, driver_major);
    if (write_record(record, library))
        hd_cache_put_text(record_kind, key, record, &ignored);
}

HdStatus hd_nvrtc_check(const char *device, int arch, int driver_major, HdError *error) {
    HdNvrtc nvrtc = {0};
    char library[HD_MAX_PATH];
    if (is_remembered(arch, driver_major))
        return HD_OK;
    HD_TRY(hd_nvrtc_open(&nvrtc, device, arch, driver_major, NULL, error));
    if (hd_library_path(nvrtc.library, "nvrtcVersion", library, sizeof library))
        hd_nvrtc_remember(library, arch, driver_major);
    hd_nvrtc_close(&nvrtc);
    return HD_OK;
}

/* ---- compilation ---- */

enum { MAX_PARTS = 48, MAX_TEXT = 1024 };

static HdStatus fail_by_code(const HdNvrtc *nvrtc, const char *function, HdNvrtcResult code,
                             HdError *error) {
    return hd_fail(error, HD_FAILED, "%s failed with %s", function,
                   nvrtc->functions.error_string(code));
}

/* A larger claimed size is an error of the compiler. */
enum { MAX_LOG_BYTES = 1 << 26 };

/* Returns the log, "" if there is none, or NULL when out of memory. */
static char *copy_log(const HdNvrtc *nvrtc, HdNvrtcProgram program) {
    size_t size = 0;
    if (nvrtc->functions.log_size(program, &size) != 0 || size > MAX_LOG_BYTES)
        size = 0;
    char *log = calloc(size + 1, 1);
    if (log && size > 0)
        nvrtc->functions.log(program, log);
    return log;
}

static HdStatus copy_image(HdCudaCode *code, const HdNvrtc *nvrtc, HdNvrtcProgram program,
                           HdCudaTarget target, HdError *error) {
    const HdNvrtcFunctions *functions = &nvrtc->functions;
    HdNvrtcResult result = target.is_ptx ? functions->ptx_size(program, &code->size)
                                         : functions->cubin_size(program, &code->size);
    if (result != 0 || code->size == 0)
        return fail_by_code(nvrtc, target.is_ptx ? "nvrtcGetPTXSize" : "nvrtcGetCUBINSize", result,
                            error);
    code->image = malloc(code->size);
    code->log = copy_log(nvrtc, program);
    if (!code->image || !code->log)
        return HD_NO_ROOM(error, "compiled kernels");
    result = target.is_ptx ? functions->ptx(program, code->image)
                           : functions->cubin(program, code->image);
    return result == 0 ? HD_OK
                       : fail_by_code(nvrtc, target.is_ptx ? "nvrtcGetPTX" : "nvrtcGetCUBIN",
                                      result, error);
}

static const char *prefix_of(HdCudaTarget target) {
    return target.is_ptx ? "compute" : "sm";
}

static HdStatus fail_with_log(const HdNvrtc *nvrtc, HdNvrtcProgram program, HdCudaTarget target,
                              HdNvrtcResult result, HdError *error) {
    char *log = copy_log(nvrtc, program);
    hd_fail(error, HD_FAILED, "NVRTC %d.%d refused the kernels for %s_%d (%s):\n%s", nvrtc->major,
            nvrtc->minor, prefix_of(target), target.arch, nvrtc->functions.error_string(result),
            log && log[0] ? log : "(no log)");
    free(log);
    return HD_FAILED;
}

HdCudaTarget hd_cuda_target(const HdKernelShape *shape, int arch) {
    bool is_ptx = shape->ptx_arch > 0;
    return (HdCudaTarget){.arch = is_ptx ? shape->ptx_arch : arch, .is_ptx = is_ptx};
}

void hd_cuda_options(char *options, size_t capacity, HdCudaTarget target,
                     const HdKernelShape *shape) {
    static const char strict[] = "--fmad=false --prec-div=true --prec-sqrt=true --ftz=false";
    char defines[HD_KERNEL_DEFINES_SIZE];
    hd_kernel_defines(shape, defines);
    snprintf(options, capacity, "--gpu-architecture=%s_%d --maxrregcount=%d %s%s",
             prefix_of(target), target.arch, shape->register_limit,
             shape->math == HD_MATH_FAST ? "--use_fast_math" : strict, defines);
}

/* Cuts the text at its spaces and returns the number of parts. */
static int split(char *text, const char *parts[MAX_PARTS]) {
    int count = 0;
    char *rest = NULL;
    for (char *part = strtok_r(text, " ", &rest); part != NULL && count < MAX_PARTS;
         part = strtok_r(NULL, " ", &rest))
        parts[count++] = part;
    return count;
}

static HdStatus compile(HdCudaCode *code, const HdNvrtc *nvrtc, HdNvrtcProgram program,
                        HdCudaTarget target, const char *options, HdError *error) {
    char text[MAX_TEXT];
    const char *parts[MAX_PARTS];
    snprintf(text, sizeof text, "%s", options);
    HdNvrtcResult result = nvrtc->functions.compile_program(program, split(text, parts), parts);
    if (result != 0)
        return fail_with_log(nvrtc, program, target, result, error);
    return copy_image(code, nvrtc, program, target, error);
}

HdStatus hd_cuda_compile(HdCudaCode *code, const HdNvrtc *nvrtc, HdCudaTarget target,
                         const char *options, HdError *error) {
    *code = (HdCudaCode){0};
    HdNvrtcProgram program = NULL;
    HdNvrtcResult result = nvrtc->functions.create_program(&program, (const char *)hd_cuda_source,
                                                           "kernels/cuda/hedron.cu", 0, NULL, NULL);
    if (result != 0)
        return fail_by_code(nvrtc, "nvrtcCreateProgram", result, error);
    HdStatus status = compile(code, nvrtc, program, target, options, error);
    nvrtc->functions.destroy_program(&program);
    if (status != HD_OK)
        hd_cuda_code_free(code);
    return status;
}

void hd_cuda_code_free(HdCudaCode *code) {
    free(code->image);
    free(code->log);
    *code = (HdCudaCode){0};
}
