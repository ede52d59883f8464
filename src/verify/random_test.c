/* SPDX-License-Identifier: MIT */
#include "verify/random_test.h"

#include <inttypes.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>

#include "system/interrupt.h"
#include "system/machine.h"
#include "system/thread_pool.h"
#include "verify/first_difference.h"
#include "verify/trust.h"

enum { DEVICE, PLAIN_C, SIDES };
enum { ALL = -1, MOST_WORKERS = 16 };

typedef struct Worker {
    HdRenderer *renderers[SIDES];
    int kind; /* whose kernels the device's renderer has; ALL: none yet */
} Worker;

typedef struct Run {
    const HdRandomTest *test;
    HdDevice plain;
    Worker *workers;
    int worker_count;
    pthread_mutex_t mutex; /* of what follows, and so that kernels are compiled once */
    HdRandomResult *result;
    HdStatus status; /* the first failure's */
    HdError *error;
    atomic_bool has_failed; /* then nothing more is begun */
} Run;

/* Pixels of a surveyed scene have other sizes: kernels for them are for no other scene. */
static const HdSceneTables *needs_of(const HdRandomTest *test, int kind) {
    static const HdSceneTables general = {.plane_count = 32,
                                          .depth = 32,
                                          .node_stack = 32,
                                          .refracts = true,
                                          .lit_from_behind = true};
    return test->general ? &general : &hd_random_kinds[kind].needs;
}

/* ---- one scene ---- */

static HdStatus render(const Run *run, HdRenderer *renderer, const HdScene *scene,
                       const HdCamera *camera, int kind, uint64_t *hash, HdError *error) {
    HdFrame frame;
    HdStatus status =
        hd_put_and_render(renderer, scene, camera, needs_of(run->test, kind), 0, &frame, error);
    if (status != HD_OK)
        return status;
    *hash = hd_frame_hash(&frame);
    hd_frame_free(&frame);
    return HD_OK;
}

/* The first renderer that needs kernels compiles them and keeps them for the others. */
static HdStatus render_on_device(Run *run, Worker *worker, const HdScene *scene,
                                 const HdCamera *camera, int kind, uint64_t *hash, HdError *error) {
    bool has_kernels = worker->kind == kind;
    if (!has_kernels)
        pthread_mutex_lock(&run->mutex);
    HdStatus status = render(run, worker->renderers[DEVICE], scene, camera, kind, hash, error);
    if (!has_kernels)
        pthread_mutex_unlock(&run->mutex);
    worker->kind = kind;
    return status;
}

static HdStatus compare(Run *run, Worker *worker, uint64_t seed, bool *differs, HdError *error) {
    HdScene scene;
    HdCamera camera;
    uint64_t found = 0, expected = 0;
    int kind = hd_random_kind_of(seed);
    hd_random_scene(seed, &scene, &camera);
    HdStatus status = render_on_device(run, worker, &scene, &camera, kind, &found, error);
    if (status == HD_OK)
        status = render(run, worker->renderers[PLAIN_C], &scene, &camera, kind, &expected, error);
    hd_scene_free(&scene);
    *differs = found != expected;
    return status;
}

/* ---- all of them ---- */

static void note(Run *run, uint64_t seed, HdStatus status, bool differs, const HdError *error) {
    HdRandomResult *result = run->result;
    pthread_mutex_lock(&run->mutex);
    if (status != HD_OK && run->status == HD_OK) {
        run->status = status;
        *run->error = *error;
        run->has_failed = true;
    }
    result->scenes += status == HD_OK;
    if (status == HD_OK && differs) {
        if (result->different == 0 || seed < result->first_seed)
            result->first_seed = seed;
        result->different++;
    }
    pthread_mutex_unlock(&run->mutex);
}

/* Scene by scene of a kind, since its kernels are at hand. */
static void work(void *context, int thread, int number) {
    Run *run = context;
    const HdRandomTest *test = run->test;
    (void)thread;
    for (int kind = 0; kind < HD_RANDOM_KINDS; kind++)
        for (int i = number; i < test->scenes; i += run->worker_count) {
            HdError error;
            uint64_t seed = test->seed + (uint64_t)i;
            bool differs = false;
            if (hd_random_kind_of(seed) != kind || (test->kind != ALL && test->kind != kind))
                continue;
            HdStatus status = hd_interrupt_signal() != 0
                                  ? hd_fail(&error, HD_INTERRUPTED, "interrupted")
                                  : compare(run, &run->workers[number], seed, &differs, &error);
            note(run, seed, status, differs, &error);
            if (run->has_failed)
                return;
        }
}

static bool has_failed(const void *context) {
    return ((const Run *)context)->has_failed;
}

static HdStatus open_workers(Run *run, HdError *error) {
    const HdRandomTest *test = run->test;
    const HdRenderOptions plain = {.precision = test->options.precision, .threads = 1};
    HdRenderOptions options = test->options;
    options.test.keeps_pipeline = true;
    HdStatus status = HD_OK;
    for (int i = 0; status == HD_OK && i < run->worker_count; i++) {
        Worker *worker = &run->workers[i];
        worker->kind = ALL;
        status = hd_renderer_open(&worker->renderers[DEVICE], test->device, &options, error);
        if (status == HD_OK)
            status = hd_renderer_open(&worker->renderers[PLAIN_C], &run->plain, &plain, error);
    }
    return status;
}

static void close_workers(Run *run) {
    for (int i = 0; i < run->worker_count; i++)
        for (int side = 0; side < SIDES; side++)
            hd_renderer_close(run->workers[i].renderers[side]);
}

static HdStatus run_workers(Run *run, HdError *error) {
    HdThreadPool *pool;
    HdStatus status = open_workers(run, error);
    if (status == HD_OK)
        status = hd_thread_pool_create(&pool, run->worker_count, error);
    if (status == HD_OK) {
        hd_thread_pool_run(pool, run->worker_count, work, run, has_failed);
        hd_thread_pool_destroy(pool);
        status = run->status;
    }
    close_workers(run);
    return status;
}

/* ---- what differs ---- */

static HdStatus build(const void *what, HdScene *scene, HdCamera *camera, HdError *error) {
    const HdRandomResult *result = what;
    (void)error;
    hd_random_scene(result->first_seed, scene, camera);
    return HD_OK;
}

/* Where the search fails, that a scene differs is told all the same. */
static HdStatus tell_difference(const HdRandomTest *test, HdRandomResult *result, HdError *error) {
    char text[sizeof result->text / 2];
    int kind = hd_random_kind_of(result->first_seed);
    const HdDispute dispute = {test->device, &test->options, needs_of(test, kind), build, result};
    HdStatus status = hd_first_difference(&dispute, text, sizeof text, error);
    snprintf(result->text, sizeof result->text, "the scene of seed %" PRIu64 " (%s): %s%.400s",
             result->first_seed, hd_random_kinds[kind].name,
             status != HD_OK   ? "where it differs could not be found out: "
             : text[0] != '\0' ? ""
                               : "asked again it renders as plain C does",
             status != HD_OK ? error->message : text);
    return status == HD_INTERRUPTED ? status : HD_OK;
}

HdStatus hd_random_test(const HdRandomTest *test, HdRandomResult *result, HdError *error) {
    Run run = {.test = test, .result = result, .error = error};
    int count;
    *result = (HdRandomResult){0};
    HdStatus status = hd_backend_enumerate(hd_backend_always_there(), &run.plain, 1, &count, error);
    if (status != HD_OK)
        return status;
    run.worker_count = test->threads > 0 ? test->threads : hd_processor_count();
    if (run.worker_count > MOST_WORKERS)
        run.worker_count = MOST_WORKERS;
    run.workers = calloc((size_t)run.worker_count, sizeof *run.workers);
    if (run.workers == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room for %d threads", run.worker_count);
    pthread_mutex_init(&run.mutex, NULL);
    status = run_workers(&run, error);
    pthread_mutex_destroy(&run.mutex);
    free(run.workers);
    if (status == HD_INTERRUPTED || result->different == 0)
        return status;
    HdError later; /* the first failure is told */
    HdStatus told = tell_difference(test, result, &later);
    return status == HD_OK ? told : status;
}
