/* SPDX-License-Identifier: MIT */
#include "device/gpu/renderer.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "device/gpu/arguments.h"
#include "device/gpu/flight.h"
#include "device/gpu/probe.h"
#include "device/gpu/program.h"
#include "device/gpu/wave_queue.h"
#include "kernels/host/shared.h"
#include "system/interrupt.h"
#include "system/machine.h"
#include "tables/table.h"

/* Of the wavefront on CPUs: work items that strive to be even, each with a queue of its own. */
enum { WORKERS_PER_UNIT = 8, CPU_QUEUE_BYTES = 512 << 10 };

typedef struct Renderer {
    HdGpu gpu;
    HdDevice device;
    HdRenderOptions options;
    bool has_groups; /* of threads that work together, as GPUs have them */
    int depth;       /* of the scene */
    HdGpuProgram program;
    HdGpuMemory scene[HD_SCENE_TABLE_COUNT];
    HdGpuMemory frame[HD_FRAME_TABLE_COUNT];
    HdGpuMemory counts;
    HdGpuMemory first_hits;
    HdGpuMark first_hits_found;
    HdGpuMemory thresholds; /* of `curve`, if there are any */
    HdCurve curve;
    HdGpuWaveQueue queue;
    HdGpuFlights flights;
} Renderer;

static HdStatus enter(const Renderer *renderer, HdError *error) {
    const HdGpu *gpu = &renderer->gpu;
    return gpu->driver->enter != NULL ? gpu->driver->enter(gpu->handle, error) : HD_OK;
}

/* ---- open and close ---- */

/* As many lanes as a register has, within what the kernels are written for. */
static int natural_lanes(int native_width) {
    if (native_width >= 16)
        return 16;
    return native_width >= 8 ? 8 : 4;
}

static void choose_shape(Renderer *renderer) {
    const HdGpu *gpu = &renderer->gpu;
    const HdRenderOptions *options = &renderer->options;
    HdKernelShape *shape = &renderer->program.cache.shape;
    bool has_groups = renderer->has_groups;
    int lanes = has_groups ? 1 : natural_lanes(gpu->facts.native_lanes[options->precision]);
    int group_size = options->block > 0 ? options->block : gpu->driver->group_size;
    *shape = (HdKernelShape){
        .lanes = options->lanes > 0 ? options->lanes : lanes,
        .pixels_per_item = has_groups ? 1 : HD_BLOCK_PIXELS,
        .group_size = has_groups ? group_size : 0,
        .wavefront = hd_pipeline_is_wavefront(options->pipeline),
        .first_hits = options->first_hits,
        .precision = options->precision,
        .math = options->math,
        .ptx_arch = options->test.ptx_arch,
    };
    renderer->program.block = options->block;
    renderer->program.registers = options->registers;
    renderer->program.nvidia_arch = renderer->device.nvidia_arch;
    renderer->program.group_size = has_groups ? group_size : 1;
}

/* For each worker. */
static size_t queue_bytes(const Renderer *renderer) {
    if (renderer->options.test.queue_bytes > 0)
        return renderer->options.test.queue_bytes;
    return renderer->has_groups ? hd_wave_budget(renderer->gpu.facts.memory) : CPU_QUEUE_BYTES;
}

static HdStatus gpu_open(const HdDevice *device, const HdRenderOptions *options, void **state,
                         HdError *error) {
    const HdGpuDriver *driver = device->backend->driver;
    Renderer *renderer = calloc(1, sizeof *renderer + driver->bytes);
    if (!renderer)
        return hd_fail(error, HD_FAILED, "out of memory: no room for a renderer");
    HdGpu *gpu = &renderer->gpu;
    renderer->device = *device;
    renderer->options = *options;
    *gpu = (HdGpu){.driver = driver, .handle = renderer + 1, .name = renderer->device.name};
    HdStatus status = driver->open(gpu->handle, &renderer->device, &gpu->facts, error);
    if (status != HD_OK) {
        free(renderer);
        return status;
    }
    hd_kernel_cache_begin(&renderer->program.cache, device);
    renderer->has_groups = !device->is_cpu || options->test.groups;
    choose_shape(renderer);
    renderer->queue.bytes = queue_bytes(renderer);
    *state = renderer;
    return HD_OK;
}

static void release_all(Renderer *renderer) {
    const HdGpu *gpu = &renderer->gpu;
    for (int i = 0; i < HD_SCENE_TABLE_COUNT; i++)
        hd_gpu_release(gpu, &renderer->scene[i]);
    for (int i = 0; i < HD_FRAME_TABLE_COUNT; i++)
        hd_gpu_release(gpu, &renderer->frame[i]);
    hd_gpu_release(gpu, &renderer->counts);
    hd_gpu_release(gpu, &renderer->first_hits);
    gpu->driver->forget(gpu->handle, &renderer->first_hits_found);
    hd_gpu_release(gpu, &renderer->thresholds);
    hd_gpu_wave_queue_release(&renderer->queue, gpu);
    hd_gpu_flights_close(&renderer->flights, gpu);
    gpu->driver->unload(gpu->handle);
}

static void gpu_close(void *state) {
    Renderer *renderer = state;
    HdError ignored;
    if (enter(renderer, &ignored) == HD_OK)
        release_all(renderer);
    renderer->gpu.driver->close(renderer->gpu.handle);
    free(renderer);
}

/* ---- upload ---- */

/* Lets a table be where the kernels that were built read it: in constant memory or not. */
static void place_table(Renderer *renderer, HdGpuMemory *memory, const char *name) {
    const HdGpu *gpu = &renderer->gpu;
    HdGpuMemory constant = {0};
    bool has_room = renderer->program.cache.shape.needs.small_tables &&
                    gpu->driver->constant != NULL &&
                    gpu->driver->constant(gpu->handle, name, &constant);
    if (has_room || memory->is_constant) {
        hd_gpu_release(gpu, memory);
        *memory = constant;
    }
}

static void place_tables(Renderer *renderer) {
#define PLACE_OF_SCENE(type, name, rows)                                                           \
    place_table(renderer, &renderer->scene[HD_TABLE_##name], #name);
#define PLACE_OF_FRAME(type, name, rows)                                                           \
    place_table(renderer, &renderer->frame[HD_TABLE_##name], #name);
    HD_SMALL_SCENE_TABLES(PLACE_OF_SCENE)
    HD_SMALL_FRAME_TABLES(PLACE_OF_FRAME)
}

static HdStatus write_scene(Renderer *renderer, const HdSceneTables *tables, HdError *error) {
    HdStatus status = HD_OK;
    for (int i = 0; status == HD_OK && i < HD_SCENE_TABLE_COUNT; i++) {
        const HdTable *table = &tables->table[i];
        char what[64];
        snprintf(what, sizeof what, "scene's %s", hd_scene_table_content(i));
        status = hd_gpu_write_table(&renderer->gpu, &renderer->scene[i], table->data, table->bytes,
                                    what, error);
    }
    return status;
}

static HdStatus upload(Renderer *renderer, const HdSceneTables *tables, HdError *error) {
    const HdGpu *gpu = &renderer->gpu;
    HdKernelNeeds needs = hd_kernel_needs(tables);
    const HdMemoryRoom room = {.name = gpu->name,
                               .advice = hd_room_advice,
                               .memory = (double)gpu->facts.memory,
                               .at_once = (double)gpu->facts.at_once};
    HdError later;
    needs.small_tables = needs.small_tables && gpu->driver->constant != NULL;
    HdStatus status = hd_check_room(tables, &room, error);
    if (status == HD_OK)
        status = hd_gpu_build(&renderer->program, gpu, &needs, error);
    if (status == HD_OK)
        place_tables(renderer);
    if (status == HD_OK)
        status = write_scene(renderer, tables, error);
    /* After a failure too: copies that are under way read the tables, which are the caller's. */
    HdStatus finished = gpu->driver->finish(gpu->handle, status == HD_OK ? error : &later);
    return status == HD_OK ? finished : status;
}

static HdStatus gpu_upload(void *state, const HdSceneTables *tables, HdError *error) {
    Renderer *renderer = state;
    const HdDevice *device = &renderer->device;
    const double longest = hd_longest_launch(device, &renderer->options);
    const int work = renderer->options.test.launch_work;
    renderer->depth = tables->depth;
    renderer->flights.size = work > 0 ? hd_launch_size_fixed(work)
                                      : hd_launch_size_start(device->compute_units, longest);
    HdStatus status = enter(renderer, error);
    return status == HD_OK ? upload(renderer, tables, error) : status;
}

/* ---- arguments of kernels ---- */

_Static_assert(HD_SCENE_TABLE_COUNT + HD_FRAME_TABLE_COUNT + 16 <= HD_GPU_MOST_ARGUMENTS,
               "a launch has room for the tables and for what follows them");

#define QUEUE_LIST(X, LAST) HD_QUEUE_ARGUMENTS(X)

HD_GPU_ARGUMENTS(Render, add_render, HD_RENDER_ARGUMENTS)
HD_GPU_ARGUMENTS(Queue, add_queue, QUEUE_LIST)
HD_GPU_ARGUMENTS(TraceTake, add_trace_take, HD_TRACE_TAKE_ARGUMENTS)
HD_GPU_ARGUMENTS(StoreBatch, add_store_batch, HD_STORE_BATCH_ARGUMENTS)
HD_GPU_ARGUMENTS(RenderByWaves, add_render_by_waves, HD_RENDER_BY_WAVES_ARGUMENTS)
HD_GPU_ARGUMENTS(FirstHits, add_first_hits, HD_FIRST_HITS_ARGUMENTS)
HD_GPU_ARGUMENTS(SumCounts, add_sum_counts, HD_SUM_COUNTS_ARGUMENTS)
HD_GPU_ARGUMENTS(Encode, add_encode, HD_ENCODE_ARGUMENTS)

/* ---- launches ---- */

static HdGpuLaunch launch_of(const Renderer *renderer, HdKernel kernel) {
    return (HdGpuLaunch){.kernel = kernel, .group_size = renderer->program.group_size};
}

/* With the tables as its first arguments. */
static HdGpuLaunch tracing_of(const Renderer *renderer, HdKernel kernel) {
    HdGpuLaunch launch = launch_of(renderer, kernel);
    for (int i = 0; i < HD_SCENE_TABLE_COUNT; i++)
        hd_gpu_add_memory(&launch, &renderer->scene[i]);
    for (int i = 0; i < HD_FRAME_TABLE_COUNT; i++)
        hd_gpu_add_memory(&launch, &renderer->frame[i]);
    return launch;
}

/* As many groups as the items need, but no more than the grid may have. */
static int group_count(const Renderer *renderer, int items, int items_per_group) {
    int groups = (items + items_per_group - 1) / items_per_group;
    bool is_limited = renderer->has_groups && renderer->options.grid > 0;
    return is_limited && groups > renderer->options.grid ? renderer->options.grid : groups;
}

static HdStatus queue_launch(const Renderer *renderer, const HdGpuLaunch *launch, HdGpuMark *mark,
                             HdError *error) {
    return renderer->gpu.driver->launch(renderer->gpu.handle, launch, mark, error);
}

static HdStatus check_wanted(const HdFrameTables *tables, HdError *error) {
    return hd_interrupt_signal() != 0 || hd_watched_is_unwanted(&tables->watched)
               ? hd_fail(error, HD_INTERRUPTED, "interrupted in the midst of a frame")
               : HD_OK;
}

/* Launches are queued one by one, so that a signal ends the frame between two of them, so that
   each tells how large the next one may be, and so that it is known what is done: the items before
   number `done`. CPUs drive no display, but the rest holds for them too. */
static HdStatus wait_between(Renderer *renderer, HdGpuFlight *flight, int done, HdError *error) {
    const HdGpu *gpu = &renderer->gpu;
    double waited = hd_monotonic_seconds();
    HdStatus status = gpu->driver->wait_for_launch(gpu->handle, flight->untimed, error);
    if (status == HD_OK)
        status = hd_gpu_flight_time_launch(&renderer->flights, flight, gpu, waited, error);
    if (status != HD_OK)
        return status;
    hd_gpu_flight_tell(flight, done);
    return check_wanted(flight->of, error);
}

/* Among how many threads of a group the samples of a pixel are shared: the greatest divisor of
   their number up to the group's size and 64, so that all of them have as many. */
static int sample_parts(int samples, int group_size) {
    enum { MOST_PARTS = 64 };
    int parts = group_size < MOST_PARTS ? group_size : MOST_PARTS;
    while (samples % parts != 0)
        parts--;
    return parts;
}

static int samples_per_item(const Renderer *renderer, const HdGpuFlight *flight) {
    return renderer->program.cache.shape.pixels_per_item * flight->of->samples;
}

static HdStatus launch_mega(Renderer *renderer, HdGpuFlight *flight, HdError *error) {
    int samples = flight->of->samples, group_size = renderer->program.group_size;
    int parts = renderer->has_groups ? sample_parts(samples, group_size) : 1;
    int per_group = group_size / parts, work = samples_per_item(renderer, flight);
    Render own = {.parts = parts, .pixels = &flight->pixels, .counts = &renderer->counts};
    HdGpuLaunch launch = tracing_of(renderer, HD_KERNEL_TRACE);
    add_render(&launch, &own);
    HdStatus status = HD_OK;
    for (int done = 0; status == HD_OK && done < flight->items; done += own.item_count) {
        status = done > 0 ? wait_between(renderer, flight, done, error) : HD_OK;
        own.first_item = done;
        own.item_count =
            hd_launch_size_items(&renderer->flights.size, flight->items - done, work, per_group);
        launch.groups = group_count(renderer, own.item_count, per_group);
        if (status == HD_OK)
            status = hd_gpu_flight_launch(flight, &renderer->gpu, &launch,
                                          (double)own.item_count * work, error);
    }
    return status;
}

/* Of the wavefront, with a queue each. */
static int worker_count(const Renderer *renderer, int items) {
    int workers = renderer->has_groups ? 1 : renderer->device.compute_units * WORKERS_PER_UNIT;
    return workers < items ? workers : items;
}

static Queue queue_of(const Renderer *renderer) {
    const HdGpuWaveQueue *queue = &renderer->queue;
    return (Queue){
        .ray_reals = &queue->buffers[0],
        .ray_ints = &queue->buffers[1],
        .sums = &queue->buffers[2],
        .queue_stride = queue->plan.queue_stride,
        .sum_stride = queue->plan.sum_stride,
        .compact = renderer->options.pipeline == HD_PIPELINE_WAVEFRONT,
    };
}

/* The wavefront of CPUs. */
static HdStatus launch_workers(Renderer *renderer, HdGpuFlight *flight, HdError *error) {
    const Queue queue = queue_of(renderer);
    const int work = samples_per_item(renderer, flight);
    RenderByWaves own = {.pixels = &flight->pixels, .counts = &renderer->counts};
    HdGpuLaunch launch = tracing_of(renderer, HD_KERNEL_TRACE);
    add_queue(&launch, &queue);
    add_render_by_waves(&launch, &own);
    HdStatus status = HD_OK;
    for (int done = 0; status == HD_OK && done < flight->items; done = own.end_item) {
        status = done > 0 ? wait_between(renderer, flight, done, error) : HD_OK;
        const int count =
            hd_launch_size_items(&renderer->flights.size, flight->items - done, work, 1);
        own.first_item = done;
        own.end_item = done + count;
        launch.groups = worker_count(renderer, count);
        if (status == HD_OK)
            status =
                hd_gpu_flight_launch(flight, &renderer->gpu, &launch, (double)count * work, error);
    }
    return status;
}

static HdStatus trace_step(Renderer *renderer, HdGpuFlight *flight, const HdWaveStep *step,
                           int most_groups, unsigned *taken, HdError *error) {
    int group_size = renderer->program.group_size;
    const Queue queue = queue_of(renderer);
    const TraceTake own = {
        .first_item = step->first_item,
        .level = step->level,
        .first = step->first,
        .count = step->count,
        .to = step->to,
        .taken_before = step->taken_before,
        .is_first_launch = step->is_first,
        .taken = &renderer->queue.taken,
        .counts = &renderer->counts,
    };
    HdGpuLaunch launch = tracing_of(renderer, HD_KERNEL_TRACE);
    add_queue(&launch, &queue);
    add_trace_take(&launch, &own);
    launch.groups = (step->count + group_size - 1) / group_size;
    if (step->is_first || launch.groups > most_groups)
        launch.groups = most_groups;
    HdStatus status = hd_gpu_flight_launch(flight, &renderer->gpu, &launch, step->count, error);
    double waited = hd_monotonic_seconds();
    if (status == HD_OK)
        status = hd_gpu_wave_queue_read(&renderer->queue, &renderer->gpu, taken, error);
    if (status == HD_OK)
        status =
            hd_gpu_flight_time_launch(&renderer->flights, flight, &renderer->gpu, waited, error);
    return status;
}

static HdStatus store_batch(const Renderer *renderer, const HdGpuFlight *flight,
                            const HdWaveStep *step, HdError *error) {
    const StoreBatch own = {
        .header = &renderer->scene[HD_TABLE_header],
        .view = &renderer->frame[HD_TABLE_view],
        .sums = queue_of(renderer).sums,
        .sum_stride = renderer->queue.plan.sum_stride,
        .first_item = step->first_item,
        .item_count = step->item_count,
        .pixels = &flight->pixels,
    };
    HdGpuLaunch launch = launch_of(renderer, HD_KERNEL_STORE);
    add_store_batch(&launch, &own);
    launch.groups = group_count(renderer, step->item_count, launch.group_size);
    return queue_launch(renderer, &launch, NULL, error);
}

/* Samples of a batch are taken from its end on, each time once all rays of those before are
   traced. */
static void tell_step(HdGpuFlight *flight, const HdWaveStep *step) {
    const int samples = flight->of->samples;
    const int last = step->action == HD_WAVE_TRACES ? (step->first + step->count) / samples : 0;
    if (step->action == HD_WAVE_STORES || step->level == 0)
        hd_gpu_flight_tell(flight, step->first_item + step->item_count - last);
}

/* The wavefront of devices with groups of threads. */
static HdStatus launch_waves(Renderer *renderer, HdGpuFlight *flight, int most_groups,
                             HdError *error) {
    HdWaveRun run = {
        .plan = &renderer->queue.plan,
        .items = flight->items,
        .samples_per_item = flight->of->samples,
        .depth = renderer->depth,
        .grain = renderer->program.group_size,
    };
    const HdWaveStep *step = &run.step;
    unsigned taken = 0;
    HdStatus status = hd_gpu_wave_queue_empty(&renderer->queue, &renderer->gpu, error);
    while (status == HD_OK) {
        status = check_wanted(flight->of, error);
        if (status == HD_OK)
            status = hd_wave_next(&run, taken, &renderer->flights.size, error);
        if (status != HD_OK || step->action == HD_WAVE_IS_DONE)
            return status;
        tell_step(flight, step);
        status = step->action == HD_WAVE_STORES
                     ? store_batch(renderer, flight, step, error)
                     : trace_step(renderer, flight, step, most_groups, &taken, error);
    }
    return status;
}

static HdStatus launch_sum(Renderer *renderer, HdGpuFlight *flight, int count_slots,
                           HdError *error) {
    const SumCounts own = {.counts = &renderer->counts,
                           .count = count_slots,
                           .sums = &flight->sums,
                           .workers = HD_SUM_WORKERS};
    HdGpuLaunch launch = launch_of(renderer, HD_KERNEL_SUM);
    add_sum_counts(&launch, &own);
    launch.groups = (own.workers + launch.group_size - 1) / launch.group_size;
    return queue_launch(renderer, &launch, &flight->summed, error);
}

static HdStatus trace(Renderer *renderer, HdGpuFlight *flight, int count_slots, HdError *error) {
    HdStatus status;
    hd_launch_size_begin_frame(&renderer->flights.size);
    if (!renderer->program.cache.shape.wavefront)
        status = launch_mega(renderer, flight, error);
    else if (renderer->has_groups)
        status = launch_waves(renderer, flight, count_slots, error);
    else
        status = launch_workers(renderer, flight, error);
    return status == HD_OK ? launch_sum(renderer, flight, count_slots, error) : status;
}

/* ---- 8 bits ---- */

static HdStatus write_thresholds(Renderer *renderer, HdCurve curve, HdError *error) {
    const HdGpu *gpu = &renderer->gpu;
    int32_t thresholds[256];
    if (renderer->thresholds.handle != NULL && renderer->curve == curve)
        return HD_OK;
    hd_curve_thresholds8(curve, thresholds);
    HdStatus status = hd_gpu_write_table(gpu, &renderer->thresholds, thresholds, sizeof thresholds,
                                         "thresholds of the curve", error);
    if (status == HD_OK)
        status = gpu->driver->finish(gpu->handle, error);
    if (status != HD_OK)
        hd_gpu_release(gpu, &renderer->thresholds);
    renderer->curve = curve;
    return status;
}

static HdStatus encode(Renderer *renderer, HdGpuFlight *flight, HdCurve curve, HdError *error) {
    const Encode own = {.pixels = &flight->pixels,
                        .count = flight->of->width * flight->of->height,
                        .thresholds = &renderer->thresholds,
                        .image = &flight->image};
    HdGpuLaunch launch = launch_of(renderer, HD_KERNEL_ENCODE);
    HdStatus status = write_thresholds(renderer, curve, error);
    if (status != HD_OK)
        return status;
    add_encode(&launch, &own);
    launch.groups = group_count(renderer, own.count, launch.group_size);
    return queue_launch(renderer, &launch, &flight->encoded, error);
}

/* ---- frames ---- */

static HdStatus reserve_queue(Renderer *renderer, const HdGpuFlight *flight, HdError *error) {
    const HdKernelShape *shape = &renderer->program.cache.shape;
    int items = flight->items, per_item = samples_per_item(renderer, flight);
    bool has_groups = renderer->has_groups;
    HdWaveNeeds needs = {
        .bytes = renderer->queue.bytes,
        .precision = shape->precision,
        .depth = renderer->depth,
        .grain = has_groups ? renderer->program.group_size : shape->lanes,
        .samples_at_once = has_groups ? per_item : HD_WAVE_BUNDLE,
        .samples = has_groups ? hd_wave_samples(items, per_item) : per_item,
    };
    return hd_gpu_wave_queue_reserve(&renderer->queue, &renderer->gpu, &needs,
                                     worker_count(renderer, items), error);
}

/* `from` must live until the device has it. */
static HdStatus write_frame_table(Renderer *renderer, int table, const void *from, size_t bytes,
                                  HdError *error) {
    return hd_gpu_write_table(&renderer->gpu, &renderer->frame[table], from, bytes,
                              "tables of the frame", error);
}

static HdStatus write_frame(Renderer *renderer, HdGpuFlight *flight, const HdFrameTables *tables,
                            HdError *error) {
    HdStatus status = HD_OK;
    char *from = flight->tables.data;
    for (int i = 0; status == HD_OK && i < HD_FRAME_TABLE_COUNT; i++) {
        const HdTable *table = &tables->table[i];
        if (table->bytes > 0)
            memcpy(from, table->data, table->bytes);
        status = write_frame_table(renderer, i, from, table->bytes, error);
        from += table->bytes;
    }
    return status;
}

/* Queues all that the frame needs, up to its copies. Parts of it are counted one by one. */
static HdStatus launch_frame(Renderer *renderer, HdGpuFlight *flight, const HdFrameTables *tables,
                             HdCurve curve, HdError *error) {
    const HdGpuProgram *program = &renderer->program;
    int count_slots = flight->items;
    HdStatus status = HD_OK;
    if (program->cache.shape.wavefront)
        status = reserve_queue(renderer, flight, error);
    if (program->cache.shape.wavefront && renderer->has_groups)
        count_slots =
            hd_wave_groups(&renderer->queue.plan, program->group_size, renderer->options.grid);
    if (status == HD_OK)
        status = write_frame(renderer, flight, tables, error);
    if (status == HD_OK)
        status = hd_gpu_reserve(&renderer->gpu, &renderer->counts, HD_GPU_DEVICE,
                                sizeof(HdRayCounts) * (size_t)count_slots,
                                "counts of the work items", error);
    if (status == HD_OK)
        status = trace(renderer, flight, count_slots, error);
    if (status == HD_OK && flight->encodes)
        status = encode(renderer, flight, curve, error);
    return status;
}

/* CPUs have no bus to cross, and the host's conversion is as fast. */
static HdStatus gpu_submit(void *state, const HdFrameTables *tables, const HdFrameWish *wish,
                           HdError *error) {
    Renderer *renderer = state;
    const HdGpu *gpu = &renderer->gpu;
    HdGpuFlight *flight;
    bool encodes = renderer->has_groups && !wish->radiance;
    int items = hd_kernel_item_count(tables->width, tables->height,
                                     renderer->program.cache.shape.pixels_per_item);
    HdStatus status = enter(renderer, error);
    if (status != HD_OK)
        return status;
    status = hd_gpu_flight_begin(&renderer->flights, gpu, tables, items, encodes, &flight, error);
    if (status == HD_OK)
        status = launch_frame(renderer, flight, tables, wish->curve, error);
    if (status == HD_OK)
        status = hd_gpu_flight_send(&renderer->flights, flight, gpu, error);
    if (status != HD_OK) /* the next frame takes the flight's memory */
        gpu->driver->drain(gpu->handle);
    return status;
}

/* Flights end in the order of their frames. */
static HdStatus gpu_collect(void *state, const HdFrameTables *tables, HdFrame *frame,
                            HdError *error) {
    Renderer *renderer = state;
    (void)tables;
    HdStatus status = enter(renderer, error);
    return status == HD_OK ? hd_gpu_flight_collect(&renderer->flights, &renderer->gpu, frame, error)
                           : status;
}

/* ---- what is met first ---- */

static HdStatus wait_for_first_hits(const Renderer *renderer, const HdFrameTables *tables,
                                    HdError *error) {
    const HdGpu *gpu = &renderer->gpu;
    HdStatus status = gpu->driver->wait_for_launch(gpu->handle, &renderer->first_hits_found, error);
    return status == HD_OK ? check_wanted(tables, error) : status;
}

/* A sample costs less here than where light is traced, by which the size of launches is learned:
   they are short enough. */
static HdStatus launch_first_hits(Renderer *renderer, const HdFrameTables *tables, int items,
                                  int floats, HdError *error) {
    enum { MOST_THREADS = 64 }; /* of a group, which has nothing to do together */
    HdGpuLaunch launch = tracing_of(renderer, HD_KERNEL_FIRST_HITS);
    FirstHits own = {.floats = floats, .hits = &renderer->first_hits};
    int work = renderer->program.cache.shape.pixels_per_item * (tables->samples + 1);
    HdStatus status = HD_OK;
    add_first_hits(&launch, &own);
    if (launch.group_size > MOST_THREADS)
        launch.group_size = MOST_THREADS;
    for (int done = 0; status == HD_OK && done < items; done += own.item_count) {
        status = done > 0 ? wait_for_first_hits(renderer, tables, error) : HD_OK;
        own.first_item = done;
        own.item_count =
            hd_launch_size_items(&renderer->flights.size, items - done, work, launch.group_size);
        launch.groups = group_count(renderer, own.item_count, launch.group_size);
        if (status == HD_OK)
            status = queue_launch(renderer, &launch, &renderer->first_hits_found, error);
    }
    return status;
}

static HdStatus find_first_hits(Renderer *renderer, const HdFrameTables *tables, HdFrame *frame,
                                HdError *error) {
    const HdGpu *gpu = &renderer->gpu;
    const size_t pixels = (size_t)tables->width * (size_t)tables->height;
    const size_t bytes = pixels * (size_t)frame->first_floats * sizeof *frame->first;
    const int items = hd_kernel_item_count(tables->width, tables->height,
                                           renderer->program.cache.shape.pixels_per_item);
    HdStatus status = hd_gpu_reserve(gpu, &renderer->first_hits, HD_GPU_DEVICE, bytes,
                                     "pixels' first hits", error);
    for (int i = 0; status == HD_OK && i < HD_FRAME_TABLE_COUNT; i++)
        status =
            write_frame_table(renderer, i, tables->table[i].data, tables->table[i].bytes, error);
    if (status == HD_OK)
        status = launch_first_hits(renderer, tables, items, frame->first_floats, error);
    return status == HD_OK
               ? gpu->driver->read(gpu->handle, &renderer->first_hits, frame->first, bytes, error)
               : status;
}

/* The launches follow those of the frames under way, whose tables they may replace. */
static HdStatus gpu_first_hits(void *state, const HdFrameTables *tables, HdFrame *frame,
                               HdError *error) {
    Renderer *renderer = state;
    HdError later;
    HdStatus status = enter(renderer, error);
    if (status != HD_OK)
        return status;
    status = find_first_hits(renderer, tables, frame, error);
    if (status != HD_OK) /* copies that are under way read the tables, which are the caller's */
        renderer->gpu.driver->finish(renderer->gpu.handle, &later);
    return status;
}

/* What the launches on a CPU take does no harm. */
static double gpu_longest_launch(const void *state) {
    const Renderer *renderer = state;
    return renderer->has_groups ? renderer->flights.longest_launch : -1.0;
}

static void gpu_drop(void *state) {
    Renderer *renderer = state;
    HdError ignored;
    if (enter(renderer, &ignored) != HD_OK)
        return;
    renderer->gpu.driver->drain(renderer->gpu.handle);
    renderer->flights.count = 0;
}

/* ---- the arithmetic probe ---- */

static HdStatus gpu_probe(void *state, const HdProbeBatch *batch, HdProbeResults *results,
                          HdError *error) {
    Renderer *renderer = state;
    HdGpuProgram *program = &renderer->program;
    HdStatus status = enter(renderer, error);
    if (status == HD_OK)
        status = hd_gpu_build_probe(program, &renderer->gpu, error);
    return status == HD_OK ? hd_gpu_run_probe(program, &renderer->gpu, batch, results, error)
                           : status;
}

static void gpu_probe_key(void *state, char *text, size_t capacity) {
    const Renderer *renderer = state;
    hd_gpu_probe_key(&renderer->program, &renderer->gpu, text, capacity);
}

/* ---- what was chosen ---- */

static HdKernelCache *gpu_kernels(void *state) {
    Renderer *renderer = state;
    return &renderer->program.cache;
}

static void gpu_describe(const void *state, char *text, int capacity) {
    const Renderer *renderer = state;
    const HdGpu *gpu = &renderer->gpu;
    const HdGpuProgram *program = &renderer->program;
    int length = gpu->driver->describe(gpu->handle, &program->cache.shape, program->group_size,
                                       hd_pipeline_names[renderer->options.pipeline],
                                       program->cache.maker, text, capacity);
    if (program->cache.shape.rounds_by_fma && length > 0 && length < capacity)
        length += snprintf(text + length, (size_t)(capacity - length), ", division by fma");
    if (renderer->queue.is_cut && length > 0 && length < capacity)
        hd_wave_tell_cut(renderer->queue.bytes, text + length, capacity - length);
}

const HdRendererFunctions hd_gpu_functions = {
    .open = gpu_open,
    .upload = gpu_upload,
    .submit = gpu_submit,
    .collect = gpu_collect,
    .first_hits = gpu_first_hits,
    .longest_launch = gpu_longest_launch,
    .drop = gpu_drop,
    .kernels = gpu_kernels,
    .probe = gpu_probe,
    .probe_key = gpu_probe_key,
    .describe = gpu_describe,
    .close = gpu_close,
};
