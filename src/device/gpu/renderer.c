/* SPDX-License-Identifier: MIT */
/* The renderer over a GPU driver. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "device/gpu/gpu.h"
#include "kernels/host/shared.h"
#include "system/interrupt.h"
#include "system/machine.h"
#include "tables/table.h"

/* Bytes of a wavefront's queue: on CPUs for each worker, otherwise at most. */
enum { CPU_QUEUE_BYTES = 512 << 10, GROUPS_QUEUE_BYTES = 1 << 30 };

static HdStatus enter(const HdGpuRenderer *renderer, HdError *error) {
    const HdGpu *gpu = &renderer->gpu;
    return gpu->driver->enter != NULL ? gpu->driver->enter(gpu->handle, error) : HD_OK;
}

/* ---- open and close ---- */

static void choose_shape(HdGpuRenderer *renderer) {
    const HdGpu *gpu = &renderer->gpu;
    const HdRenderOptions *options = &renderer->options;
    HdKernelShape *shape = &renderer->program.cache.shape;
    bool has_groups = renderer->has_groups;
    /* As many lanes as a register has, within HD_LANE_COUNTS. */
    int width = gpu->facts.native_lanes[options->precision];
    int lanes = has_groups ? 1 : width >= 16 ? 16 : width >= 8 ? 8 : 4;
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

static size_t queue_bytes(const HdGpuRenderer *renderer) {
    const uint64_t share = renderer->gpu.facts.memory / 8;
    if (renderer->options.test.queue_bytes > 0)
        return renderer->options.test.queue_bytes;
    if (!renderer->has_groups)
        return CPU_QUEUE_BYTES;
    return share < GROUPS_QUEUE_BYTES ? (size_t)share : GROUPS_QUEUE_BYTES;
}

static HdStatus gpu_open(const HdDevice *device, const HdRenderOptions *options, void **state,
                         HdError *error) {
    const HdGpuDriver *driver = device->backend->driver;
    HdGpuRenderer *renderer = calloc(1, sizeof *renderer + driver->bytes);
    if (!renderer)
        return HD_NO_ROOM(error, "a renderer");
    HdGpu *gpu = &renderer->gpu;
    renderer->device = *device;
    renderer->options = *options;
    *gpu = (HdGpu){.driver = driver, .handle = renderer + 1, .name = renderer->device.name};
    HdStatus status = driver->open(gpu->handle, &renderer->device, &gpu->facts, error);
    if (status != HD_OK) {
        free(renderer);
        return status;
    }
    hd_kernel_cache_begin(&renderer->program.cache, device->backend->name, device->name,
                          device->driver);
    renderer->has_groups = !device->is_cpu || options->test.groups;
    choose_shape(renderer);
    renderer->queue.bytes = queue_bytes(renderer);
    *state = renderer;
    return HD_OK;
}

static void release_all(HdGpuRenderer *renderer) {
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
    hd_gpu_frames_in_flight_close(renderer);
    gpu->driver->unload(gpu->handle);
}

static void gpu_close(void *state) {
    HdGpuRenderer *renderer = state;
    HdError ignored;
    if (enter(renderer, &ignored) == HD_OK)
        release_all(renderer);
    renderer->gpu.driver->close(renderer->gpu.handle);
    free(renderer);
}

/* ---- upload ---- */

/* Places the table in constant or global memory, as the kernels were compiled for. */
static void place_table(HdGpuRenderer *renderer, HdGpuMemory *memory, const char *name) {
    const HdGpu *gpu = &renderer->gpu;
    HdGpuMemory constant = {0};
    bool has_memory = renderer->program.cache.shape.needs.small_tables &&
                      gpu->driver->constant != NULL &&
                      gpu->driver->constant(gpu->handle, name, &constant);
    if (has_memory || memory->is_constant) {
        hd_gpu_release(gpu, memory);
        *memory = constant;
    }
}

static void place_tables(HdGpuRenderer *renderer) {
#define PLACE_OF_SCENE(type, name, rows)                                                           \
    place_table(renderer, &renderer->scene[HD_TABLE_##name], #name);
#define PLACE_OF_FRAME(type, name, rows)                                                           \
    place_table(renderer, &renderer->frame[HD_TABLE_##name], #name);
    HD_SMALL_SCENE_TABLES(PLACE_OF_SCENE)
    HD_SMALL_FRAME_TABLES(PLACE_OF_FRAME)
}

static HdStatus write_scene(HdGpuRenderer *renderer, const HdSceneTables *tables, HdError *error) {
    for (int i = 0; i < HD_SCENE_TABLE_COUNT; i++) {
        const HdTable *table = &tables->table[i];
        char what[64];
        snprintf(what, sizeof what, "scene's %s", hd_scene_table_content(i));
        HD_TRY(hd_gpu_write_table(&renderer->gpu, &renderer->scene[i], table->data, table->bytes,
                                  what, error));
    }
    return HD_OK;
}

static HdStatus gpu_upload(void *state, const HdSceneTables *tables, HdError *error) {
    HdGpuRenderer *renderer = state;
    const HdGpu *gpu = &renderer->gpu;
    const double longest = hd_longest_launch(&renderer->device, &renderer->options);
    const int work = renderer->options.test.launch_work;
    HdKernelNeeds needs = hd_kernel_needs(tables);
    const HdMemoryBudget capacity = {.name = gpu->name,
                                     .advice = hd_budget_advice,
                                     .memory = (double)gpu->facts.memory,
                                     .at_once = (double)gpu->facts.at_once};
    HdError later;
    renderer->depth = tables->depth;
    renderer->frames_in_flight.size =
        work > 0 ? hd_launch_size_fixed(work)
                 : hd_launch_size_start(renderer->device.compute_units, longest);
    needs.small_tables = needs.small_tables && gpu->driver->constant != NULL;
    HD_TRY(enter(renderer, error));
    HD_TRY(hd_check_budget(tables, &capacity, error));
    HD_TRY(hd_gpu_build(&renderer->program, gpu, &needs, error));
    place_tables(renderer);
    HdStatus status = write_scene(renderer, tables, error);
    /* Also after a failure: pending copies read the tables, which are the caller's. */
    HdStatus finished = gpu->driver->finish(gpu->handle, status == HD_OK ? error : &later);
    return status == HD_OK ? finished : status;
}

/* ---- frames ---- */

/* CPUs have no bus to cross, and the host's conversion is as fast. */
static HdStatus gpu_submit(void *state, const HdFrameTables *tables, const HdFrameRequest *request,
                           HdError *error) {
    HdGpuRenderer *renderer = state;
    HdGpuFrameInFlight *in_flight;
    bool encodes = renderer->has_groups && !request->radiance;
    int items = hd_kernel_item_count(tables->width, tables->height,
                                     renderer->program.cache.shape.pixels_per_item);
    HD_TRY(enter(renderer, error));
    HdStatus status = hd_gpu_frame_begin(renderer, tables, items, encodes, &in_flight, error);
    if (status == HD_OK)
        status = hd_gpu_launch_frame(renderer, in_flight, request->curve, error);
    if (status == HD_OK)
        status = hd_gpu_frame_send(renderer, in_flight, error);
    if (status != HD_OK) /* the next frame uses the same memory */
        renderer->gpu.driver->drain(renderer->gpu.handle);
    return status;
}

/* Frames retire in their order. Launches on a CPU block no display: ignores their times. */
static HdStatus gpu_collect(void *state, const HdFrameTables *tables, HdFrame *frame,
                            HdError *error) {
    HdGpuRenderer *renderer = state;
    (void)tables;
    HdStatus status = enter(renderer, error);
    if (status == HD_OK)
        status = hd_gpu_frame_collect(renderer, frame, error);
    if (!renderer->has_groups)
        frame->longest_launch = -1.0;
    return status;
}

/* The launches follow those of the frames in flight, whose tables they may replace. */
static HdStatus gpu_first_hits(void *state, const HdFrameTables *tables, HdFrame *frame,
                               HdError *error) {
    HdGpuRenderer *renderer = state;
    HdError later;
    HD_TRY(enter(renderer, error));
    HdStatus status = hd_gpu_find_first_hits(renderer, tables, frame, error);
    if (status != HD_OK) /* pending copies read the tables, which are the caller's */
        renderer->gpu.driver->finish(renderer->gpu.handle, &later);
    return status;
}

static void gpu_drop(void *state) {
    HdGpuRenderer *renderer = state;
    HdError ignored;
    if (enter(renderer, &ignored) != HD_OK)
        return;
    renderer->gpu.driver->drain(renderer->gpu.handle);
    renderer->frames_in_flight.count = 0;
}

/* ---- the arithmetic probe ---- */

static HdStatus gpu_probe(void *state, const HdProbeBatch *batch, HdProbeResults *results,
                          HdError *error) {
    HdGpuRenderer *renderer = state;
    HdGpuProgram *program = &renderer->program;
    HD_TRY(enter(renderer, error));
    HD_TRY(hd_gpu_build_probe(program, &renderer->gpu, error));
    return hd_gpu_run_probe(program, &renderer->gpu, batch, results, error);
}

/* ---- descriptions ---- */

static HdKernelCache *gpu_kernels(void *state) {
    HdGpuRenderer *renderer = state;
    return &renderer->program.cache;
}

static int gpu_lanes(const void *state) {
    const HdGpuRenderer *renderer = state;
    return renderer->program.cache.shape.lanes;
}

static void gpu_describe(const void *state, char *text, int capacity) {
    const HdGpuRenderer *renderer = state;
    const HdGpu *gpu = &renderer->gpu;
    const HdGpuProgram *program = &renderer->program;
    int length = gpu->driver->describe(gpu->handle, &program->cache.shape, program->group_size,
                                       hd_pipeline_names[renderer->options.pipeline],
                                       program->cache.maker, text, capacity);
    if (program->cache.shape.rounds_by_fma && length > 0 && length < capacity)
        length += snprintf(text + length, (size_t)(capacity - length), ", division by fma");
    if (renderer->queue.is_cut && length > 0 && length < capacity) {
        char memory[HD_BYTE_TEXT_SIZE];
        hd_byte_text((double)renderer->queue.bytes, memory);
        snprintf(text + length, (size_t)(capacity - length),
                 ", the queue cut to %s, since more memory was refused", memory);
    }
}

const HdRendererFunctions hd_gpu_functions = {
    .open = gpu_open,
    .upload = gpu_upload,
    .submit = gpu_submit,
    .collect = gpu_collect,
    .first_hits = gpu_first_hits,
    .drop = gpu_drop,
    .kernels = gpu_kernels,
    .probe = gpu_probe,
    .lanes = gpu_lanes,
    .describe = gpu_describe,
    .close = gpu_close,
};
