/* SPDX-License-Identifier: MIT */
/* The fake driver's streams. What is queued is carried out as late as possible: when somebody waits
   for it. So memory that is used again too early shows. Kernels leave a colour that tells the view,
   or convert pixels as the true one does. FAKE_CUDA_EAGER carries everything out at once. Memory
   that is freed while something is queued, and what is left at the end, is told on standard error.
   Events tell a time that passes only while pictures are rendered: FAKE_CUDA_PIXEL_NS nanoseconds
   for each pixel.
   FAKE_CUDA_FAILS names a function that fails from its call number FAKE_CUDA_FAILS_AT on, else from
   its third one, with the error FAKE_CUDA_ERROR, else a lack of memory. No more than
   FAKE_CUDA_LARGEST bytes are given at once. With FAKE_CUDA_HANGS it makes that file
   and then never returns. */
#define _POSIX_C_SOURCE 200809L
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cpu/dialect.h"
#include "device/cuda/api.h"
#include "kernels/common/encode.h"
#include "kernels/common/scene_tables.h"

enum { MAX_OPERATIONS = 4096, MAX_ARGUMENTS = 32, FIRST_FAILING = 3 };
enum {
    VIEW = HD_SCENE_TABLE_COUNT + HD_TABLE_view,
    AFTER_TABLES = HD_SCENE_TABLE_COUNT + HD_FRAME_TABLE_COUNT
};

typedef enum Kernel { KERNEL_OTHER = 1, KERNEL_RENDER, KERNEL_ENCODE } Kernel;

typedef struct Event {
    double time; /* ms, of the last record that was carried out */
} Event;

typedef struct Operation {
    enum { COPY, LAUNCH, RECORD, WAIT } kind;
    const void *stream;
    bool done;
    void *to; /* COPY */
    const void *from;
    size_t bytes;
    Kernel kernel; /* LAUNCH */
    uint64_t arguments[MAX_ARGUMENTS];
    Event *event; /* RECORD, WAIT */
} Operation;

static double now; /* ms */
static Operation queue[MAX_OPERATIONS];
static int queued, allocations;

static int number(const char *variable, int otherwise) {
    const char *value = getenv(variable);
    return value != NULL ? atoi(value) : otherwise;
}

static bool fails(const char *function) {
    static int calls;
    const char *failing = getenv("FAKE_CUDA_FAILS"), *mark = getenv("FAKE_CUDA_HANGS");
    bool is_time = failing != NULL && strcmp(failing, function) == 0 &&
                   ++calls >= number("FAKE_CUDA_FAILS_AT", FIRST_FAILING);
    if (is_time && mark != NULL) {
        FILE *file = fopen(mark, "w");
        if (file != NULL)
            fclose(file);
        for (;;)
            pause();
    }
    return is_time;
}

#define FAIL_IF_ASKED(function)                                                                    \
    do {                                                                                           \
        if (fails(#function))                                                                      \
            return (HdCuResult)number("FAKE_CUDA_ERROR", HD_CU_ERROR_OUT_OF_MEMORY);               \
    } while (0)

static void *pointer(uint64_t argument) {
    return (void *)(uintptr_t)argument; /* NOLINT(performance-no-int-to-ptr) */
}

static int whole(uint64_t argument) {
    return (int)(argument & 0xffffffff);
}

/* The view's bytes become a number from 0 to 1. */
static float colour_of(const View *view) {
    uint32_t hash = 2166136261U;
    for (size_t i = 0; i < sizeof *view; i++)
        hash = (hash ^ ((const unsigned char *)view)[i]) * 16777619U;
    return (float)(hash >> 8) / (float)(1 << 24);
}

static void render(const Operation *launch) {
    const View *view = pointer(launch->arguments[VIEW]);
    int first = whole(launch->arguments[AFTER_TABLES]);
    int end = first + whole(launch->arguments[AFTER_TABLES + 1]);
    float *pixels = pointer(launch->arguments[AFTER_TABLES + 3]), colour = colour_of(view);
    if (end > view->width * view->height)
        end = view->width * view->height;
    if (getenv("FAKE_CUDA_PIXEL_NS") != NULL && end > first)
        now += 1e-6 * atof(getenv("FAKE_CUDA_PIXEL_NS")) * (end - first);
    for (int i = 3 * first; i < 3 * end; i++)
        pixels[i] = colour;
}

static void carry_out(Operation *operation);

/* Runs a stream up to and with operation number `last`. */
static void run_stream(const void *stream, int last) {
    for (int i = 0; i <= last; i++)
        if (queue[i].stream == stream && !queue[i].done)
            carry_out(&queue[i]);
}

/* Up to the event's last record before operation number `before`. */
static void run_to_event(const void *event, int before) {
    for (int i = before - 1; i >= 0; i--)
        if (queue[i].kind == RECORD && queue[i].event == event) {
            run_stream(queue[i].stream, i);
            return;
        }
}

static void carry_out(Operation *operation) {
    const uint64_t *arguments = operation->arguments;
    operation->done = true;
    if (operation->kind == COPY)
        memcpy(operation->to, operation->from, operation->bytes);
    else if (operation->kind == RECORD)
        operation->event->time = now;
    else if (operation->kind == WAIT)
        run_to_event(operation->event, (int)(operation - queue));
    else if (operation->kind == LAUNCH && operation->kernel == KERNEL_RENDER)
        render(operation);
    else if (operation->kind == LAUNCH && operation->kernel == KERNEL_ENCODE)
        encode_pixels(pointer(arguments[0]), whole(arguments[1]), pointer(arguments[2]), 0, 1,
                      pointer(arguments[3]));
}

static bool is_idle(void) {
    for (int i = 0; i < queued; i++)
        if (!queue[i].done)
            return false;
    return true;
}

static void run_all(void) {
    for (int i = 0; i < queued; i++)
        if (!queue[i].done)
            carry_out(&queue[i]);
}

static void forget_done(void) {
    int kept = 0;
    for (int i = 0; i < queued; i++)
        if (!queue[i].done)
            queue[kept++] = queue[i];
    queued = kept;
}

static HdCuResult put(Operation operation) {
    if (queued == MAX_OPERATIONS)
        forget_done();
    if (queued == MAX_OPERATIONS)
        return HD_CU_ERROR_OUT_OF_MEMORY;
    queue[queued++] = operation;
    if (getenv("FAKE_CUDA_EAGER") != NULL)
        run_all();
    return HD_CU_SUCCESS;
}

static HdCuResult create(void **handle) {
    *handle = malloc(1);
    allocations++;
    return HD_CU_SUCCESS;
}

static HdCuResult destroy(void *handle) {
    if (!is_idle())
        fprintf(stderr, "fake driver: something was freed that may be in use\n");
    free(handle);
    allocations--;
    return HD_CU_SUCCESS;
}

HdCuResult cuMemAlloc_v2(HdCuPointer *memory, size_t bytes) {
    const char *most = getenv("FAKE_CUDA_LARGEST");
    FAIL_IF_ASKED(cuMemAlloc);
    if (most != NULL && bytes > (size_t)atoll(most))
        return HD_CU_ERROR_OUT_OF_MEMORY;
    void *data = calloc(1, bytes);
    allocations++;
    *memory = (HdCuPointer)(uintptr_t)data;
    return data != NULL ? HD_CU_SUCCESS : HD_CU_ERROR_OUT_OF_MEMORY;
}

HdCuResult cuMemFree_v2(HdCuPointer memory) {
    return destroy(pointer(memory));
}

HdCuResult cuMemHostAlloc(void **data, size_t bytes, unsigned int flags) {
    (void)flags;
    FAIL_IF_ASKED(cuMemHostAlloc);
    *data = calloc(1, bytes);
    allocations++;
    return *data != NULL ? HD_CU_SUCCESS : HD_CU_ERROR_OUT_OF_MEMORY;
}

HdCuResult cuMemFreeHost(void *data) {
    return destroy(data);
}

HdCuResult cuStreamCreate(HdCuStream *stream, unsigned int flags) {
    (void)flags;
    return create((void **)stream);
}

HdCuResult cuStreamDestroy_v2(HdCuStream stream) {
    return destroy(stream);
}

HdCuResult cuEventCreate(HdCuEvent *event, unsigned int flags) {
    (void)flags;
    *event = calloc(1, sizeof(Event));
    allocations++;
    return *event != NULL ? HD_CU_SUCCESS : HD_CU_ERROR_OUT_OF_MEMORY;
}

HdCuResult cuEventDestroy_v2(HdCuEvent event) {
    return destroy(event);
}

HdCuResult cuDevicePrimaryCtxRelease_v2(HdCuDevice device) {
    (void)device;
    if (allocations != 0)
        fprintf(stderr, "fake driver: %d things were not freed\n", allocations);
    return HD_CU_SUCCESS;
}

HdCuResult cuMemcpyHtoDAsync_v2(HdCuPointer to, const void *from, size_t bytes, HdCuStream stream) {
    FAIL_IF_ASKED(cuMemcpyHtoDAsync);
    return put((Operation){
        .kind = COPY, .stream = stream, .to = pointer(to), .from = from, .bytes = bytes});
}

HdCuResult cuMemcpyDtoHAsync_v2(void *to, HdCuPointer from, size_t bytes, HdCuStream stream) {
    FAIL_IF_ASKED(cuMemcpyDtoHAsync);
    return put((Operation){
        .kind = COPY, .stream = stream, .to = to, .from = pointer(from), .bytes = bytes});
}

HdCuResult cuModuleGetFunction(HdCuFunction *function, HdCuModule module, const char *name) {
    static char handles[KERNEL_ENCODE + 1];
    Kernel kernel = strcmp(name, "hedron_render") == 0   ? KERNEL_RENDER
                    : strcmp(name, "hedron_encode") == 0 ? KERNEL_ENCODE
                                                         : KERNEL_OTHER;
    (void)module;
    handles[kernel] = (char)kernel;
    *function = (HdCuFunction)(void *)&handles[kernel];
    return HD_CU_SUCCESS;
}

HdCuResult cuLaunchKernel(HdCuFunction function, unsigned int grid_x, unsigned int grid_y,
                          unsigned int grid_z, unsigned int block_x, unsigned int block_y,
                          unsigned int block_z, unsigned int shared_bytes, HdCuStream stream,
                          void **arguments, void **extra) {
    Operation launch = {.kind = LAUNCH,
                        .stream = stream,
                        .kernel = (Kernel) * (const char *)(const void *)function};
    int count = launch.kernel == KERNEL_ENCODE ? 4 : AFTER_TABLES + 5;
    (void)grid_x, (void)grid_y, (void)grid_z, (void)block_x, (void)block_y, (void)block_z;
    (void)shared_bytes, (void)extra;
    FAIL_IF_ASKED(cuLaunchKernel);
    for (int i = 0; launch.kernel != KERNEL_OTHER && i < count; i++) {
        bool is_number =
            launch.kernel == KERNEL_ENCODE ? i == 1 : i >= AFTER_TABLES && i < AFTER_TABLES + 3;
        memcpy(&launch.arguments[i], arguments[i], is_number ? sizeof(int) : sizeof(HdCuPointer));
    }
    return put(launch);
}

HdCuResult cuEventRecord(HdCuEvent event, HdCuStream stream) {
    return put((Operation){.kind = RECORD, .stream = stream, .event = (Event *)(void *)event});
}

HdCuResult cuStreamWaitEvent(HdCuStream stream, HdCuEvent event, unsigned int flags) {
    (void)flags;
    FAIL_IF_ASKED(cuStreamWaitEvent);
    return put((Operation){.kind = WAIT, .stream = stream, .event = (Event *)(void *)event});
}

HdCuResult cuEventSynchronize(HdCuEvent event) {
    FAIL_IF_ASKED(cuEventSynchronize);
    run_to_event(event, queued);
    return HD_CU_SUCCESS;
}

/* Something takes a millisecond where no time passed. */
HdCuResult cuEventElapsedTime(float *milliseconds, HdCuEvent start, HdCuEvent end) {
    FAIL_IF_ASKED(cuEventElapsedTime);
    double passed = ((Event *)(void *)end)->time - ((Event *)(void *)start)->time;
    *milliseconds = passed > 0.0 ? (float)passed : 1.0F;
    return HD_CU_SUCCESS;
}

HdCuResult cuStreamSynchronize(HdCuStream stream) {
    run_stream(stream, queued - 1);
    return HD_CU_SUCCESS;
}

HdCuResult cuCtxSynchronize(void) {
    run_all();
    return HD_CU_SUCCESS;
}
