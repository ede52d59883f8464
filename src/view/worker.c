/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "view/worker.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "choice/devices.h"
#include "image/picture.h"
#include "render/frame.h"
#include "system/interrupt.h"
#include "system/machine.h"
#include "system/thread_pool.h"
#include "verify/trust.h"

/* Seconds of a part, after which an earlier wish is given up. */
#define PART_SECONDS 0.025

/* Rows of parts are multiples of this, as the items of plain C are. */
enum { PART_ROWS = 8 };

struct HdViewWorker {
    void (*wake)(void *context);
    void *context;
    pthread_t thread;
    HdDeviceTeam team; /* the thread's own, and so are the next ones */
    int device_change; /* that the device was opened for; 0: none is open */
    int scene_change;  /* that the scene was uploaded for; 0: none is there */
    bool has_survey;   /* the kernels' tables are those of a surveyed scene */
    HdFrame frame;     /* of the scene's own size */
    HdFrame part;
    HdWatch watch;         /* of passes: unwanted once the wish is an earlier one */
    pthread_mutex_t mutex; /* of what follows */
    pthread_cond_t changed;
    HdViewWish wish;
    int serial; /* of the wish */
    bool has_wish, is_done, is_busy, must_end;
    bool is_saveable; /* `frame` is settled, in `style` */
    HdPictureStyle style;
    HdViewImage image;
    int version; /* of the image */
    char device[HD_RENDERER_LINE + 64], problem[4096];
};

/* ---- what others see ---- */

static bool is_stale(HdViewWorker *worker, int serial) {
    pthread_mutex_lock(&worker->mutex);
    const bool stale = worker->serial != serial || worker->must_end;
    pthread_mutex_unlock(&worker->mutex);
    return stale;
}

static void tell(HdViewWorker *worker, const char *device) {
    pthread_mutex_lock(&worker->mutex);
    snprintf(worker->device, sizeof worker->device, "%s", device);
    pthread_mutex_unlock(&worker->mutex);
    worker->wake(worker->context);
}

/* Rows of radiance become rows of the picture, which keeps its others. */
static HdStatus show_rows(HdViewWorker *worker, const HdFrame *frame, int top, int height,
                          const HdViewImage *facts, HdError *error) {
    pthread_mutex_lock(&worker->mutex);
    const HdCurve curve = worker->wish.file->output.style.picture.curve;
    HdStatus status = HD_OK;
    if (worker->image.width != facts->width || worker->image.height != facts->height)
        status = hd_view_image_stretch(&worker->image, facts->width, facts->height, error);
    if (status == HD_OK) {
        hd_curve_encode_rgba(curve, frame->rgb, (size_t)frame->width * (size_t)height,
                             worker->image.rgba + 4 * (size_t)facts->width * (size_t)top);
        hd_view_image_describe(&worker->image, facts);
        worker->version++;
    }
    pthread_mutex_unlock(&worker->mutex);
    worker->wake(worker->context);
    return status;
}

/* ---- device and scene ---- */

static HdStatus open_device(HdViewWorker *worker, const HdViewWish *wish, HdError *error) {
    HdScene plain = wish->file->scene; /* what it owns stays with the other */
    HdRenderOptions render = wish->plan->render;
    const HdJob job = {.scene = &plain, .frame_count = plain.frame_count};
    const HdDeviceWish device = {
        .backend = wish->plan->backend,
        .device = wish->plan->device,
        .kind = HD_WANT_ANY,
        .is_for_one = true,
        .options = &render,
        .job = &job,
    };
    render.has_deep_trees = hd_scene_has_deep_trees(&plain);
    hd_scene_drop_survey(&plain);
    tell(worker, "opening the device ...");
    hd_close_devices(&worker->team);
    worker->device_change = worker->scene_change = 0;
    HdStatus status = hd_open_devices(&worker->team, &device, error);
    if (status == HD_OK)
        worker->device_change = wish->device_change;
    else
        tell(worker, "no device");
    return status;
}

static HdStatus upload(HdViewWorker *worker, const HdScene *scene, const HdViewWish *wish,
                       HdError *error) {
    HdRenderer *renderer = worker->team.list[0].renderer;
    char line[HD_RENDERER_LINE], device[HD_RENDERER_LINE + 64];
    worker->scene_change = 0;
    if (hd_renderer_device(renderer)->backend->functions->kernels != NULL)
        tell(worker, "building kernels ...");
    HdStatus status = hd_put_scene(renderer, scene, NULL, error);
    if (status != HD_OK)
        return status;
    worker->scene_change = wish->scene_change;
    worker->has_survey = hd_scene_is_surveyed(scene);
    const HdDevice *opened = hd_renderer_device(renderer);
    hd_renderer_describe(renderer, line, sizeof line);
    snprintf(device, sizeof device, "%.32s:%d %s", opened->backend->name, opened->index, line);
    tell(worker, device);
    return HD_OK;
}

static HdStatus make_ready(HdViewWorker *worker, const HdScene *scene, const HdViewWish *wish,
                           HdError *error) {
    HdStatus status = HD_OK;
    if (worker->device_change != wish->device_change)
        status = open_device(worker, wish, error);
    if (status == HD_OK && (worker->scene_change != wish->scene_change ||
                            worker->has_survey != hd_scene_is_surveyed(scene)))
        status = upload(worker, scene, wish, error);
    return status;
}

/* ---- pictures ---- */

static HdStatus fit_frame(HdFrame *frame, int width, int height, HdError *error) {
    if (frame->width == width && frame->height == height && frame->rgb != NULL)
        return HD_OK;
    hd_frame_free(frame);
    return hd_frame_create(frame, width, height, error);
}

static HdStatus render_scene(HdViewWorker *worker, const HdScene *scene, const HdViewWish *wish,
                             HdFrame *frame, HdError *error) {
    const HdFrameMaker maker = {.renderer = worker->team.list[0].renderer, .scene = scene};
    HdStatus status = fit_frame(frame, scene->width, scene->height, error);
    return status == HD_OK ? hd_frame_render(&maker, &wish->camera, frame, error) : status;
}

/* The scene as quick pictures have it. */
static HdScene quick_scene(const HdViewWish *wish, const HdDetail *detail) {
    HdScene scene = wish->file->scene; /* what it owns stays there */
    hd_scene_drop_survey(&scene);
    scene.width = detail->width;
    scene.height = detail->height;
    scene.samples_per_side = detail->samples;
    scene.depth = detail->depth < scene.depth ? detail->depth : scene.depth;
    return scene;
}

static HdStatus render_moving(HdViewWorker *worker, const HdViewWish *wish, HdError *error) {
    const HdScene scene = quick_scene(wish, &wish->detail);
    HdScene uploaded = wish->file->scene; /* what it owns stays there */
    hd_scene_drop_survey(&uploaded);      /* its depth is that of all quick pictures, at most */
    HdStatus status = make_ready(worker, &uploaded, wish, error);
    const double start = hd_monotonic_seconds();
    if (status == HD_OK)
        status = render_scene(worker, &scene, wish, &worker->part, error);
    if (status != HD_OK)
        return status;
    const HdViewImage facts = {
        .width = scene.width,
        .height = scene.height,
        .detail = wish->detail,
        .share = 1.0,
        .seconds = hd_monotonic_seconds() - start,
        .rays = hd_frame_rays(&worker->part),
    };
    return show_rows(worker, &worker->part, 0, scene.height, &facts, error);
}

static int next_rows(int rows, double seconds) {
    const double wanted = rows * PART_SECONDS / (seconds > 1e-6 ? seconds : 1e-6);
    const int most = wanted > 4.0 * rows ? 4 * rows : (int)wanted;
    return most > PART_ROWS ? most - most % PART_ROWS : PART_ROWS;
}

/* All rows of a scene that is not surveyed, from the top, each as the whole picture has it. */
static HdStatus render_rows(HdViewWorker *worker, const HdScene *whole, const HdViewWish *wish,
                            int serial, HdViewImage *facts, HdError *error) {
    HdScene scene = *whole;
    int rows = PART_ROWS;
    HdStatus status = HD_OK;
    for (int top = 0; status == HD_OK && top < whole->height && !is_stale(worker, serial);) {
        const int height = rows < whole->height - top ? rows : whole->height - top;
        const double start = hd_monotonic_seconds();
        scene.crop = (HdCrop){whole->width, whole->height, 0, top};
        scene.height = height;
        status = render_scene(worker, &scene, wish, &worker->part, error);
        if (status != HD_OK)
            return status;
        const double seconds = hd_monotonic_seconds() - start;
        memcpy(worker->frame.rgb + 3 * (size_t)whole->width * (size_t)top, worker->part.rgb,
               3 * sizeof(float) * (size_t)whole->width * (size_t)height);
        facts->seconds += seconds;
        facts->rays += hd_frame_rays(&worker->part);
        facts->share = (double)(top + height) / whole->height;
        status = show_rows(worker, &worker->part, top, height, facts, error);
        rows = next_rows(height, seconds);
        top += height;
    }
    return status;
}

/* Adaptive samples hang on their neighbours: such a picture is made in one piece, or given up. */
static HdStatus render_surveyed(HdViewWorker *worker, const HdViewWish *wish, HdViewImage *facts,
                                HdError *error) {
    const HdScene *scene = &wish->file->scene;
    const double start = hd_monotonic_seconds();
    HdStatus status = make_ready(worker, scene, wish, error);
    const HdFrameMaker maker = {.renderer = worker->team.list[0].renderer,
                                .scene = scene,
                                .wish.curve = wish->file->output.style.picture.curve,
                                .watch = &worker->watch};
    if (status == HD_OK)
        status = hd_frame_render(&maker, &wish->camera, &worker->frame, error);
    facts->seconds = hd_monotonic_seconds() - start;
    facts->rays = hd_frame_rays(&worker->frame);
    facts->share = 1.0;
    facts->has_bound = worker->frame.has_bound;
    facts->largest_bound = worker->frame.largest_bound;
    return status;
}

/* The whole picture is there: it is encoded once more, as a file is. */
static HdStatus finish(HdViewWorker *worker, HdViewImage *facts, HdError *error) {
    facts->is_settled = true;
    HdStatus status = show_rows(worker, &worker->frame, 0, facts->height, facts, error);
    pthread_mutex_lock(&worker->mutex);
    worker->is_saveable = status == HD_OK;
    worker->style = worker->wish.file->output.style.picture;
    pthread_mutex_unlock(&worker->mutex);
    return status;
}

static HdStatus settle(HdViewWorker *worker, const HdViewWish *wish, int serial, HdError *error) {
    const HdScene *scene = &wish->file->scene;
    const bool is_surveyed = hd_scene_is_surveyed(scene);
    const HdDetail full = {scene->width, scene->height, scene->samples_per_side, scene->depth};
    const HdDetail once = {scene->width, scene->height, 1, scene->depth};
    HdViewImage facts = {.width = scene->width, .height = scene->height, .detail = once};
    const HdScene quick = quick_scene(wish, &once);
    HdStatus status = make_ready(worker, &quick, wish, error);
    if (status == HD_OK)
        status = fit_frame(&worker->frame, scene->width, scene->height, error);
    if (status == HD_OK && (is_surveyed || full.samples > 1))
        status = render_rows(worker, &quick, wish, serial, &facts, error);
    facts = (HdViewImage){.width = scene->width, .height = scene->height, .detail = full};
    if (status != HD_OK || is_stale(worker, serial))
        return status;
    status = is_surveyed ? render_surveyed(worker, wish, &facts, error)
                         : render_rows(worker, scene, wish, serial, &facts, error);
    return status == HD_OK && !is_stale(worker, serial) ? finish(worker, &facts, error) : status;
}

/* ---- the thread ---- */

static void fulfil(HdViewWorker *worker, const HdViewWish *wish, int serial) {
    HdError error;
    HdStatus status = wish->is_moving ? render_moving(worker, wish, &error)
                                      : settle(worker, wish, serial, &error);
    pthread_mutex_lock(&worker->mutex);
    worker->is_done = worker->is_done || worker->serial == serial;
    worker->is_busy = false;
    if (status == HD_INTERRUPTED && worker->serial != serial)
        status = HD_OK; /* it was given up */
    snprintf(worker->problem, sizeof worker->problem, "%.4000s",
             status == HD_OK ? "" : error.message);
    pthread_cond_broadcast(&worker->changed);
    pthread_mutex_unlock(&worker->mutex);
    worker->wake(worker->context);
}

static bool take_wish(HdViewWorker *worker, HdViewWish *wish, int *serial) {
    pthread_mutex_lock(&worker->mutex);
    while (!worker->must_end && (!worker->has_wish || worker->is_done))
        pthread_cond_wait(&worker->changed, &worker->mutex);
    const bool has_work = !worker->must_end;
    worker->is_busy = has_work;
    worker->is_saveable = worker->is_saveable && !has_work;
    atomic_store(&worker->watch.is_unwanted, false);
    *wish = worker->wish;
    *serial = worker->serial;
    pthread_mutex_unlock(&worker->mutex);
    return has_work;
}

static void *work(void *argument) {
    HdViewWorker *worker = argument;
    HdViewWish wish;
    int serial;
    while (take_wish(worker, &wish, &serial))
        fulfil(worker, &wish, serial);
    hd_close_devices(&worker->team);
    return NULL;
}

HdStatus hd_view_worker_start(HdViewWorker **worker, void (*wake)(void *context), void *context,
                              HdError *error) {
    HdViewWorker *w = calloc(1, sizeof *w);
    if (w == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room for a view");
    w->wake = wake;
    w->context = context;
    pthread_mutex_init(&w->mutex, NULL);
    pthread_cond_init(&w->changed, NULL);
    const int reason = hd_start_thread(&w->thread, work, w);
    if (reason != 0) {
        free(w);
        return hd_fail(error, HD_FAILED, "cannot start a thread that renders: %s",
                       strerror(reason));
    }
    *worker = w;
    return HD_OK;
}

/* What is under way is for an earlier wish. */
static void give_up(HdViewWorker *worker) {
    worker->serial++;
    atomic_store(&worker->watch.is_unwanted, true);
}

void hd_view_worker_show(HdViewWorker *worker, const HdViewWish *wish) {
    pthread_mutex_lock(&worker->mutex);
    worker->wish = *wish;
    give_up(worker);
    worker->has_wish = true;
    worker->is_done = false;
    worker->is_saveable = false;
    pthread_cond_broadcast(&worker->changed);
    pthread_mutex_unlock(&worker->mutex);
}

void hd_view_worker_rest(HdViewWorker *worker) {
    pthread_mutex_lock(&worker->mutex);
    worker->has_wish = false;
    give_up(worker);
    while (worker->is_busy)
        pthread_cond_wait(&worker->changed, &worker->mutex);
    pthread_mutex_unlock(&worker->mutex);
}

bool hd_view_worker_is_idle(HdViewWorker *worker) {
    pthread_mutex_lock(&worker->mutex);
    const bool is_idle = !worker->is_busy && (!worker->has_wish || worker->is_done);
    pthread_mutex_unlock(&worker->mutex);
    return is_idle;
}

bool hd_view_worker_image(HdViewWorker *worker, HdViewImage *image, int *version) {
    HdError ignored;
    pthread_mutex_lock(&worker->mutex);
    const HdViewImage *source = &worker->image;
    const bool is_newer =
        worker->version != *version &&
        hd_view_image_resize(image, source->width, source->height, &ignored) == HD_OK;
    if (is_newer) {
        memcpy(image->rgba, source->rgba, 4 * (size_t)source->width * (size_t)source->height);
        hd_view_image_describe(image, source);
        *version = worker->version;
    }
    pthread_mutex_unlock(&worker->mutex);
    return is_newer;
}

void hd_view_worker_describe(HdViewWorker *worker, char *device, size_t device_size, char *problem,
                             size_t problem_size) {
    pthread_mutex_lock(&worker->mutex);
    snprintf(device, device_size, "%s", worker->device);
    snprintf(problem, problem_size, "%s", worker->problem);
    pthread_mutex_unlock(&worker->mutex);
}

HdStatus hd_view_worker_save(HdViewWorker *worker, const char *path, HdError *error) {
    pthread_mutex_lock(&worker->mutex);
    HdStatus status = worker->is_saveable
                          ? hd_picture_write(&worker->frame, &worker->style, path, error)
                          : hd_fail(error, HD_FAILED, "the picture is not finished yet");
    pthread_mutex_unlock(&worker->mutex);
    return status;
}

void hd_view_worker_end(HdViewWorker *worker) {
    if (worker == NULL)
        return;
    pthread_mutex_lock(&worker->mutex);
    worker->must_end = true;
    give_up(worker);
    pthread_cond_broadcast(&worker->changed);
    pthread_mutex_unlock(&worker->mutex);
    pthread_join(worker->thread, NULL);
    hd_frame_free(&worker->frame);
    hd_frame_free(&worker->part);
    hd_view_image_free(&worker->image);
    pthread_cond_destroy(&worker->changed);
    pthread_mutex_destroy(&worker->mutex);
    free(worker);
}
