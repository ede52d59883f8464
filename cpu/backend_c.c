/* SPDX-License-Identifier: MIT */
/* The plain C backend: the shared kernels in loops over blocks of pixels, on a pool of threads. */
#define _GNU_SOURCE
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "../kernels/common/scene_tables.h"
#include "../src/backend.h"
#include "../src/clock.h"
#include "../src/interrupt.h"
#include "../src/kernel_source.h"
#include "instruction_set.h"
#include "kernel.h"
#include "thread_pool.h"

typedef struct CRenderer {
    HdThreadPool *pool;
    int threads;
    const HdCpuBuild *build;
    HdSceneTables scene; /* our own copy */
    HdRayCounts *counts; /* one for each item of the last frame size */
    int item_capacity;
} CRenderer;

static int core_count(void) {
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set) == 0)
        return CPU_COUNT(&set);
    long online = sysconf(_SC_NPROCESSORS_ONLN);
    return online > 0 ? (int)online : 1;
}

static HdStatus c_enumerate(HdDevice *devices, int capacity, int *count, HdError *error) {
    (void)error;
    *count = capacity > 0 ? 1 : 0;
    if (capacity < 1)
        return HD_OK;
    HdDevice *device = &devices[0];
    memset(device, 0, sizeof *device);
    device->backend = &hd_backend_c;
    hd_cpu_name(device->name, (int)sizeof device->name);
    snprintf(device->driver, sizeof device->driver, "plain C, %s, %d cores",
             hd_cpu_best_instruction_set(), core_count());
    device->is_cpu = true;
    device->has_double = true;
    return HD_OK;
}

static void c_close(void *renderer) {
    CRenderer *c = renderer;
    hd_thread_pool_destroy(c->pool);
    hd_scene_tables_free(&c->scene);
    free(c->counts);
    free(c);
}

static HdStatus c_open(const HdDevice *device, const HdRenderOptions *options, void **renderer,
                       HdError *error) {
    (void)device;
    CRenderer *c = calloc(1, sizeof *c);
    if (c == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room for a renderer");
    c->threads = options->threads > 0 ? options->threads : core_count();
    c->build = hd_cpu_find_build(options->lanes, options->precision, options->math);
    HdStatus status = hd_thread_pool_create(&c->pool, c->threads, error);
    if (status != HD_OK)
        c_close(c);
    else
        *renderer = c;
    return status;
}

static HdStatus copy_table(HdTable *to, const HdTable *from, HdError *error) {
    size_t bytes = (from->bytes + 63) / 64 * 64 + 64;
    to->data = aligned_alloc(64, bytes);
    if (to->data == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: the scene needs a table of %zu bytes",
                       from->bytes);
    memcpy(to->data, from->data, from->bytes);
    to->bytes = from->bytes;
    return HD_OK;
}

static HdStatus c_upload(void *renderer, const HdSceneTables *tables, HdError *error) {
    CRenderer *c = renderer;
    hd_scene_tables_free(&c->scene);
    c->scene = *tables;
    c->scene.table_count = 0;
    for (int i = 0; i < tables->table_count; i++) {
        HdStatus status = copy_table(&c->scene.table[i], &tables->table[i], error);
        if (status != HD_OK)
            return status;
        c->scene.table_count++;
    }
    return HD_OK;
}

static HdStatus reserve_counts(CRenderer *c, int items, HdError *error) {
    if (items <= c->item_capacity)
        return HD_OK;
    free(c->counts);
    c->item_capacity = 0;
    c->counts = calloc((size_t)items, sizeof *c->counts);
    if (c->counts == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room for %d work items", items);
    c->item_capacity = items;
    return HD_OK;
}

typedef struct FrameWork {
    CRenderer *c;
    const HdFrameTables *tables;
    float *pixels;
} FrameWork;

static void render_one_item(void *context, int item) {
    FrameWork *work = context;
    work->c->build->kernel(work->c->scene.table, work->tables->table, item, work->pixels,
                           work->c->counts);
}

static bool is_interrupted(void) {
    return hd_interrupt_signal() != 0;
}

static HdStatus c_render(void *renderer, const HdFrameTables *tables, HdFrame *frame,
                         HdError *error) {
    CRenderer *c = renderer;
    int items = hd_kernel_item_count(tables->width, tables->height, HD_BLOCK_PIXELS);
    HdStatus status = reserve_counts(c, items, error);
    if (status != HD_OK)
        return status;
    FrameWork work = {c, tables, frame->rgb};
    double start = hd_monotonic_seconds();
    if (!hd_thread_pool_run(c->pool, items, render_one_item, &work, is_interrupted))
        return hd_fail(error, HD_INTERRUPTED, "interrupted in the midst of a frame");
    frame->trace_seconds = hd_monotonic_seconds() - start;
    hd_frame_set_counts(frame, tables->samples_per_side, c->counts, items);
    return HD_OK;
}

static void c_describe(const void *renderer, char *text, int capacity) {
    const CRenderer *c = renderer;
    snprintf(text, (size_t)capacity, "%d lanes, %s, %d thread%s", c->build->lanes,
             c->build->instruction_set, c->threads, c->threads == 1 ? "" : "s");
}

const HdBackend hd_backend_c = {
    .name = "c",
    .enumerate = c_enumerate,
    .open = c_open,
    .upload = c_upload,
    .render = c_render,
    .describe = c_describe,
    .close = c_close,
};
