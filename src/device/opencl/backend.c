/* SPDX-License-Identifier: MIT */
/* Renders on one OpenCL device. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "device/device_launch.h"
#include "device/opencl/flight.h"
#include "device/opencl/memory.h"
#include "device/opencl/program.h"
#include "device/pipeline.h"
#include "device/wave_plan.h"
#include "kernels/host/shared.h"
#include "system/interrupt.h"
#include "tables/room.h"

enum { CPU_PIXELS_PER_ITEM = HD_BLOCK_PIXELS, GPU_LOCAL_SIZE = 64 };

/* Of the wavefront on CPUs: work items that strive to be even, each with a queue of its own. */
enum { WORKERS_PER_UNIT = 8, CPU_QUEUE_BYTES = 512 << 10 };

/* Arguments of hedron_render that follow the tables. */
enum {
    ARGUMENT_FIRST_ITEM = HD_SCENE_TABLE_COUNT + HD_FRAME_TABLE_COUNT,
    ARGUMENT_ITEM_COUNT,
    ARGUMENT_PARTS,
    ARGUMENT_PIXELS,
    ARGUMENT_COUNTS
};

/* Those of hedron_trace_take and hedron_render_by_waves. */
enum {
    WAVE_ARGUMENT_REALS = HD_SCENE_TABLE_COUNT + HD_FRAME_TABLE_COUNT,
    WAVE_ARGUMENT_INTS,
    WAVE_ARGUMENT_SUMS,
    WAVE_ARGUMENT_QUEUE_STRIDE,
    WAVE_ARGUMENT_SUM_STRIDE,
    WAVE_ARGUMENT_COMPACT,
    WAVE_ARGUMENT_OWN
};

typedef struct Renderer {
    char name[256];
    HdOpenclDevice device;
    bool has_timeout; /* HdDevice.has_timeout */
    HdKernelCache kernels;
    HdKernelShape shape; /* of the program, if there is one */
    HdPipeline pipeline;
    size_t local_size;  /* fixed: some drivers compile anew for each */
    int launch_work;    /* of a launch; 0: by measurement */
    int block, grid;    /* as asked for; 0: what suits the device */
    bool has_groups;    /* of threads that work together, as GPUs have them */
    size_t queue_bytes; /* of the wavefront, for a worker or for the device */
    bool queue_is_cut;  /* the device refused more */
    HdWavePlan plan;
    int depth;
    cl_context context;
    cl_command_queue queue;
    HdOpenclProgram program;
    HdOpenclBuffer scene[HD_SCENE_TABLE_COUNT];
    HdOpenclBuffer frame[HD_FRAME_TABLE_COUNT];
    HdOpenclBuffer counts;
    HdOpenclBuffer queue_reals, queue_ints, queue_sums, queue_taken;
    HdOpenclBuffer thresholds; /* of `curve`, if there are any */
    HdCurve curve;
    HdOpenclFlights flights;
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
    const HdOpenclDevice *device = &renderer->device;
    bool has_groups = !device->is_cpu || options->test.groups;
    int lanes = options->lanes;
    if (lanes == 0)
        lanes = has_groups ? 1 : natural_lanes(device->native_width[options->precision]);
    renderer->has_groups = has_groups;
    renderer->pipeline = options->pipeline;
    renderer->block = options->block;
    renderer->grid = options->grid;
    renderer->shape = (HdKernelShape){
        .lanes = lanes,
        .pixels_per_item = has_groups ? 1 : CPU_PIXELS_PER_ITEM,
        .group_size = !has_groups          ? 0
                      : options->block > 0 ? options->block
                                           : GPU_LOCAL_SIZE,
        .wavefront = hd_pipeline_is_wavefront(options->pipeline),
        .precision = options->precision,
        .math = options->math,
    };
    if (device->nvidia_arch > 0)
        renderer->shape.register_limit =
            hd_register_limit(&renderer->shape, device->nvidia_arch, options->registers);
    renderer->local_size = has_groups ? (size_t)renderer->shape.group_size : 1;
    renderer->launch_work = options->test.launch_work;
    renderer->queue_bytes = has_groups ? hd_wave_budget(device->memory) : CPU_QUEUE_BYTES;
    if (options->test.queue_bytes > 0)
        renderer->queue_bytes = options->test.queue_bytes;
}

static HdStatus create_queue(Renderer *renderer, HdError *error) {
    cl_int code;
    cl_device_id id = renderer->device.id;
    renderer->context = clCreateContext(NULL, 1, &id, NULL, NULL, &code);
    if (!renderer->context)
        return hd_opencl_fail(error, "clCreateContext", code);
    renderer->queue = clCreateCommandQueue(renderer->context, id, CL_QUEUE_PROFILING_ENABLE, &code);
    if (!renderer->queue)
        renderer->queue = clCreateCommandQueue(renderer->context, id, 0, &code);
    if (!renderer->queue)
        return hd_opencl_fail(error, "clCreateCommandQueue", code);
    HdOpenclOwner owner = {renderer->context, &renderer->device, renderer->name};
    return hd_opencl_flights_open(&renderer->flights, &owner, error);
}

static void release_queue(Renderer *renderer) {
    hd_opencl_release(&renderer->queue_reals);
    hd_opencl_release(&renderer->queue_ints);
    hd_opencl_release(&renderer->queue_sums);
}

static void opencl_close(void *state) {
    Renderer *renderer = state;
    for (int i = 0; i < HD_SCENE_TABLE_COUNT; i++)
        hd_opencl_release(&renderer->scene[i]);
    for (int i = 0; i < HD_FRAME_TABLE_COUNT; i++)
        hd_opencl_release(&renderer->frame[i]);
    hd_opencl_release(&renderer->counts);
    release_queue(renderer);
    hd_opencl_release(&renderer->queue_taken);
    hd_opencl_release(&renderer->thresholds);
    hd_opencl_flights_close(&renderer->flights);
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
        return hd_fail(error, HD_FAILED, "out of memory: no room for a renderer");
    snprintf(renderer->name, sizeof renderer->name, "%s", device->name);
    hd_kernel_cache_begin(&renderer->kernels, device);
    renderer->has_timeout = device->has_timeout;
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

static HdStatus reserve(Renderer *renderer, HdOpenclBuffer *buffer, size_t bytes,
                        cl_mem_flags flags, const char *what, HdError *error) {
    return hd_opencl_reserve(&renderer->flights.owner, buffer, bytes, flags, what, error);
}

/* The table must live until the queue is through with it. */
static HdStatus copy_table(Renderer *renderer, HdOpenclBuffer *buffer, const HdTable *table,
                           const char *what, HdError *error) {
    size_t bytes = table->bytes < HD_MIN_TABLE_BYTES ? HD_MIN_TABLE_BYTES : table->bytes;
    HdStatus status = reserve(renderer, buffer, bytes, CL_MEM_READ_ONLY, what, error);
    if (status != HD_OK || table->bytes == 0)
        return status;
    cl_int code = clEnqueueWriteBuffer(renderer->queue, buffer->memory, CL_FALSE, 0, table->bytes,
                                       table->data, 0, NULL, NULL);
    return hd_opencl_check_room(&renderer->flights.owner, bytes, what, "clEnqueueWriteBuffer", code,
                                error);
}

static HdStatus set_argument(cl_kernel kernel, int index, size_t size, const void *value,
                             HdError *error) {
    return check(clSetKernelArg(kernel, (cl_uint)index, size, value), "clSetKernelArg", error);
}

static HdStatus set_buffer(cl_kernel kernel, int index, const HdOpenclBuffer *buffer,
                           HdError *error) {
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
    renderer->local_size = renderer->has_groups ? (size_t)renderer->shape.group_size : 1;
    if (code == CL_SUCCESS && renderer->has_groups && renderer->block > 0 &&
        renderer->local_size > limit)
        return hd_fail(error, HD_UNAVAILABLE,
                       "%s runs the kernel in work groups of at most %zu threads, not %d",
                       renderer->name, limit, renderer->block);
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
    hd_kernel_shape_set_needs(shape, needs);
    HdStatus status = hd_opencl_build(&renderer->program, renderer->context, &renderer->device,
                                      renderer->name, shape, &renderer->kernels, error);
    if (status == HD_OK)
        status = limit_local_size(renderer, error);
    if (status != HD_OK)
        hd_opencl_program_free(&renderer->program);
    return status;
}

static HdStatus opencl_upload(void *state, const HdSceneTables *tables, HdError *error) {
    Renderer *renderer = state;
    HdKernelNeeds needs = hd_kernel_needs(tables);
    const HdRoom room = {.name = renderer->name,
                         .advice = hd_room_advice,
                         .memory = (double)renderer->device.memory,
                         .at_once = (double)renderer->device.max_allocation};
    renderer->depth = tables->depth;
    const double longest = renderer->has_timeout ? HD_LAUNCH_SECONDS : HD_LAUNCH_SECONDS_FREE;
    renderer->flights.size = renderer->launch_work > 0
                                 ? hd_launch_size_fixed(renderer->launch_work)
                                 : hd_launch_size_start(renderer->device.compute_units, longest);
    HdStatus status = hd_check_room(tables, &room, error);
    if (status == HD_OK)
        status = build(renderer, &needs, error);
    for (int i = 0; status == HD_OK && i < HD_SCENE_TABLE_COUNT; i++) {
        HdOpenclBuffer *buffer = &renderer->scene[i];
        char what[64];
        snprintf(what, sizeof what, "scene's %s", hd_scene_table_content(i));
        status = copy_table(renderer, buffer, &tables->table[i], what, error);
        if (status == HD_OK)
            status = set_buffer(renderer->program.render, i, buffer, error);
    }
    cl_int code = clFinish(renderer->queue);
    return status == HD_OK ? check(code, "clFinish", error) : status;
}

/* ---- render ---- */

/* `count_slots` parts of the frame are counted one by one. */
static HdStatus prepare(Renderer *renderer, const HdOpenclFlight *flight,
                        const HdFrameTables *tables, int count_slots, HdError *error) {
    cl_kernel sum = renderer->program.sum;
    HdStatus status = HD_OK;
    for (int i = 0; status == HD_OK && i < HD_FRAME_TABLE_COUNT; i++) {
        HdOpenclBuffer *buffer = &renderer->frame[i];
        status = copy_table(renderer, buffer, &tables->table[i], "tables of the frame", error);
        if (status == HD_OK)
            status = set_buffer(renderer->program.render, HD_SCENE_TABLE_COUNT + i, buffer, error);
    }
    if (status == HD_OK)
        status = reserve(renderer, &renderer->counts, sizeof(HdRayCounts) * (size_t)count_slots,
                         CL_MEM_READ_WRITE, "counts of the work items", error);
    if (status == HD_OK)
        status = set_buffer(sum, 0, &renderer->counts, error);
    if (status == HD_OK)
        status = set_int(sum, 1, count_slots, error);
    if (status == HD_OK)
        status = set_buffer(sum, 2, &flight->sums, error);
    if (status == HD_OK)
        status = set_int(sum, 3, HD_SUM_WORKERS, error);
    return status;
}

static HdStatus prepare_waves(Renderer *renderer, HdError *error) {
    const HdWavePlan *plan = &renderer->plan;
    const HdOpenclBuffer *parts[] = {&renderer->queue_reals, &renderer->queue_ints,
                                     &renderer->queue_sums};
    cl_kernel render = renderer->program.render;
    HdStatus status = reserve(renderer, &renderer->queue_taken, HD_MIN_TABLE_BYTES,
                              CL_MEM_READ_WRITE, "counter of the queue", error);
    for (int i = 0; status == HD_OK && i < 3; i++)
        status = set_buffer(render, WAVE_ARGUMENT_REALS + i, parts[i], error);
    if (status == HD_OK)
        status = set_int(render, WAVE_ARGUMENT_QUEUE_STRIDE, plan->queue_stride, error);
    if (status == HD_OK)
        status = set_int(render, WAVE_ARGUMENT_SUM_STRIDE, plan->sum_stride, error);
    if (status == HD_OK)
        status = set_int(render, WAVE_ARGUMENT_COMPACT, renderer->pipeline == HD_PIPELINE_WAVEFRONT,
                         error);
    return status;
}

/* ---- launches ---- */

static HdStatus launch_groups(Renderer *renderer, cl_kernel kernel, int groups, cl_event *event,
                              HdError *error) {
    size_t local = renderer->local_size, global = (size_t)groups * local;
    cl_int code =
        clEnqueueNDRangeKernel(renderer->queue, kernel, 1, NULL, &global, &local, 0, NULL, event);
    return check(code, "clEnqueueNDRangeKernel", error);
}

/* As many groups as the items need, but no more than the grid may have. */
static int group_count(const Renderer *renderer, int items, int items_per_group) {
    int groups = (items + items_per_group - 1) / items_per_group;
    bool is_limited = renderer->has_groups && renderer->grid > 0;
    return is_limited && groups > renderer->grid ? renderer->grid : groups;
}

/* A work item for each of the items. */
static HdStatus launch(Renderer *renderer, cl_kernel kernel, int items, cl_event *event,
                       HdError *error) {
    int groups = group_count(renderer, items, (int)renderer->local_size);
    return launch_groups(renderer, kernel, groups, event, error);
}

/* Launches are queued one by one, so that a signal ends the frame between two of them, and so that
   each tells how large the next one may be. */
static HdStatus wait_between(Renderer *renderer, HdOpenclFlight *flight, HdError *error) {
    HdStatus status = check(clFinish(renderer->queue), "clFinish", error);
    if (status == HD_OK)
        hd_opencl_flight_time_launch(&renderer->flights, flight);
    if (status == HD_OK && hd_interrupt_signal() != 0)
        status = hd_fail(error, HD_INTERRUPTED, "interrupted in the midst of a frame");
    return status;
}

/* A launch of the tracing kernel, the flight's first or a later one, with so much work. */
static HdStatus launch_timed(Renderer *renderer, HdOpenclFlight *flight, int groups, double work,
                             HdError *error) {
    flight->work = work;
    HdStatus status =
        launch_groups(renderer, renderer->program.render, groups, &flight->launch, error);
    if (status != HD_OK || flight->first)
        return status;
    status = check(clRetainEvent(flight->launch), "clRetainEvent", error);
    flight->first = status == HD_OK ? flight->launch : NULL;
    return status;
}

/* CPUs drive no display: there a frame is one launch. */
static HdStatus launch_mega(Renderer *renderer, HdOpenclFlight *flight, int items, HdError *error) {
    cl_kernel render = renderer->program.render;
    int group_size = (int)renderer->local_size;
    int parts = renderer->has_groups ? hd_gpu_sample_parts(flight->samples, group_size) : 1;
    int per_group = group_size / parts;
    int count, samples = flight->samples;
    HdStatus status = set_buffer(render, ARGUMENT_PIXELS, &flight->pixels, error);
    if (status == HD_OK)
        status = set_buffer(render, ARGUMENT_COUNTS, &renderer->counts, error);
    if (status == HD_OK)
        status = set_int(render, ARGUMENT_PARTS, parts, error);
    for (int first = 0; status == HD_OK && first < items; first += count) {
        status = first > 0 ? wait_between(renderer, flight, error) : HD_OK;
        count = items - first;
        if (renderer->has_groups)
            count = hd_launch_size_items(&renderer->flights.size, count, samples, per_group);
        if (status == HD_OK)
            status = set_int(render, ARGUMENT_FIRST_ITEM, first, error);
        if (status == HD_OK)
            status = set_int(render, ARGUMENT_ITEM_COUNT, count, error);
        if (status == HD_OK)
            status = launch_timed(renderer, flight, group_count(renderer, count, per_group),
                                  (double)count * samples, error);
    }
    return status;
}

/* Of the wavefront, with a queue each. */
static int worker_count(const Renderer *renderer, int items) {
    int workers = renderer->has_groups ? 1 : renderer->device.compute_units * WORKERS_PER_UNIT;
    return workers < items ? workers : items;
}

/* The wavefront of CPUs. */
static HdStatus launch_workers(Renderer *renderer, HdOpenclFlight *flight, int items,
                               HdError *error) {
    cl_kernel render = renderer->program.render;
    HdStatus status = prepare_waves(renderer, error);
    if (status == HD_OK)
        status = set_int(render, WAVE_ARGUMENT_OWN, items, error);
    if (status == HD_OK)
        status = set_buffer(render, WAVE_ARGUMENT_OWN + 1, &flight->pixels, error);
    if (status == HD_OK)
        status = set_buffer(render, WAVE_ARGUMENT_OWN + 2, &renderer->counts, error);
    return status == HD_OK
               ? launch_timed(renderer, flight, worker_count(renderer, items), 0.0, error)
               : status;
}

typedef struct WaveLaunches {
    Renderer *renderer;
    HdOpenclFlight *flight;
    int groups; /* at most */
} WaveLaunches;

static HdStatus trace_step(void *context, const HdWaveStep *step, unsigned *taken, HdError *error) {
    const WaveLaunches *launches = context;
    Renderer *renderer = launches->renderer;
    cl_kernel render = renderer->program.render;
    const int numbers[] = {step->first_item, step->level, step->first,
                           step->count,      step->to,    (int)step->taken_before,
                           step->is_first};
    HdStatus status = HD_OK;
    for (int i = 0; status == HD_OK && i < (int)(sizeof numbers / sizeof *numbers); i++)
        status = set_int(render, WAVE_ARGUMENT_OWN + i, numbers[i], error);
    int local = (int)renderer->local_size;
    int groups = (step->count + local - 1) / local;
    if (step->is_first || groups > launches->groups)
        groups = launches->groups;
    if (status == HD_OK)
        status = launch_timed(renderer, launches->flight, groups, step->count, error);
    if (status == HD_OK)
        status = check(clEnqueueReadBuffer(renderer->queue, renderer->queue_taken.memory, CL_TRUE,
                                           0, sizeof *taken, taken, 0, NULL, NULL),
                       "clEnqueueReadBuffer", error);
    if (status == HD_OK)
        hd_opencl_flight_time_launch(&renderer->flights, launches->flight);
    return status;
}

static HdStatus store_batch(void *context, int first_item, int item_count, HdError *error) {
    const WaveLaunches *launches = context;
    Renderer *renderer = launches->renderer;
    cl_kernel store = renderer->program.store;
    HdStatus status = set_int(store, 4, first_item, error);
    if (status == HD_OK)
        status = set_int(store, 5, item_count, error);
    if (status == HD_OK)
        status = launch(renderer, store, item_count, NULL, error);
    return status;
}

static HdStatus prepare_steps(Renderer *renderer, const HdOpenclFlight *flight, HdError *error) {
    static const unsigned none = 0;
    cl_kernel render = renderer->program.render, store = renderer->program.store;
    const int own = WAVE_ARGUMENT_OWN + 7; /* after the numbers of a step */
    HdStatus status = prepare_waves(renderer, error);
    if (status == HD_OK)
        status = check(clEnqueueWriteBuffer(renderer->queue, renderer->queue_taken.memory, CL_FALSE,
                                            0, sizeof none, &none, 0, NULL, NULL),
                       "clEnqueueWriteBuffer", error);
    if (status == HD_OK)
        status = set_buffer(render, own, &renderer->queue_taken, error);
    if (status == HD_OK)
        status = set_buffer(render, own + 1, &renderer->counts, error);
    if (status == HD_OK)
        status = set_buffer(store, 0, &renderer->scene[HD_TABLE_header], error);
    if (status == HD_OK)
        status = set_buffer(store, 1, &renderer->frame[HD_TABLE_view], error);
    if (status == HD_OK)
        status = set_buffer(store, 2, &renderer->queue_sums, error);
    if (status == HD_OK)
        status = set_int(store, 3, renderer->plan.sum_stride, error);
    if (status == HD_OK)
        status = set_buffer(store, 6, &flight->pixels, error);
    return status;
}

/* The wavefront of devices with groups of threads. */
static HdStatus launch_steps(Renderer *renderer, HdOpenclFlight *flight, int items, int groups,
                             HdError *error) {
    WaveLaunches launches = {renderer, flight, groups};
    HdWaveDevice device = {.context = &launches,
                           .trace = trace_step,
                           .store = store_batch,
                           .size = &renderer->flights.size};
    HdWaveFrame frame = {
        .items = items,
        .samples_per_item = flight->samples,
        .depth = renderer->depth,
        .grain = (int)renderer->local_size,
    };
    HdStatus status = prepare_steps(renderer, flight, error);
    return status == HD_OK ? hd_wave_run(&renderer->plan, &frame, &device, error) : status;
}

static HdStatus trace(Renderer *renderer, HdOpenclFlight *flight, int items, int count_slots,
                      HdError *error) {
    HdStatus status;
    hd_launch_size_begin_frame(&renderer->flights.size);
    if (!renderer->shape.wavefront)
        status = launch_mega(renderer, flight, items, error);
    else if (renderer->has_groups)
        status = launch_steps(renderer, flight, items, count_slots, error);
    else
        status = launch_workers(renderer, flight, items, error);
    int local = (int)renderer->local_size;
    if (status == HD_OK)
        status = launch_groups(renderer, renderer->program.sum,
                               (HD_SUM_WORKERS + local - 1) / local, &flight->last, error);
    return status;
}

/* ---- 8 bits ---- */

static HdStatus copy_thresholds(Renderer *renderer, HdCurve curve, HdError *error) {
    int32_t thresholds[256];
    if (renderer->thresholds.memory && renderer->curve == curve)
        return HD_OK;
    HdStatus status = reserve(renderer, &renderer->thresholds, sizeof thresholds, CL_MEM_READ_ONLY,
                              "thresholds of the curve", error);
    if (status != HD_OK)
        return status;
    hd_curve_thresholds8(curve, thresholds);
    cl_int code = clEnqueueWriteBuffer(renderer->queue, renderer->thresholds.memory, CL_TRUE, 0,
                                       sizeof thresholds, thresholds, 0, NULL, NULL);
    if (code != CL_SUCCESS)
        hd_opencl_release(&renderer->thresholds);
    renderer->curve = curve;
    return check(code, "clEnqueueWriteBuffer", error);
}

static HdStatus encode(Renderer *renderer, HdOpenclFlight *flight, HdCurve curve, HdError *error) {
    cl_kernel kernel = renderer->program.encode;
    int pixels = flight->width * flight->height;
    HdStatus status = copy_thresholds(renderer, curve, error);
    if (status == HD_OK)
        status = set_buffer(kernel, 0, &flight->pixels, error);
    if (status == HD_OK)
        status = set_int(kernel, 1, pixels, error);
    if (status == HD_OK)
        status = set_buffer(kernel, 2, &renderer->thresholds, error);
    if (status == HD_OK)
        status = set_buffer(kernel, 3, &flight->image, error);
    if (status == HD_OK)
        status = launch(renderer, kernel, pixels, &flight->ready, error);
    return status;
}

/* ---- frames ---- */

/* Drivers may take memory only when it is touched first. */
static cl_int reserve_and_touch(Renderer *renderer, HdOpenclBuffer *buffer, size_t bytes) {
    static const char nothing[HD_MIN_TABLE_BYTES];
    cl_int code = CL_SUCCESS;
    if (buffer->memory && buffer->bytes >= bytes)
        return code;
    hd_opencl_release(buffer);
    if (bytes > renderer->device.max_allocation)
        return CL_MEM_OBJECT_ALLOCATION_FAILURE;
    buffer->memory = clCreateBuffer(renderer->context, CL_MEM_READ_WRITE, bytes, NULL, &code);
    buffer->bytes = bytes;
    if (code != CL_SUCCESS)
        return code;
    return clEnqueueWriteBuffer(renderer->queue, buffer->memory, CL_TRUE, 0, sizeof nothing,
                                nothing, 0, NULL, NULL);
}

/* Takes memory for what the needs of each of the workers come to; where the device has too little
   left, for less. */
static HdStatus reserve_queue(Renderer *renderer, HdWaveNeeds *needs, int workers, HdError *error) {
    HdWavePlan wanted = hd_wave_plan(needs);
    if (wanted.real_bytes * (size_t)workers > renderer->queue_reals.bytes) {
        /* What became of an earlier kernel must not be taken for a lack of memory. */
        HdStatus status = check(clFinish(renderer->queue), "clFinish", error);
        if (status != HD_OK)
            return status;
    }
    for (;;) {
        HdWavePlan plan = renderer->plan = hd_wave_plan(needs);
        size_t all = (size_t)workers, bytes = plan.real_bytes + plan.int_bytes + plan.sum_bytes;
        cl_int code = reserve_and_touch(renderer, &renderer->queue_reals, plan.real_bytes * all);
        if (code == CL_SUCCESS)
            code = reserve_and_touch(renderer, &renderer->queue_ints, plan.int_bytes * all);
        if (code == CL_SUCCESS)
            code = reserve_and_touch(renderer, &renderer->queue_sums, plan.sum_bytes * all);
        if (code == CL_SUCCESS)
            return HD_OK;
        release_queue(renderer);
        if (!hd_opencl_is_lack_of_memory(code) || !hd_wave_halve(needs))
            return hd_opencl_check_room(&renderer->flights.owner, bytes * all, "rays of the queue",
                                        "clCreateBuffer", code, error);
        renderer->queue_bytes = needs->bytes;
        renderer->queue_is_cut = true;
    }
}

static HdStatus plan_waves(Renderer *renderer, int items, int samples, HdError *error) {
    const HdKernelShape *shape = &renderer->shape;
    int per_item = shape->pixels_per_item * samples;
    HdWaveNeeds needs = {
        .bytes = renderer->queue_bytes,
        .precision = shape->precision,
        .depth = renderer->depth,
        .grain = renderer->has_groups ? (int)renderer->local_size : shape->lanes,
        .samples_at_once = renderer->has_groups ? per_item : HD_WAVE_BUNDLE,
        .samples = renderer->has_groups ? hd_wave_samples(items, per_item) : per_item,
    };
    return reserve_queue(renderer, &needs, worker_count(renderer, items), error);
}

/* Queues all that the frame needs, up to its copies. */
static HdStatus launch_frame(Renderer *renderer, HdOpenclFlight *flight,
                             const HdFrameTables *tables, HdCurve curve, HdError *error) {
    int items =
        hd_kernel_item_count(tables->width, tables->height, renderer->shape.pixels_per_item);
    int count_slots = items;
    HdStatus status = HD_OK;
    if (renderer->shape.wavefront)
        status = plan_waves(renderer, items, tables->samples, error);
    if (renderer->shape.wavefront && renderer->has_groups)
        count_slots = hd_wave_groups(&renderer->plan, (int)renderer->local_size, renderer->grid);
    if (status == HD_OK)
        status = prepare(renderer, flight, tables, count_slots, error);
    if (status == HD_OK)
        status = trace(renderer, flight, items, count_slots, error);
    if (status == HD_OK && flight->encodes)
        status = encode(renderer, flight, curve, error);
    if (status == HD_OK && !flight->encodes) {
        status = check(clRetainEvent(flight->last), "clRetainEvent", error);
        flight->ready = status == HD_OK ? flight->last : NULL;
    }
    if (status == HD_OK) /* before another queue waits for it */
        status = check(clFlush(renderer->queue), "clFlush", error);
    return status;
}

/* CPUs have no bus to cross, and the host's conversion is as fast. */
static HdStatus opencl_submit(void *state, const HdFrameTables *tables, const HdFrameWish *wish,
                              HdError *error) {
    Renderer *renderer = state;
    HdOpenclFlight *flight;
    bool encodes = renderer->has_groups && !wish->radiance;
    HdStatus status = hd_opencl_flight_begin(&renderer->flights, tables, encodes, &flight, error);
    if (status == HD_OK)
        status = launch_frame(renderer, flight, tables, wish->curve, error);
    if (status == HD_OK)
        status = hd_opencl_flight_send(&renderer->flights, flight, error);
    if (status != HD_OK) {
        clFinish(renderer->queue);
        hd_opencl_flight_cancel(flight);
    }
    return status;
}

static HdStatus opencl_collect(void *state, HdFrame *frame, HdError *error) {
    Renderer *renderer = state;
    return hd_opencl_flight_collect(&renderer->flights, frame, error);
}

/* What the launches on a CPU take does no harm. */
static double opencl_longest_launch(const void *state) {
    const Renderer *renderer = state;
    return renderer->has_groups ? renderer->flights.longest_launch : -1.0;
}

static void opencl_drop(void *state) {
    Renderer *renderer = state;
    clFinish(renderer->queue);
    hd_opencl_flights_drop(&renderer->flights);
}

static HdKernelCache *opencl_kernels(void *state) {
    Renderer *renderer = state;
    return &renderer->kernels;
}

static int opencl_lanes(const void *state) {
    const Renderer *renderer = state;
    return renderer->shape.lanes;
}

static bool opencl_be_cautious(void *state) {
    Renderer *renderer = state;
    return hd_kernel_shape_be_cautious(&renderer->shape);
}

static void opencl_describe(const void *state, char *text, int capacity) {
    const Renderer *renderer = state;
    const HdKernelShape *shape = &renderer->shape;
    int length = snprintf(
        text, (size_t)capacity,
        "%d lane%s of %s, work groups of %zu, %d pixel%s for each work item, %d compute units, "
        "%s",
        shape->lanes, shape->lanes == 1 ? "" : "s",
        shape->precision == HD_PRECISION_DOUBLE ? "double" : "float", renderer->local_size,
        shape->pixels_per_item, shape->pixels_per_item == 1 ? "" : "s",
        renderer->device.compute_units, hd_pipeline_name(renderer->pipeline));
    if (renderer->queue_is_cut && length > 0 && length < capacity)
        hd_wave_tell_cut(renderer->queue_bytes, text + length, capacity - length);
}

const HdBackend hd_backend_opencl = {
    .name = "opencl",
    .enumerate = hd_opencl_enumerate,
    .open = opencl_open,
    .upload = opencl_upload,
    .submit = opencl_submit,
    .collect = opencl_collect,
    .longest_launch = opencl_longest_launch,
    .drop = opencl_drop,
    .kernels = opencl_kernels,
    .be_cautious = opencl_be_cautious,
    .lanes = opencl_lanes,
    .describe = opencl_describe,
    .close = opencl_close,
};
