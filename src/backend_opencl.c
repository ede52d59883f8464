/* SPDX-License-Identifier: MIT */
/* Renders on one OpenCL device. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../kernels/common/scene_tables.h"
#include "clock.h"
#include "device_launch.h"
#include "interrupt.h"
#include "opencl_program.h"

enum { CPU_PIXELS_PER_ITEM = HD_BLOCK_PIXELS, GPU_LOCAL_SIZE = 64 };

/* Arguments of hedron_render that follow the tables. */
enum {
    ARGUMENT_FIRST_ITEM = HD_SCENE_TABLE_COUNT + HD_FRAME_TABLE_COUNT,
    ARGUMENT_ITEM_COUNT,
    ARGUMENT_PARTS,
    ARGUMENT_PIXELS,
    ARGUMENT_COUNTS
};

typedef struct Buffer {
    cl_mem memory;
    size_t bytes;
} Buffer;

typedef struct Renderer {
    char name[256];
    HdOpenclDevice device;
    HdKernelCache kernels;
    HdKernelShape shape; /* of the program, if there is one */
    size_t local_size;   /* fixed: some drivers compile anew for each */
    int launch_items;
    bool has_profiling;
    cl_context context;
    cl_command_queue queue;
    HdOpenclProgram program;
    Buffer scene[HD_SCENE_TABLE_COUNT];
    Buffer frame[HD_FRAME_TABLE_COUNT];
    Buffer pixels, counts, sums;
} Renderer;

static HdStatus check(cl_int code, const char *function, HdError *error) {
    return code == CL_SUCCESS ? HD_OK : hd_opencl_fail(error, function, code);
}

/* ---- open and close ---- */

/* As many lanes as a register has, within what the kernels are written for. */
static int natural_lanes(int native_width) {
    if (native_width >= 16)
        return 16;
    return native_width >= 8 ? 8 : 4;
}

static void choose_shape(Renderer *renderer, const HdRenderOptions *options) {
    bool is_cpu = renderer->device.is_cpu;
    int lanes = options->lanes;
    if (lanes == 0)
        lanes = is_cpu ? natural_lanes(renderer->device.native_width[options->precision]) : 1;
    renderer->shape = (HdKernelShape){
        .lanes = lanes,
        .pixels_per_item = is_cpu ? CPU_PIXELS_PER_ITEM : 1,
        .group_size = is_cpu ? 0 : GPU_LOCAL_SIZE,
        .precision = options->precision,
        .math = options->math,
    };
    renderer->local_size = is_cpu ? 1 : GPU_LOCAL_SIZE;
    renderer->launch_items =
        is_cpu ? HD_MAX_LAUNCH_ITEMS : hd_gpu_launch_items(renderer->device.compute_units);
}

static HdStatus create_queue(Renderer *renderer, HdError *error) {
    cl_int code;
    cl_device_id id = renderer->device.id;
    renderer->context = clCreateContext(NULL, 1, &id, NULL, NULL, &code);
    if (!renderer->context)
        return hd_opencl_fail(error, "clCreateContext", code);
    renderer->queue = clCreateCommandQueue(renderer->context, id, CL_QUEUE_PROFILING_ENABLE, &code);
    renderer->has_profiling = renderer->queue != NULL;
    if (!renderer->queue)
        renderer->queue = clCreateCommandQueue(renderer->context, id, 0, &code);
    return renderer->queue ? HD_OK : hd_opencl_fail(error, "clCreateCommandQueue", code);
}

static void release(Buffer *buffer) {
    if (buffer->memory)
        clReleaseMemObject(buffer->memory);
    *buffer = (Buffer){0};
}

static void opencl_close(void *state) {
    Renderer *renderer = state;
    for (int i = 0; i < HD_SCENE_TABLE_COUNT; i++)
        release(&renderer->scene[i]);
    for (int i = 0; i < HD_FRAME_TABLE_COUNT; i++)
        release(&renderer->frame[i]);
    release(&renderer->pixels);
    release(&renderer->counts);
    release(&renderer->sums);
    hd_opencl_program_free(&renderer->program);
    if (renderer->queue)
        clReleaseCommandQueue(renderer->queue);
    if (renderer->context)
        clReleaseContext(renderer->context);
    free(renderer);
}

static HdStatus opencl_open(const HdDevice *device, const HdRenderOptions *options, void **state,
                            HdError *error) {
    Renderer *renderer = calloc(1, sizeof *renderer);
    if (!renderer)
        return hd_fail(error, HD_FAILED, "out of memory");
    snprintf(renderer->name, sizeof renderer->name, "%s", device->name);
    hd_kernel_cache_begin(&renderer->kernels, device);
    HdStatus status = hd_opencl_find(&renderer->device, device->index, error);
    if (status == HD_OK) {
        choose_shape(renderer, options);
        status = create_queue(renderer, error);
    }
    if (status != HD_OK) {
        opencl_close(renderer);
        return status;
    }
    *state = renderer;
    return HD_OK;
}

/* ---- buffers ---- */

static HdStatus resize(Renderer *renderer, Buffer *buffer, size_t bytes, cl_mem_flags flags,
                       const char *what, HdError *error) {
    if (buffer->memory && buffer->bytes == bytes)
        return HD_OK;
    release(buffer);
    if (bytes > renderer->device.max_allocation)
        return hd_fail(error, HD_UNAVAILABLE,
                       "the %s need %zu bytes in one buffer; %s allows %llu of its %llu", what,
                       bytes, renderer->name, (unsigned long long)renderer->device.max_allocation,
                       (unsigned long long)renderer->device.memory);
    cl_int code;
    buffer->memory = clCreateBuffer(renderer->context, flags, bytes, NULL, &code);
    if (!buffer->memory)
        return hd_fail(error, HD_FAILED,
                       "%s has no room for the %s, %zu bytes (clCreateBuffer: %s)", renderer->name,
                       what, bytes, hd_opencl_error_name(code));
    buffer->bytes = bytes;
    return HD_OK;
}

static HdStatus copy_table(Renderer *renderer, Buffer *buffer, const HdTable *table,
                           const char *what, HdError *error) {
    size_t bytes = table->bytes < HD_MIN_TABLE_BYTES ? HD_MIN_TABLE_BYTES : table->bytes;
    HdStatus status = resize(renderer, buffer, bytes, CL_MEM_READ_ONLY, what, error);
    if (status != HD_OK || table->bytes == 0)
        return status;
    cl_int code = clEnqueueWriteBuffer(renderer->queue, buffer->memory, CL_TRUE, 0, table->bytes,
                                       table->data, 0, NULL, NULL);
    return check(code, "clEnqueueWriteBuffer", error);
}

static HdStatus set_argument(cl_kernel kernel, int index, size_t size, const void *value,
                             HdError *error) {
    return check(clSetKernelArg(kernel, (cl_uint)index, size, value), "clSetKernelArg", error);
}

static HdStatus set_buffer(cl_kernel kernel, int index, const Buffer *buffer, HdError *error) {
    return set_argument(kernel, index, sizeof(cl_mem), &buffer->memory, error);
}

static HdStatus set_int(cl_kernel kernel, int index, int value, HdError *error) {
    cl_int argument = value;
    return set_argument(kernel, index, sizeof argument, &argument, error);
}

/* ---- upload ---- */

/* A kernel that needs many registers may allow smaller groups only. */
static HdStatus limit_local_size(Renderer *renderer, HdError *error) {
    size_t limit = 0;
    cl_int code = clGetKernelWorkGroupInfo(renderer->program.render, renderer->device.id,
                                           CL_KERNEL_WORK_GROUP_SIZE, sizeof limit, &limit, NULL);
    renderer->local_size = renderer->device.is_cpu ? 1 : GPU_LOCAL_SIZE;
    while (renderer->local_size > 1 && renderer->local_size > limit)
        renderer->local_size /= 2;
    return check(code, "clGetKernelWorkGroupInfo", error);
}

static HdStatus build(Renderer *renderer, const HdKernelNeeds *needs, HdError *error) {
    HdKernelShape *shape = &renderer->shape;
    bool is_built = renderer->program.program != NULL;
    if (is_built && hd_kernel_needs_equal(&shape->needs, needs))
        return HD_OK;
    hd_opencl_program_free(&renderer->program);
    shape->needs = *needs;
    HdStatus status = hd_opencl_build(&renderer->program, renderer->context, &renderer->device,
                                      renderer->name, shape, &renderer->kernels, error);
    if (status == HD_OK)
        status = limit_local_size(renderer, error);
    return status;
}

static HdStatus opencl_upload(void *state, const HdSceneTables *tables, HdError *error) {
    Renderer *renderer = state;
    HdKernelNeeds needs = hd_kernel_needs(tables);
    HdStatus status = build(renderer, &needs, error);
    for (int i = 0; status == HD_OK && i < HD_SCENE_TABLE_COUNT; i++) {
        Buffer *buffer = &renderer->scene[i];
        status = copy_table(renderer, buffer, &tables->table[i], "tables of the scene", error);
        if (status == HD_OK)
            status = set_buffer(renderer->program.render, i, buffer, error);
    }
    return status;
}

/* ---- render ---- */

static HdStatus prepare(Renderer *renderer, const HdFrameTables *tables, int items,
                        HdError *error) {
    cl_kernel render = renderer->program.render, sum = renderer->program.sum;
    HdStatus status = HD_OK;
    for (int i = 0; status == HD_OK && i < HD_FRAME_TABLE_COUNT; i++) {
        Buffer *buffer = &renderer->frame[i];
        status = copy_table(renderer, buffer, &tables->table[i], "tables of the frame", error);
        if (status == HD_OK)
            status = set_buffer(render, HD_SCENE_TABLE_COUNT + i, buffer, error);
    }
    const struct {
        Buffer *buffer;
        size_t bytes;
        const char *what;
    } outputs[] = {
        {&renderer->pixels, sizeof(float) * 3 * (size_t)tables->width * (size_t)tables->height,
         "pixels"},
        {&renderer->counts, sizeof(HdRayCounts) * (size_t)items, "counts of the work items"},
        {&renderer->sums, sizeof(HdRayCounts) * HD_SUM_WORKERS, "sums of the counts"},
    };
    for (size_t i = 0; status == HD_OK && i < sizeof outputs / sizeof *outputs; i++)
        status = resize(renderer, outputs[i].buffer, outputs[i].bytes, CL_MEM_READ_WRITE,
                        outputs[i].what, error);
    if (status == HD_OK)
        status = set_buffer(render, ARGUMENT_PIXELS, &renderer->pixels, error);
    if (status == HD_OK)
        status = set_buffer(render, ARGUMENT_COUNTS, &renderer->counts, error);
    if (status == HD_OK)
        status = set_buffer(sum, 0, &renderer->counts, error);
    if (status == HD_OK)
        status = set_int(sum, 1, items, error);
    if (status == HD_OK)
        status = set_buffer(sum, 2, &renderer->sums, error);
    return status;
}

static HdStatus launch(Renderer *renderer, cl_kernel kernel, int items, int items_per_group,
                       cl_event *event, HdError *error) {
    size_t local = renderer->local_size, share = (size_t)items_per_group;
    size_t global = ((size_t)items + share - 1) / share * local;
    cl_int code =
        clEnqueueNDRangeKernel(renderer->queue, kernel, 1, NULL, &global, &local, 0, NULL, event);
    return check(code, "clEnqueueNDRangeKernel", error);
}

/* Launches are queued one by one, so that a signal ends the frame between two of them. */
static HdStatus wait_between(const Renderer *renderer, HdError *error) {
    HdStatus status = check(clFinish(renderer->queue), "clFinish", error);
    if (status == HD_OK && hd_interrupt_signal() != 0)
        status = hd_fail(error, HD_INTERRUPTED, "interrupted in the midst of a frame");
    return status;
}

/* events[0] is the first launch's, events[1] the last one's. */
static HdStatus launch_all(Renderer *renderer, int items, int samples_per_side, cl_event events[2],
                           HdError *error) {
    cl_kernel render = renderer->program.render;
    int group_size = (int)renderer->local_size;
    int parts = renderer->device.is_cpu ? 1 : hd_gpu_sample_parts(samples_per_side, group_size);
    int count;
    HdStatus status = set_int(render, ARGUMENT_PARTS, parts, error);
    for (int first = 0; status == HD_OK && first < items; first += count) {
        status = first > 0 ? wait_between(renderer, error) : HD_OK;
        if (status != HD_OK)
            break;
        count = items - first < renderer->launch_items ? items - first : renderer->launch_items;
        status = set_int(render, ARGUMENT_FIRST_ITEM, first, error);
        if (status == HD_OK)
            status = set_int(render, ARGUMENT_ITEM_COUNT, count, error);
        if (status == HD_OK)
            status = launch(renderer, render, count, group_size / parts,
                            first == 0 ? &events[0] : NULL, error);
    }
    if (status == HD_OK)
        status =
            launch(renderer, renderer->program.sum, HD_SUM_WORKERS, group_size, &events[1], error);
    if (status == HD_OK)
        status = check(clFinish(renderer->queue), "clFinish", error);
    return status;
}

/* From the start of the first to the end of the last; `otherwise` where the driver did not tell. */
static double seconds_between(const cl_event events[2], double otherwise) {
    cl_ulong start = 0, end = 0;
    bool has_start = clGetEventProfilingInfo(events[0], CL_PROFILING_COMMAND_START, sizeof start,
                                             &start, NULL) == CL_SUCCESS;
    bool has_end = clGetEventProfilingInfo(events[1], CL_PROFILING_COMMAND_END, sizeof end, &end,
                                           NULL) == CL_SUCCESS;
    return has_start && has_end && end > start ? 1e-9 * (double)(end - start) : otherwise;
}

static HdStatus trace(Renderer *renderer, int items, int samples_per_side, double *seconds,
                      HdError *error) {
    cl_event events[2] = {NULL, NULL};
    double start = hd_monotonic_seconds();
    HdStatus status = launch_all(renderer, items, samples_per_side, events, error);
    *seconds = hd_monotonic_seconds() - start;
    if (status == HD_OK && renderer->has_profiling)
        *seconds = seconds_between(events, *seconds);
    for (int i = 0; i < 2; i++)
        if (events[i])
            clReleaseEvent(events[i]);
    return status;
}

static HdStatus read_back(Renderer *renderer, const Buffer *buffer, void *to, HdError *error) {
    cl_int code = clEnqueueReadBuffer(renderer->queue, buffer->memory, CL_TRUE, 0, buffer->bytes,
                                      to, 0, NULL, NULL);
    return check(code, "clEnqueueReadBuffer", error);
}

static HdStatus opencl_render(void *state, const HdFrameTables *tables, HdFrame *frame,
                              HdError *error) {
    Renderer *renderer = state;
    int items =
        hd_kernel_item_count(tables->width, tables->height, renderer->shape.pixels_per_item);
    HdRayCounts sums[HD_SUM_WORKERS];
    HdStatus status = prepare(renderer, tables, items, error);
    if (status == HD_OK)
        status = trace(renderer, items, tables->samples_per_side, &frame->trace_seconds, error);
    if (status == HD_OK)
        status = read_back(renderer, &renderer->pixels, frame->rgb, error);
    if (status == HD_OK)
        status = read_back(renderer, &renderer->sums, sums, error);
    if (status == HD_OK)
        hd_frame_set_counts(frame, tables->samples_per_side, sums, HD_SUM_WORKERS);
    return status;
}

static HdKernelCache *opencl_kernels(void *state) {
    Renderer *renderer = state;
    return &renderer->kernels;
}

static void opencl_describe(const void *state, char *text, int capacity) {
    const Renderer *renderer = state;
    const HdKernelShape *shape = &renderer->shape;
    snprintf(text, (size_t)capacity,
             "%d lane%s of %s, work groups of %zu, %d pixel%s for each work item, %d compute units",
             shape->lanes, shape->lanes == 1 ? "" : "s",
             shape->precision == HD_PRECISION_DOUBLE ? "double" : "float", renderer->local_size,
             shape->pixels_per_item, shape->pixels_per_item == 1 ? "" : "s",
             renderer->device.compute_units);
}

const HdBackend hd_backend_opencl = {
    .name = "opencl",
    .enumerate = hd_opencl_enumerate,
    .open = opencl_open,
    .upload = opencl_upload,
    .render = opencl_render,
    .kernels = opencl_kernels,
    .describe = opencl_describe,
    .close = opencl_close,
};
