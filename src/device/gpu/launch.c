/* SPDX-License-Identifier: MIT */
/* The launches of a frame. */
#include <string.h>

#include "base/minmax.h"
#include "device/gpu/gpu.h"
#include "kernels/host/shared.h"
#include "system/interrupt.h"
#include "system/machine.h"

/* ---- arguments of kernels ---- */

_Static_assert(HD_SCENE_TABLE_COUNT + HD_FRAME_TABLE_COUNT + 16 <= HD_GPU_MAX_ARGUMENTS,
               "a launch has room for the tables and for what follows them");

#define QUEUE_LIST(X, LAST) HD_QUEUE_ARGUMENTS(X)

HD_GPU_ARGUMENTS(Render, add_render, HD_RENDER_ARGUMENTS)
HD_GPU_ARGUMENTS(Queue, add_queue, QUEUE_LIST)
HD_GPU_ARGUMENTS(TraceChunk, add_trace_chunk, HD_TRACE_CHUNK_ARGUMENTS)
HD_GPU_ARGUMENTS(StoreBatch, add_store_batch, HD_STORE_BATCH_ARGUMENTS)
HD_GPU_ARGUMENTS(RenderByWaves, add_render_by_waves, HD_RENDER_BY_WAVES_ARGUMENTS)
HD_GPU_ARGUMENTS(FirstHits, add_first_hits, HD_FIRST_HITS_ARGUMENTS)
HD_GPU_ARGUMENTS(SumCounts, add_sum_counts, HD_SUM_COUNTS_ARGUMENTS)
HD_GPU_ARGUMENTS(Encode, add_encode, HD_ENCODE_ARGUMENTS)

/* ---- launches ---- */

static HdGpuLaunch launch_of(const HdGpuRenderer *renderer, HdKernel kernel) {
    return (HdGpuLaunch){.kernel = kernel, .group_size = renderer->program.group_size};
}

/* The launch has the tables as its first arguments. */
static HdGpuLaunch tracing_of(const HdGpuRenderer *renderer, HdKernel kernel) {
    HdGpuLaunch launch = launch_of(renderer, kernel);
    for (int i = 0; i < HD_SCENE_TABLE_COUNT; i++)
        hd_gpu_add_memory(&launch, &renderer->scene[i]);
    for (int i = 0; i < HD_FRAME_TABLE_COUNT; i++)
        hd_gpu_add_memory(&launch, &renderer->frame[i]);
    return launch;
}

/* As many groups as the items need, limited by the grid. */
static int group_count(const HdGpuRenderer *renderer, int items, int items_per_group) {
    int groups = (items + items_per_group - 1) / items_per_group;
    bool is_limited = renderer->has_groups && renderer->options.grid > 0;
    return is_limited ? hd_min(groups, renderer->options.grid) : groups;
}

static HdStatus queue_launch(const HdGpuRenderer *renderer, const HdGpuLaunch *launch,
                             HdGpuEvent *event, HdError *error) {
    return renderer->gpu.driver->launch(renderer->gpu.handle, launch, event, error);
}

static HdStatus check_cancelled(const HdFrameTables *tables, HdError *error) {
    return hd_interrupt_signal() != 0 || hd_watched_is_cancelled(&tables->watched)
               ? hd_fail(error, HD_INTERRUPTED, "interrupted during a frame")
               : HD_OK;
}

/* Launches are queued one by one. A signal can end the frame between two of them, each determines
   the size of the next, and the items before number `done` are known to be done. CPUs drive no
   display, but need the rest too. */
static HdStatus wait_between(HdGpuRenderer *renderer, HdGpuFrameInFlight *in_flight, int done,
                             HdError *error) {
    const HdGpu *gpu = &renderer->gpu;
    double waited = hd_monotonic_seconds();
    HD_TRY(gpu->driver->wait_for_launch(gpu->handle, in_flight->untimed, error));
    HD_TRY(hd_gpu_frame_time_launch(renderer, in_flight, waited, error));
    hd_gpu_frame_report(in_flight, done);
    return check_cancelled(in_flight->of, error);
}

/* Returns how many threads of a group share the samples of a pixel. It is the greatest divisor of
   their number up to the group's size and 64, so that each has equally many. */
static int sample_parts(int samples, int group_size) {
    enum { MAX_PARTS = 64 };
    int parts = hd_min(group_size, MAX_PARTS);
    while (samples % parts != 0)
        parts--;
    return parts;
}

static int samples_per_item(const HdGpuRenderer *renderer, const HdGpuFrameInFlight *in_flight) {
    return renderer->program.cache.shape.pixels_per_item * in_flight->of->samples;
}

static HdStatus launch_mega(HdGpuRenderer *renderer, HdGpuFrameInFlight *in_flight,
                            HdError *error) {
    int samples = in_flight->of->samples, group_size = renderer->program.group_size;
    int parts = renderer->has_groups ? sample_parts(samples, group_size) : 1;
    int per_group = group_size / parts, work = samples_per_item(renderer, in_flight);
    Render own = {.parts = parts, .pixels = &in_flight->pixels, .counts = &renderer->counts};
    HdGpuLaunch launch = tracing_of(renderer, HD_KERNEL_TRACE);
    add_render(&launch, &own);
    for (int done = 0; done < in_flight->items; done += own.item_count) {
        if (done > 0)
            HD_TRY(wait_between(renderer, in_flight, done, error));
        own.first_item = done;
        own.item_count = hd_launch_size_items(&renderer->frames_in_flight.size,
                                              in_flight->items - done, work, per_group);
        launch.groups = group_count(renderer, own.item_count, per_group);
        HD_TRY(hd_gpu_frame_launch(renderer, in_flight, &launch, (double)own.item_count * work,
                                   error));
    }
    return HD_OK;
}

/* Workers of the wavefront, with a queue each; on CPUs enough for an even load. */
static int worker_count(const HdGpuRenderer *renderer, int items) {
    enum { WORKERS_PER_UNIT = 8 };
    return renderer->has_groups ? 1
                                : hd_min(renderer->device.compute_units * WORKERS_PER_UNIT, items);
}

static Queue queue_of(const HdGpuRenderer *renderer) {
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
static HdStatus launch_workers(HdGpuRenderer *renderer, HdGpuFrameInFlight *in_flight,
                               HdError *error) {
    const Queue queue = queue_of(renderer);
    const int work = samples_per_item(renderer, in_flight);
    RenderByWaves own = {.pixels = &in_flight->pixels, .counts = &renderer->counts};
    HdGpuLaunch launch = tracing_of(renderer, HD_KERNEL_TRACE);
    add_queue(&launch, &queue);
    add_render_by_waves(&launch, &own);
    for (int done = 0; done < in_flight->items; done = own.end_item) {
        if (done > 0)
            HD_TRY(wait_between(renderer, in_flight, done, error));
        const int count = hd_launch_size_items(&renderer->frames_in_flight.size,
                                               in_flight->items - done, work, 1);
        own.first_item = done;
        own.end_item = done + count;
        launch.groups = worker_count(renderer, count);
        HD_TRY(hd_gpu_frame_launch(renderer, in_flight, &launch, (double)count * work, error));
    }
    return HD_OK;
}

static HdStatus trace_step(HdGpuRenderer *renderer, HdGpuFrameInFlight *in_flight,
                           const HdWaveStep *step, int max_groups, unsigned *taken,
                           HdError *error) {
    int group_size = renderer->program.group_size;
    const Queue queue = queue_of(renderer);
    const TraceChunk own = {
        .first_item = step->first_item,
        .level = step->chunk.level,
        .first = step->chunk.first,
        .count = step->chunk.count,
        .to = step->chunk.to,
        .taken_before = step->taken_before,
        .is_first_launch = step->is_first,
        .taken = &renderer->queue.taken,
        .counts = &renderer->counts,
    };
    HdGpuLaunch launch = tracing_of(renderer, HD_KERNEL_TRACE);
    add_queue(&launch, &queue);
    add_trace_chunk(&launch, &own);
    launch.groups = (step->chunk.count + group_size - 1) / group_size;
    launch.groups = step->is_first ? max_groups : hd_min(launch.groups, max_groups);
    HD_TRY(hd_gpu_frame_launch(renderer, in_flight, &launch, step->chunk.count, error));
    double waited = hd_monotonic_seconds();
    HD_TRY(hd_gpu_wave_queue_read(&renderer->queue, &renderer->gpu, taken, error));
    return hd_gpu_frame_time_launch(renderer, in_flight, waited, error);
}

static HdStatus store_batch(const HdGpuRenderer *renderer, const HdGpuFrameInFlight *in_flight,
                            const HdWaveStep *step, HdError *error) {
    const StoreBatch own = {
        .header = &renderer->scene[HD_TABLE_header],
        .view = &renderer->frame[HD_TABLE_view],
        .sums = queue_of(renderer).sums,
        .sum_stride = renderer->queue.plan.sum_stride,
        .first_item = step->first_item,
        .item_count = step->item_count,
        .pixels = &in_flight->pixels,
    };
    HdGpuLaunch launch = launch_of(renderer, HD_KERNEL_STORE);
    add_store_batch(&launch, &own);
    launch.groups = group_count(renderer, step->item_count, launch.group_size);
    return queue_launch(renderer, &launch, NULL, error);
}

/* A batch's samples start from its end, each time once all rays before them are traced. */
static void report_step(HdGpuFrameInFlight *in_flight, const HdWaveStep *step) {
    const int samples = in_flight->of->samples;
    const int last =
        step->action == HD_WAVE_TRACES ? (step->chunk.first + step->chunk.count) / samples : 0;
    if (step->action == HD_WAVE_STORES || step->chunk.level == 0)
        hd_gpu_frame_report(in_flight, step->first_item + step->item_count - last);
}

/* The wavefront of devices with groups of threads. */
static HdStatus launch_waves(HdGpuRenderer *renderer, HdGpuFrameInFlight *in_flight, int max_groups,
                             HdError *error) {
    HdWaveRun run = {
        .plan = &renderer->queue.plan,
        .items = in_flight->items,
        .samples_per_item = in_flight->of->samples,
        .depth = renderer->depth,
        .grain = renderer->program.group_size,
    };
    const HdWaveStep *step = &run.step;
    unsigned taken = 0;
    HD_TRY(hd_gpu_wave_queue_empty(&renderer->queue, &renderer->gpu, error));
    for (;;) {
        HD_TRY(check_cancelled(in_flight->of, error));
        HD_TRY(hd_wave_next(&run, taken, &renderer->frames_in_flight.size, error));
        if (step->action == HD_WAVE_IS_DONE)
            return HD_OK;
        report_step(in_flight, step);
        HD_TRY(step->action == HD_WAVE_STORES
                   ? store_batch(renderer, in_flight, step, error)
                   : trace_step(renderer, in_flight, step, max_groups, &taken, error));
    }
}

static HdStatus launch_sum(HdGpuRenderer *renderer, HdGpuFrameInFlight *in_flight, int count_slots,
                           HdError *error) {
    const SumCounts own = {.counts = &renderer->counts,
                           .count = count_slots,
                           .sums = &in_flight->sums,
                           .workers = HD_SUM_WORKERS};
    HdGpuLaunch launch = launch_of(renderer, HD_KERNEL_SUM);
    add_sum_counts(&launch, &own);
    launch.groups = (own.workers + launch.group_size - 1) / launch.group_size;
    return queue_launch(renderer, &launch, &in_flight->summed, error);
}

static HdStatus trace(HdGpuRenderer *renderer, HdGpuFrameInFlight *in_flight, int count_slots,
                      HdError *error) {
    hd_launch_size_begin_frame(&renderer->frames_in_flight.size);
    if (!renderer->program.cache.shape.wavefront)
        HD_TRY(launch_mega(renderer, in_flight, error));
    else if (renderer->has_groups)
        HD_TRY(launch_waves(renderer, in_flight, count_slots, error));
    else
        HD_TRY(launch_workers(renderer, in_flight, error));
    return launch_sum(renderer, in_flight, count_slots, error);
}

/* ---- 8-bit pixels ---- */

static HdStatus write_thresholds(HdGpuRenderer *renderer, HdCurve curve, HdError *error) {
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

static HdStatus encode(HdGpuRenderer *renderer, HdGpuFrameInFlight *in_flight, HdCurve curve,
                       HdError *error) {
    const Encode own = {.pixels = &in_flight->pixels,
                        .count = in_flight->of->width * in_flight->of->height,
                        .thresholds = &renderer->thresholds,
                        .image = &in_flight->image};
    HdGpuLaunch launch = launch_of(renderer, HD_KERNEL_ENCODE);
    HD_TRY(write_thresholds(renderer, curve, error));
    add_encode(&launch, &own);
    launch.groups = group_count(renderer, own.count, launch.group_size);
    return queue_launch(renderer, &launch, &in_flight->encoded, error);
}

/* ---- frames ---- */

static HdStatus reserve_queue(HdGpuRenderer *renderer, const HdGpuFrameInFlight *in_flight,
                              HdError *error) {
    const HdKernelShape *shape = &renderer->program.cache.shape;
    int items = in_flight->items, per_item = samples_per_item(renderer, in_flight);
    bool has_groups = renderer->has_groups;
    HdWaveNeeds needs = {
        .bytes = renderer->queue.bytes,
        .precision = shape->precision,
        .depth = renderer->depth,
        .grain = has_groups ? renderer->program.group_size : shape->lanes,
        .samples_at_once = has_groups ? per_item : HD_WAVE_PACKET,
        .samples = has_groups ? hd_wave_samples(items, per_item) : per_item,
    };
    return hd_gpu_wave_queue_reserve(&renderer->queue, &renderer->gpu, &needs,
                                     worker_count(renderer, items), error);
}

/* `from` must live until the copy is done. */
static HdStatus write_frame_table(HdGpuRenderer *renderer, int table, const void *from,
                                  size_t bytes, HdError *error) {
    return hd_gpu_write_table(&renderer->gpu, &renderer->frame[table], from, bytes,
                              "tables of the frame", error);
}

static HdStatus write_frame(HdGpuRenderer *renderer, HdGpuFrameInFlight *in_flight,
                            HdError *error) {
    char *from = in_flight->tables.data;
    for (int i = 0; i < HD_FRAME_TABLE_COUNT; i++) {
        const HdTable *table = &in_flight->of->table[i];
        if (table->bytes > 0)
            memcpy(from, table->data, table->bytes);
        HD_TRY(write_frame_table(renderer, i, from, table->bytes, error));
        from += table->bytes;
    }
    return HD_OK;
}

/* Some items are reported one by one. */
HdStatus hd_gpu_launch_frame(HdGpuRenderer *renderer, HdGpuFrameInFlight *in_flight, HdCurve curve,
                             HdError *error) {
    const HdGpuProgram *program = &renderer->program;
    int count_slots = in_flight->items;
    if (program->cache.shape.wavefront)
        HD_TRY(reserve_queue(renderer, in_flight, error));
    if (program->cache.shape.wavefront && renderer->has_groups)
        count_slots =
            hd_wave_groups(&renderer->queue.plan, program->group_size, renderer->options.grid);
    HD_TRY(write_frame(renderer, in_flight, error));
    HD_TRY(hd_gpu_reserve(&renderer->gpu, &renderer->counts, HD_GPU_DEVICE,
                          sizeof(HdRayCounts) * (size_t)count_slots, "counts of the work items",
                          error));
    HD_TRY(trace(renderer, in_flight, count_slots, error));
    return in_flight->encodes ? encode(renderer, in_flight, curve, error) : HD_OK;
}

/* ---- first hits ---- */

/* A sample costs less here than in tracing, from which the launch size is learned: launches are
   short enough. */
static HdStatus launch_first_hits(HdGpuRenderer *renderer, const HdFrameTables *tables, int items,
                                  int floats, HdError *error) {
    enum { MAX_THREADS = 64 }; /* of a group, whose threads share nothing */
    HdGpuLaunch launch = tracing_of(renderer, HD_KERNEL_FIRST_HITS);
    FirstHits own = {.floats = floats, .hits = &renderer->first_hits};
    const HdGpu *gpu = &renderer->gpu;
    int work = renderer->program.cache.shape.pixels_per_item * (tables->samples + 1);
    add_first_hits(&launch, &own);
    launch.group_size = hd_min(launch.group_size, MAX_THREADS);
    for (int done = 0; done < items; done += own.item_count) {
        if (done > 0) {
            HD_TRY(gpu->driver->wait_for_launch(gpu->handle, &renderer->first_hits_found, error));
            HD_TRY(check_cancelled(tables, error));
        }
        own.first_item = done;
        own.item_count = hd_launch_size_items(&renderer->frames_in_flight.size, items - done, work,
                                              launch.group_size);
        launch.groups = group_count(renderer, own.item_count, launch.group_size);
        HD_TRY(queue_launch(renderer, &launch, &renderer->first_hits_found, error));
    }
    return HD_OK;
}

HdStatus hd_gpu_find_first_hits(HdGpuRenderer *renderer, const HdFrameTables *tables,
                                HdFrame *frame, HdError *error) {
    const HdGpu *gpu = &renderer->gpu;
    const size_t pixels = (size_t)tables->width * (size_t)tables->height;
    const size_t bytes = pixels * (size_t)frame->first_floats * sizeof *frame->first;
    const int items = hd_kernel_item_count(tables->width, tables->height,
                                           renderer->program.cache.shape.pixels_per_item);
    HD_TRY(hd_gpu_reserve(gpu, &renderer->first_hits, HD_GPU_DEVICE, bytes, "pixels' first hits",
                          error));
    for (int i = 0; i < HD_FRAME_TABLE_COUNT; i++)
        HD_TRY(
            write_frame_table(renderer, i, tables->table[i].data, tables->table[i].bytes, error));
    HD_TRY(launch_first_hits(renderer, tables, items, frame->first_floats, error));
    return gpu->driver->read(gpu->handle, &renderer->first_hits, frame->first, bytes, error);
}
