/* SPDX-License-Identifier: MIT */
/* Modules, which are shared objects, their functions and their launches. FAKE_CUDA_REFUSES is the
   number of modules that fail to load at first. As on a device, machine code loads if its
   architecture is the device's, and PTX if it is not newer. */
#define _GNU_SOURCE /* pipe2 */
#include <dlfcn.h>
#include <elf.h>
#include <fcntl.h>
#include <link.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/uio.h>
#include <unistd.h>

#include "fake.h"

enum { MAX_PARAMETERS = 64, MAX_BLOCK_THREADS = 1024 };

struct CUmod_st {
    void *library;
    FakeThread *thread;
    const FakeShared *shared;
    int registers; /* of a thread */
};

struct CUfunc_st {
    HdCuModule module;
    const FakeKernel *kernel;
    char name[64];
};

/* ---- modules ---- */

/* Returns the size of a shared object, which ends with the table of its sections. */
static size_t image_size(const void *image) {
    Elf64_Ehdr header;
    memcpy(&header, image, sizeof header);
    return (size_t)header.e_shoff + (size_t)header.e_shentsize * header.e_shnum;
}

static bool write_image(int file, const void *image) {
    const char *from = image;
    size_t left = image_size(image);
    while (left > 0) {
        ssize_t written = write(file, from, left);
        if (written <= 0)
            return false;
        from += written;
        left -= (size_t)written;
    }
    return true;
}

/* The loader wants a file, under a name that it has not seen. */
static void *load_image(const void *image) {
    const char *folder = getenv("TMPDIR");
    char path[4096];
    snprintf(path, sizeof path, "%s/fake_cuda_XXXXXX", folder != NULL ? folder : "/tmp");
    int file = mkstemp(path);
    if (file < 0)
        return NULL;
    void *library = write_image(file, image) ? dlopen(path, RTLD_NOW | RTLD_LOCAL) : NULL;
    close(file);
    unlink(path);
    return library;
}

static bool is_refused(void) {
    static int count;
    return count++ < (int)fake_number("FAKE_CUDA_REFUSES", 0.0);
}

/* Limits that kernels are built with, unless PTX is loaded with another limit. */
enum { REGISTERS = 64 };

/* Finds the object: PTX has its head and a NUL before it, machine code its architecture behind
   it. */
static const void *find_object(const void *image, bool *suits) {
    const char *head = image;
    int arch = 0;
    bool is_ptx = sscanf(head, ".version %*d.%*d\n.target sm_%d", &arch) == 1;
    const char *object = is_ptx ? head + strlen(head) + 1 : head;
    if (memcmp(object, ELFMAG, SELFMAG) != 0)
        return NULL;
    if (is_ptx)
        *suits = arch <= fake_capability();
    else
        *suits = sscanf(head + image_size(image), "sm_%d", &arch) == 1 && arch == fake_capability();
    return object;
}

static bool read_options(int *registers, bool is_ptx, unsigned int count,
                         const HdCuJitOption *options, void **values) {
    for (unsigned int i = 0; i < count; i++)
        if (options[i] == HD_CU_JIT_MAX_REGISTERS)
            *registers = (int)(uintptr_t)values[i];
        else
            return false;
    return is_ptx || count == 0;
}

HdCuResult cuModuleLoadDataEx(HdCuModule *module, const void *image, unsigned int count,
                              HdCuJitOption *options, void **values) {
    FAKE_CALL(cuModuleLoadDataEx);
    bool suits = false;
    int registers = REGISTERS;
    if (is_refused())
        return HD_CU_ERROR_OUT_OF_MEMORY;
    const void *object = find_object(image, &suits);
    if (object == NULL)
        return FAKE_INVALID_IMAGE;
    if (!read_options(&registers, object != image, count, options, values))
        return fake_misuse(FAKE_INVALID_VALUE, "options of a module");
    if (!suits)
        return FAKE_NO_BINARY_FOR_GPU;
    struct CUmod_st loaded = {.library = load_image(object), .registers = registers};
    if (loaded.library == NULL)
        return FAKE_INVALID_IMAGE;
    loaded.thread = dlsym(loaded.library, "fake_thread");
    loaded.shared = dlsym(loaded.library, "fake_shared");
    if (loaded.thread == NULL || loaded.shared == NULL)
        return FAKE_INVALID_IMAGE;
    *module = fake_create(FAKE_MODULE, sizeof **module);
    if (*module == NULL)
        return HD_CU_ERROR_OUT_OF_MEMORY;
    **module = loaded;
    return HD_CU_SUCCESS;
}

HdCuResult cuModuleUnload(HdCuModule module) {
    FAKE_CALL(cuModuleUnload);
    if (!fake_lives(FAKE_MODULE, module))
        return fake_misuse(FAKE_INVALID_HANDLE, "a module is unloaded that is not there");
    fake_expect_idle();
    fake_drop_globals(module);
    dlclose(module->library);
    fake_forget(FAKE_MODULE, module);
    return HD_CU_SUCCESS;
}

/* ---- functions ---- */

HdCuResult cuModuleGetFunction(HdCuFunction *function, HdCuModule module, const char *name) {
    char symbol[128];
    FAKE_CALL(cuModuleGetFunction);
    if (!fake_lives(FAKE_MODULE, module))
        return fake_misuse(FAKE_INVALID_HANDLE, "a module is used that is not there");
    snprintf(symbol, sizeof symbol, "fake_kernel_%s", name);
    const FakeKernel *kernel = dlsym(module->library, symbol);
    if (kernel == NULL)
        return FAKE_NOT_FOUND;
    *function = fake_create(FAKE_FUNCTION, sizeof **function);
    if (*function == NULL)
        return HD_CU_ERROR_OUT_OF_MEMORY;
    (*function)->module = module;
    (*function)->kernel = kernel;
    snprintf((*function)->name, sizeof(*function)->name, "%s", name);
    return HD_CU_SUCCESS;
}

HdCuResult cuModuleGetGlobal_v2(HdCuPointer *pointer, size_t *bytes, HdCuModule module,
                                const char *name) {
    FAKE_CALL(cuModuleGetGlobal_v2);
    Dl_info info;
    void *symbol = NULL;
    if (!fake_lives(FAKE_MODULE, module))
        return fake_misuse(FAKE_INVALID_HANDLE, "a module is used that is not there");
    void *at = dlsym(module->library, name);
    if (at == NULL || dladdr1(at, &info, &symbol, RTLD_DL_SYMENT) == 0 || symbol == NULL)
        return FAKE_NOT_FOUND;
    *bytes = ((const ElfW(Sym) *)symbol)->st_size;
    *pointer = (HdCuPointer)(uintptr_t)at;
    return fake_add_global(module, at, *bytes) ? HD_CU_SUCCESS : HD_CU_ERROR_OUT_OF_MEMORY;
}

static HdCuResult check_function(HdCuFunction function) {
    if (fake_lives(FAKE_FUNCTION, function) && fake_lives(FAKE_MODULE, function->module))
        return HD_CU_SUCCESS;
    return fake_misuse(FAKE_INVALID_HANDLE, "a function is used that is not there");
}

HdCuResult cuFuncGetAttribute(int *value, HdCuAttribute attribute, HdCuFunction function) {
    FAKE_CALL(cuFuncGetAttribute);
    HdCuResult code = check_function(function);
    if (code == HD_CU_SUCCESS)
        *value = attribute == HD_CU_FUNCTION_MAX_THREADS ? MAX_BLOCK_THREADS
                                                         : function->module->registers;
    return code;
}

/* ---- launches ---- */

/* Joins pieces of memory. Returns false if one is invalid, as a pipe's end notices. */
static bool read_safely(void *to, const struct iovec *from, int count) {
    static int ends[2] = {-1, -1};
    ssize_t bytes = 0;
    for (int i = 0; i < count; i++)
        bytes += (ssize_t)from[i].iov_len;
    if (ends[0] < 0 && pipe2(ends, O_CLOEXEC) != 0)
        return false;
    ssize_t written = writev(ends[1], from, count);
    if (written > 0 && read(ends[0], to, (size_t)written) != written)
        return false;
    return written == bytes;
}

/* The array's length is unknown, but no argument follows its end. */
static HdCuResult read_arguments(HdCuFunction function, void **from, uint64_t *arguments) {
    const FakeKernel *kernel = function->kernel;
    void *place[MAX_PARAMETERS];
    unsigned char bytes[MAX_PARAMETERS * FAKE_ARGUMENT_BYTES], *at = bytes;
    struct iovec pieces[MAX_PARAMETERS];
    const struct iovec array = {from, (size_t)kernel->count * sizeof *from};
    bool good = read_safely(place, &array, 1);
    for (int i = 0; good && i < kernel->count; i++)
        pieces[i] = (struct iovec){place[i], kernel->parameters[i].bytes};
    if (!good || !read_safely(bytes, pieces, kernel->count))
        return fake_misuse(FAKE_INVALID_VALUE, "%s has %d parameters, which are not all given",
                           function->name, kernel->count);
    for (int i = 0; i < kernel->count; i++) {
        memcpy(&arguments[i], at, kernel->parameters[i].bytes);
        at += kernel->parameters[i].bytes;
    }
    return HD_CU_SUCCESS;
}

/* Parameters are declared as pointers that nobody else writes through. */
static bool is_unshared(const FakeKernel *kernel, const uint64_t *arguments, int number) {
    for (int i = 0; i < kernel->count; i++)
        if (i != number && kernel->parameters[i].is_pointer && arguments[i] == arguments[number])
            return false;
    return true;
}

static HdCuResult check_pointers(HdCuFunction function, const uint64_t *arguments) {
    const FakeKernel *kernel = function->kernel;
    for (int i = 0; i < kernel->count; i++) {
        const FakeParameter *parameter = &kernel->parameters[i];
        if (!parameter->is_pointer)
            continue;
        if (fake_memory(arguments[i], 1) == NULL)
            return fake_misuse(FAKE_INVALID_VALUE,
                               "argument %d of %s is no memory of the device that lives", i + 1,
                               function->name);
        if (parameter->is_written && !is_unshared(kernel, arguments, i))
            return fake_misuse(FAKE_INVALID_VALUE,
                               "argument %d of %s, which it writes to, is another one as well",
                               i + 1, function->name);
    }
    return HD_CU_SUCCESS;
}

static bool is_possible(const FakeLaunch *launch) {
    return launch->blocks.x > 0 && launch->blocks.y == 1 && launch->blocks.z == 1 &&
           launch->threads.x > 0 && launch->threads.x <= MAX_BLOCK_THREADS &&
           launch->threads.y == 1 && launch->threads.z == 1;
}

HdCuResult cuLaunchKernel(HdCuFunction function, unsigned int grid_x, unsigned int grid_y,
                          unsigned int grid_z, unsigned int block_x, unsigned int block_y,
                          unsigned int block_z, unsigned int shared_bytes, HdCuStream stream,
                          void **arguments, void **extra) {
    FAKE_CALL(cuLaunchKernel);
    FakeLaunch launch = {.function = function,
                         .blocks = {grid_x, grid_y, grid_z},
                         .threads = {block_x, block_y, block_z}};
    HdCuResult code = check_function(function);
    if (code != HD_CU_SUCCESS)
        return code;
    if (!is_possible(&launch) || shared_bytes != 0 || extra != NULL)
        return fake_misuse(FAKE_INVALID_VALUE, "%u blocks of %u threads of %s, which is refused",
                           grid_x, block_x, function->name);
    launch.arguments = calloc(MAX_PARAMETERS, sizeof *launch.arguments);
    if (launch.arguments == NULL || function->kernel->count > MAX_PARAMETERS)
        code = HD_CU_ERROR_OUT_OF_MEMORY;
    if (code == HD_CU_SUCCESS)
        code = read_arguments(function, arguments, launch.arguments);
    if (code == HD_CU_SUCCESS)
        code = check_pointers(function, launch.arguments);
    if (code == HD_CU_SUCCESS)
        return fake_queue_launch(stream, launch);
    free(launch.arguments);
    return code;
}

void fake_run_launch(const FakeLaunch *launch) {
    const FakeKernel *kernel = launch->function->kernel;
    HdCuModule module = launch->function->module;
    void *values[MAX_PARAMETERS], *pointers[MAX_PARAMETERS];
    if (check_function(launch->function) != HD_CU_SUCCESS ||
        check_pointers(launch->function, launch->arguments) != HD_CU_SUCCESS) {
        fake_lose(HD_CU_ERROR_ILLEGAL_ADDRESS, "something was freed before its kernel ran");
        return;
    }
    for (int i = 0; i < kernel->count; i++) {
        pointers[i] = fake_memory(launch->arguments[i], 1);
        values[i] = kernel->parameters[i].is_pointer ? (void *)&pointers[i] : &launch->arguments[i];
    }
    module->thread->blocks = launch->blocks;
    module->thread->threads = launch->threads;
    FakeGrid grid = {kernel, values, module->thread, module->shared};
    const char *failure = fake_run_grid(&grid);
    if (failure != NULL)
        fake_lose(HD_CU_ERROR_LAUNCH_FAILED, failure);
    else if (!fake_guards_hold())
        fake_lose(HD_CU_ERROR_ILLEGAL_ADDRESS, "a kernel wrote outside an allocation");
}
