/* SPDX-License-Identifier: MIT */
/* The plain C backend: the shared kernels in loops over blocks of pixels, on a pool of threads. */
#define _GNU_SOURCE
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/growth.h"
#include "base/text.h"
#include "cpu/kernel.h"
#include "device/kernel_source.h"
#include "device/launch_plan.h"
#include "device/renderer.h"
#include "generated/cpu_builds.h"
#include "kernels/host/shared.h"
#include "system/interrupt.h"
#include "system/machine.h"
#include "system/processor.h"
#include "system/thread_pool.h"
#include "tables/table.h"

/* ---- builds of the kernels ---- */

typedef struct CpuBuild {
    const char *instruction_set; /* "avx512", "avx2", "neon" or "generic" */
    int lanes;
    HdPrecision precision;
    HdCpuKernel *kernel;
    HdCpuKernel *plain_kernel; /* for plain scenes, or NULL */
    HdCpuFirstHits *first_hits;
} CpuBuild;

#define DECLARE_KERNEL(kernel) HdCpuKernel kernel;
HD_CPU_KERNELS(DECLARE_KERNEL)
#define DECLARE_FIRST_HITS(set, lanes, precision, kernel, plain_kernel)                            \
    HdCpuFirstHits kernel##_first_hits;
HD_CPU_BUILDS(DECLARE_FIRST_HITS)

#define LIST_BUILD(set, lanes, precision, kernel, plain_kernel)                                    \
    {#set, lanes, HD_PRECISION_##precision, kernel, plain_kernel, kernel##_first_hits},
static const CpuBuild builds[] = {HD_CPU_BUILDS(LIST_BUILD)};
enum { BUILD_COUNT = sizeof builds / sizeof builds[0] };

static bool is_supported(const char *set) {
#ifdef HD_CPU_X86
    bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    if (strcmp(set, "avx512") == 0)
        return avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
               __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw");
    if (strcmp(set, "avx2") == 0)
        return avx2;
#endif
    return strcmp(set, "neon") == 0 || strcmp(set, "generic") == 0;
}

const char *hd_cpu_best_instruction_set(void) {
    for (size_t i = 0;; i++)
        if (is_supported(builds[i].instruction_set))
            return builds[i].instruction_set;
}

/* Returns the best build with `lanes` lanes, 0: any count; NULL if there is none. */
static const CpuBuild *find_build(int lanes, HdPrecision precision) {
    for (const CpuBuild *build = builds; build < builds + BUILD_COUNT; build++)
        if ((lanes == 0 || build->lanes == lanes) && build->precision == precision &&
            is_supported(build->instruction_set))
            return build;
    return NULL;
}

/* Returns the lane counts for HdDevice.lanes. */
static int offered_lanes(HdPrecision precision) {
    int offered = 0;
    for (const CpuBuild *build = builds; build < builds + BUILD_COUNT; build++)
        if (build->precision == precision && is_supported(build->instruction_set))
            offered |= build->lanes;
    return offered;
}

/* ---- the backend ---- */

/* A thread's rays should fit in its core's cache. */
enum { QUEUE_BYTES = 512 << 10 };

typedef struct CRenderer {
    HdThreadPool *pool;
    int threads;
    HdPipeline pipeline;
    size_t queue_budget; /* bytes for each thread */
    HdCpuQueue *queues;  /* one for each thread; the first one owns their memory */
    size_t queue_bytes;  /* bytes of all queues */
    const CpuBuild *build;
    HdCpuKernel *kernel; /* kernel of the build for the scene */
    HdSceneTables scene; /* owned copy */
    HdRayCounts *counts; /* one for each item of the last frame size */
    int item_capacity;
} CRenderer;

static void describe_cores(char *text, size_t capacity) {
    const HdCores cores = hd_processor_cores("");
    const char *set = hd_cpu_best_instruction_set();
    if (cores.little > 0)
        snprintf(text, capacity, "plain C, %s, %d big and %d little cores", set, cores.big,
                 cores.little);
    else
        snprintf(text, capacity, "plain C, %s, %d cores", set, cores.big);
}

static HdStatus c_enumerate(HdDevice *devices, int capacity, int *count, HdError *error) {
    (void)error;
    *count = capacity > 0 ? 1 : 0;
    if (capacity < 1)
        return HD_OK;
    HdDevice *device = &devices[0];
    *device = (HdDevice){.is_cpu = true, .has_double = true};
    hd_processor_name("", device->name, sizeof device->name);
    describe_cores(device->driver, sizeof device->driver);
    for (int p = HD_PRECISION_FLOAT; p <= HD_PRECISION_DOUBLE; p++)
        device->lanes[p] = offered_lanes((HdPrecision)p);
    return HD_OK;
}

static void c_close(void *renderer) {
    CRenderer *c = renderer;
    hd_thread_pool_destroy(c->pool);
    hd_scene_tables_free(&c->scene);
    if (c->queues != NULL)
        free(c->queues[0].reals);
    free(c->queues);
    free(c->counts);
    free(c);
}

static HdStatus c_open(const HdDevice *device, const HdRenderOptions *options, void **renderer,
                       HdError *error) {
    (void)device;
    CRenderer *c = calloc(1, sizeof *c);
    if (c == NULL)
        return HD_NO_ROOM(error, "a renderer");
    c->threads = options->threads > 0 ? options->threads : hd_processor_count();
    c->pipeline = options->pipeline;
    c->queue_budget = options->test.queue_bytes > 0 ? options->test.queue_bytes : QUEUE_BYTES;
    c->build = find_build(options->lanes, options->precision);
    if (options->math == HD_MATH_FAST)
        hd_fallback_note(
            "the C backend has only strict arithmetic, so --math fast has no effect on it");
    const bool has_queues = hd_pipeline_is_wavefront(c->pipeline);
    c->queues = has_queues ? calloc((size_t)c->threads, sizeof *c->queues) : NULL;
    HdStatus status = has_queues && c->queues == NULL
                          ? HD_NO_ROOM(error, "%d queues", c->threads)
                          : hd_thread_pool_create(&c->pool, c->threads, error);
    if (status != HD_OK) {
        c_close(c);
        return status;
    }
    c->threads = hd_thread_pool_size(c->pool);
    *renderer = c;
    return HD_OK;
}

static HdStatus copy_table(HdTable *to, const HdTable *from, const char *content, HdError *error) {
    char need[HD_BYTE_TEXT_SIZE];
    hd_byte_text((double)from->bytes, need);
    to->data = hd_large_allocate(from->bytes);
    if (to->data == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: a copy of the scene's %s needs %s",
                       content, need);
    memcpy(to->data, from->data, from->bytes);
    to->bytes = from->bytes;
    return HD_OK;
}

static HdStatus c_upload(void *renderer, const HdSceneTables *tables, HdError *error) {
    CRenderer *c = renderer;
    const bool is_plain = tables->node_stack == 0 && !tables->refracts &&
                          !tables->lit_from_behind && !tables->environment;
    hd_scene_tables_free(&c->scene);
    c->kernel =
        is_plain && c->build->plain_kernel != NULL ? c->build->plain_kernel : c->build->kernel;
    c->scene = *tables;
    c->scene.table_count = 0;
    for (int i = 0; i < tables->table_count; i++) {
        HD_TRY(copy_table(&c->scene.table[i], &tables->table[i], hd_scene_table_content(i), error));
        c->scene.table_count++;
    }
    return HD_OK;
}

static HdStatus reserve_queues(CRenderer *c, size_t bytes, HdError *error) {
    if (bytes <= c->queue_bytes)
        return HD_OK;
    free(c->queues[0].reals);
    c->queue_bytes = 0;
    c->queues[0].reals = aligned_alloc(64, bytes);
    if (c->queues[0].reals == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: the queues of rays need %zu bytes", bytes);
    memset(c->queues[0].reals, 0, bytes);
    c->queue_bytes = bytes;
    return HD_OK;
}

/* Returns `bytes` rounded up to cache lines. */
static size_t padded(size_t bytes) {
    return (bytes + 63) / 64 * 64;
}

static HdStatus prepare_queues(CRenderer *c, int samples, HdError *error) {
    HdWaveNeeds needs = {
        .bytes = c->queue_budget,
        .precision = c->build->precision,
        .depth = c->scene.depth,
        .grain = c->build->lanes,
        .samples = HD_BLOCK_PIXELS * samples,
        .samples_at_once = HD_WAVE_PACKET,
    };
    HdWavePlan plan = hd_wave_plan(&needs);
    size_t ints = padded(plan.bytes[0]), sums = ints + padded(plan.bytes[1]);
    size_t each = sums + padded(plan.bytes[2]);
    HD_TRY(reserve_queues(c, each * (size_t)c->threads, error));
    char *memory = c->queues[0].reals;
    for (int i = 0; i < c->threads; i++, memory += each) {
        HdCpuQueue *queue = &c->queues[i];
        queue->compact = c->pipeline == HD_PIPELINE_WAVEFRONT;
        queue->reals = memory;
        queue->ints = (int *)(void *)(memory + ints);
        queue->sums = (int64_t *)(void *)(memory + sums);
        queue->queue_stride = plan.queue_stride;
        queue->sum_stride = plan.sum_stride;
    }
    return HD_OK;
}

/* Does nothing: c_collect renders the frame. */
static HdStatus c_submit(void *renderer, const HdFrameTables *tables, const HdFrameRequest *request,
                         HdError *error) {
    (void)renderer, (void)tables, (void)request, (void)error;
    return HD_OK;
}

static void c_drop(void *renderer) {
    (void)renderer;
}

typedef struct FrameWork {
    CRenderer *c;
    const HdFrameTables *tables;
    int items;
    HdFrame *frame;
} FrameWork;

static void render_one_item(void *context, int thread, int item) {
    FrameWork *work = context;
    CRenderer *c = work->c;
    c->kernel(c->scene.table, work->tables->table, item,
              c->queues != NULL ? &c->queues[thread] : NULL, work->frame->rgb, c->counts);
    hd_watched_add(&work->tables->watched, item, item + 1, work->items);
}

static bool must_stop(const void *context) {
    const FrameWork *work = context;
    return hd_interrupt_signal() != 0 || hd_watched_is_cancelled(&work->tables->watched);
}

static int count_items(const HdFrameTables *tables) {
    return hd_kernel_item_count(tables->width, tables->height, HD_BLOCK_PIXELS);
}

static HdStatus run_items(CRenderer *c, const HdFrameTables *tables, HdFrame *frame,
                          HdThreadWork *render, HdError *error) {
    FrameWork work = {c, tables, count_items(tables), frame};
    return hd_thread_pool_run(c->pool, work.items, render, &work, must_stop)
               ? HD_OK
               : hd_fail(error, HD_INTERRUPTED, "interrupted in the midst of a frame");
}

static HdStatus c_collect(void *renderer, const HdFrameTables *tables, HdFrame *frame,
                          HdError *error) {
    CRenderer *c = renderer;
    const int items = count_items(tables);
    c->counts = hd_reserved(c->counts, sizeof *c->counts, items, &c->item_capacity);
    if (c->counts == NULL)
        return HD_NO_ROOM(error, "%d work items", items);
    if (c->queues != NULL)
        HD_TRY(prepare_queues(c, tables->samples, error));
    double start = hd_monotonic_seconds();
    HD_TRY(run_items(c, tables, frame, render_one_item, error));
    frame->is_encoded = false;
    frame->longest_launch = -1.0;
    frame->trace_seconds = hd_monotonic_seconds() - start;
    hd_frame_set_counts(frame, tables->samples, c->counts, items);
    return HD_OK;
}

static void find_in_one_item(void *context, int thread, int item) {
    const FrameWork *work = context;
    const CRenderer *c = work->c;
    (void)thread;
    c->build->first_hits(c->scene.table, work->tables->table, item, work->frame->first_floats,
                         work->frame->first);
}

static HdStatus c_first_hits(void *renderer, const HdFrameTables *tables, HdFrame *frame,
                             HdError *error) {
    return run_items(renderer, tables, frame, find_in_one_item, error);
}

static int c_lanes(const void *renderer) {
    return ((const CRenderer *)renderer)->build->lanes;
}

static void c_describe(const void *renderer, char *text, int capacity) {
    const CRenderer *c = renderer;
    snprintf(text, (size_t)capacity, "%d lanes, %s, %d thread%s, %s", c->build->lanes,
             c->build->instruction_set, c->threads, hd_plural(c->threads),
             hd_pipeline_names[c->pipeline]);
}

static const HdRendererFunctions functions = {
    .open = c_open,
    .upload = c_upload,
    .submit = c_submit,
    .collect = c_collect,
    .first_hits = c_first_hits,
    .drop = c_drop,
    .lanes = c_lanes,
    .describe = c_describe,
    .close = c_close,
};

const HdBackend hd_backend_c = {
    .name = "c",
    .needs_no_driver = true,
    .uses_host_threads = true,
    .functions = &functions,
    .enumerate = c_enumerate,
};
