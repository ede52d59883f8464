/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "view/side.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "base/hash.h"
#include "base/minmax.h"
#include "render/backends.h"
#include "render/frame.h"
#include "run/load_scene.h"
#include "scene/sample_pattern.h"
#include "system/interrupt.h"
#include "system/machine.h"
#include "system/path.h"
#include "system/thread_pool.h"
#include "verify/trust.h"

/* Seconds of a part, after which an outdated request is dropped. */
#define PART_SECONDS 0.025

/* Rows of parts are multiples of this, as the items of plain C are. */
enum { PART_ROWS = 8 };

/* ---- published state ---- */

/* Returns whether the current work serves an outdated request. */
static bool is_stale(HdViewSide *side) {
    return atomic_load(&side->watch.is_cancelled);
}

static void set_description(HdViewSide *side, const char *device) {
    pthread_mutex_lock(&side->mutex);
    snprintf(side->description, sizeof side->description, "%s", device);
    pthread_mutex_unlock(&side->mutex);
}

/* Converts rows of radiance into rows of the picture, which keeps its others. */
static HdStatus show_rows(HdViewSide *side, const HdFrame *frame, int top, int height,
                          const HdViewImage *facts, HdError *error) {
    pthread_mutex_lock(&side->mutex);
    const HdCurve curve = side->file.output.style.picture.curve;
    HdStatus status = hd_view_image_resize(&side->made, facts->width, facts->height, error);
    if (status == HD_OK) {
        hd_curve_encode_rgba(curve, frame->rgb, (size_t)frame->width * (size_t)height,
                             side->made.rgba + 4 * (size_t)facts->width * (size_t)top);
        uint8_t *rgba = side->made.rgba;
        side->made = *facts;
        side->made.rgba = rgba;
        side->has_news = true;
    }
    pthread_mutex_unlock(&side->mutex);
    return status;
}

/* ---- device and scene ---- */

static HdStatus open_device(HdViewSide *side, HdError *error) {
    HdScene plain = side->file.scene; /* `file` keeps ownership */
    HdRenderOptions render = side->devices.render;
    const HdJob job = {.scene = &plain, .frame_count = plain.frame_count};
    const HdDeviceSelection device = {
        .backend = side->devices.backend,
        .device = side->devices.device,
        .kind = HD_WANT_ANY,
        .is_for_one = true,
        .options = &render,
        .job = &job,
    };
    render.has_deep_trees = hd_scene_has_deep_trees(&plain);
    hd_scene_drop_error_bound(&plain);
    set_description(side, "opening the device ...");
    hd_close_devices(&side->team);
    side->is_opened = side->is_uploaded = false;
    HdStatus status = hd_open_devices(&side->team, &device, error);
    side->is_opened = status == HD_OK;
    if (status != HD_OK)
        set_description(side, "no device");
    return status;
}

static HdStatus upload(HdViewSide *side, const HdScene *scene, HdError *error) {
    HdRenderer *renderer = side->team.list[0].renderer;
    char line[HD_RENDERER_LINE], device[HD_RENDERER_LINE + 64];
    side->is_uploaded = false;
    if (hd_renderer_device(renderer)->backend->functions->kernels != NULL)
        set_description(side, "building kernels ...");
    HD_TRY(hd_put_scene(renderer, scene, NULL, error));
    side->is_uploaded = true;
    side->has_bound = hd_scene_has_error_bound(scene);
    const HdDevice *opened = hd_renderer_device(renderer);
    hd_renderer_describe(renderer, line, sizeof line);
    snprintf(device, sizeof device, "%.32s:%d %s", opened->backend->name, opened->index, line);
    set_description(side, device);
    return HD_OK;
}

static HdStatus make_ready(HdViewSide *side, const HdScene *scene, HdError *error) {
    if (!side->is_opened)
        HD_TRY(open_device(side, error));
    if (!side->is_uploaded || side->has_bound != hd_scene_has_error_bound(scene))
        HD_TRY(upload(side, scene, error));
    return HD_OK;
}

/* ---- pictures ---- */

static HdStatus fit_frame(HdFrame *frame, int width, int height, HdError *error) {
    if (frame->width == width && frame->height == height && frame->rgb != NULL)
        return HD_OK;
    hd_frame_free(frame);
    return hd_frame_create(frame, width, height, error);
}

static HdStatus render_scene(HdViewSide *side, const HdScene *scene, const HdViewRequest *request,
                             HdFrame *frame, HdError *error) {
    const HdFrameMaker maker = {.renderer = side->team.list[0].renderer, .scene = scene};
    HD_TRY(fit_frame(frame, scene->width, scene->height, error));
    return hd_frame_render(&maker, &request->camera, frame, error);
}

/* Returns the scene as reduced for quick pictures. */
static HdScene quick_scene(const HdViewSide *side, const HdDetail *detail) {
    HdScene scene = side->file.scene; /* `file` keeps ownership */
    hd_scene_drop_error_bound(&scene);
    scene.width = detail->width;
    scene.height = detail->height;
    scene.samples_per_side = detail->samples;
    scene.sample_rows = detail->sample_rows;
    scene.depth = detail->depth < scene.depth ? detail->depth : scene.depth;
    return scene;
}

static HdStatus render_moving(HdViewSide *side, const HdViewRequest *request, HdError *error) {
    const HdScene scene = quick_scene(side, &request->detail);
    HdScene uploaded = side->file.scene;  /* `file` keeps ownership */
    hd_scene_drop_error_bound(&uploaded); /* its depth is the maximum of all quick pictures */
    HD_TRY(make_ready(side, &uploaded, error));
    const double start = hd_monotonic_seconds();
    HD_TRY(render_scene(side, &scene, request, &side->part, error));
    const HdViewImage facts = {
        .width = scene.width,
        .height = scene.height,
        .detail = request->detail,
        .share = 1.0,
        .seconds = hd_monotonic_seconds() - start,
        .rays = hd_frame_rays(&side->part),
    };
    return show_rows(side, &side->part, 0, scene.height, &facts, error);
}

static int next_rows(int rows, double seconds) {
    const double wanted = rows * PART_SECONDS / (seconds > 1e-6 ? seconds : 1e-6);
    const int most = wanted > 4.0 * rows ? 4 * rows : (int)wanted;
    return most > PART_ROWS ? most - most % PART_ROWS : PART_ROWS;
}

/* Renders all rows of a scene without an error bound, from the top, as in the whole picture. */
static HdStatus render_rows(HdViewSide *side, const HdScene *whole, const HdViewRequest *request,
                            HdViewImage *facts, HdError *error) {
    HdScene scene = *whole;
    int rows = PART_ROWS;
    for (int top = 0; top < whole->height && !is_stale(side);) {
        const int height = rows < whole->height - top ? rows : whole->height - top;
        const double start = hd_monotonic_seconds();
        scene.crop = (HdCrop){whole->width, whole->height, 0, top};
        scene.height = height;
        HD_TRY(render_scene(side, &scene, request, &side->part, error));
        const double seconds = hd_monotonic_seconds() - start;
        memcpy(side->frame.rgb + 3 * (size_t)whole->width * (size_t)top, side->part.rgb,
               3 * sizeof(float) * (size_t)whole->width * (size_t)height);
        facts->seconds += seconds;
        facts->rays += hd_frame_rays(&side->part);
        facts->share = (double)(top + height) / whole->height;
        HD_TRY(show_rows(side, &side->part, top, height, facts, error));
        rows = next_rows(height, seconds);
        top += height;
    }
    return HD_OK;
}

/* Such a picture is made in one piece, or dropped. */
static HdStatus render_bounded(HdViewSide *side, const HdViewRequest *request, HdViewImage *facts,
                               HdError *error) {
    const HdScene *scene = &side->file.scene;
    const double start = hd_monotonic_seconds();
    HD_TRY(make_ready(side, scene, error));
    const HdFrameMaker maker = {.renderer = side->team.list[0].renderer,
                                .scene = scene,
                                .request.curve = side->file.output.style.picture.curve,
                                .watch = &side->watch};
    HD_TRY(hd_frame_render(&maker, &request->camera, &side->frame, error));
    facts->seconds = hd_monotonic_seconds() - start;
    facts->rays = hd_frame_rays(&side->frame);
    facts->share = 1.0;
    facts->has_bound = side->frame.has_bound;
    facts->largest_bound = side->frame.largest_bound;
    return HD_OK;
}

/* Encodes the whole picture again, as for a file. */
static HdStatus finish(HdViewSide *side, HdViewImage *facts, HdError *error) {
    facts->is_settled = true;
    HdStatus status = show_rows(side, &side->frame, 0, facts->height, facts, error);
    pthread_mutex_lock(&side->mutex);
    side->is_saveable = status == HD_OK;
    side->style = side->file.output.style.picture;
    pthread_mutex_unlock(&side->mutex);
    return status;
}

static HdStatus settle(HdViewSide *side, const HdViewRequest *request, HdError *error) {
    const HdScene *scene = &side->file.scene;
    const bool is_bounded = hd_scene_has_error_bound(scene);
    const HdDetail full = {scene->width, scene->height, scene->samples_per_side,
                           hd_sample_rows(scene), scene->depth};
    const HdDetail once = {scene->width, scene->height, 1, 1, scene->depth};
    HdViewImage facts = {.width = scene->width, .height = scene->height, .detail = once};
    const HdScene quick = quick_scene(side, &once);
    HD_TRY(make_ready(side, &quick, error));
    HD_TRY(fit_frame(&side->frame, scene->width, scene->height, error));
    if (is_bounded || hd_sample_count(scene) > 1)
        HD_TRY(render_rows(side, &quick, request, &facts, error));
    facts = (HdViewImage){.width = scene->width, .height = scene->height, .detail = full};
    if (is_stale(side))
        return HD_OK;
    HD_TRY(is_bounded ? render_bounded(side, request, &facts, error)
                      : render_rows(side, scene, request, &facts, error));
    return is_stale(side) ? HD_OK : finish(side, &facts, error);
}

/* ---- the thread ---- */

static void serve(HdViewSide *side, const HdViewRequest *request) {
    HdError error;
    HdStatus status =
        request->is_moving ? render_moving(side, request, &error) : settle(side, request, &error);
    pthread_mutex_lock(&side->mutex);
    side->is_done = side->is_done || !is_stale(side);
    side->is_busy = false;
    if (status == HD_INTERRUPTED && is_stale(side))
        status = HD_OK; /* the request was dropped */
    snprintf(side->problem, sizeof side->problem, "%.4000s", status == HD_OK ? "" : error.message);
    pthread_cond_broadcast(&side->changed);
    pthread_mutex_unlock(&side->mutex);
}

static bool claim_request(HdViewSide *side, HdViewRequest *request) {
    pthread_mutex_lock(&side->mutex);
    while (!side->must_end && (!side->has_request || side->is_done))
        pthread_cond_wait(&side->changed, &side->mutex);
    const bool has_work = !side->must_end;
    side->is_busy = has_work;
    side->is_saveable = side->is_saveable && !has_work;
    atomic_store(&side->watch.is_cancelled, false);
    *request = side->request;
    pthread_mutex_unlock(&side->mutex);
    return has_work;
}

static void *work(void *argument) {
    HdViewSide *side = argument;
    HdViewRequest request;
    while (claim_request(side, &request))
        serve(side, &request);
    hd_close_devices(&side->team);
    return NULL;
}

void hd_view_side_show(HdViewSide *side, const HdViewRequest *request) {
    pthread_mutex_lock(&side->mutex);
    side->request = *request;
    atomic_store(&side->watch.is_cancelled, true);
    side->has_request = true;
    side->is_done = false;
    pthread_cond_broadcast(&side->changed);
    pthread_mutex_unlock(&side->mutex);
}

/* Drops the request, and waits until the thread no longer reads plan and file. */
static void stop_work(HdViewSide *side) {
    pthread_mutex_lock(&side->mutex);
    side->has_request = false;
    atomic_store(&side->watch.is_cancelled, true);
    while (side->is_busy)
        pthread_cond_wait(&side->changed, &side->mutex);
    pthread_mutex_unlock(&side->mutex);
}

bool hd_view_side_is_idle(HdViewSide *side) {
    pthread_mutex_lock(&side->mutex);
    const bool is_idle = !side->is_busy && (!side->has_request || side->is_done);
    pthread_mutex_unlock(&side->mutex);
    return is_idle;
}

bool hd_view_side_fetch(HdViewSide *side) {
    HdError ignored;
    pthread_mutex_lock(&side->mutex);
    HdViewImage made = side->made;
    const bool is_newer = side->has_news && hd_view_image_resize(&side->image, made.width,
                                                                 made.height, &ignored) == HD_OK;
    if (is_newer) {
        made.rgba = side->image.rgba;
        memcpy(made.rgba, side->made.rgba, 4 * (size_t)made.width * (size_t)made.height);
        side->image = made;
        side->has_news = false;
    }
    pthread_mutex_unlock(&side->mutex);
    return is_newer;
}

void hd_view_side_describe(HdViewSide *side, char *device, size_t device_size, char *problem,
                           size_t problem_size) {
    pthread_mutex_lock(&side->mutex);
    snprintf(device, device_size, "%s", side->description);
    snprintf(problem, problem_size, "%s", side->problem);
    pthread_mutex_unlock(&side->mutex);
}

HdStatus hd_view_side_save(HdViewSide *side, const char *path, HdError *error) {
    pthread_mutex_lock(&side->mutex);
    HdStatus status = side->is_saveable
                          ? hd_picture_write(&side->frame, &side->style, path, error)
                          : hd_fail(error, HD_FAILED, "the picture is not finished yet");
    pthread_mutex_unlock(&side->mutex);
    return status;
}

static void end_thread(HdViewSide *side) {
    pthread_mutex_lock(&side->mutex);
    side->must_end = true;
    atomic_store(&side->watch.is_cancelled, true);
    pthread_cond_broadcast(&side->changed);
    pthread_mutex_unlock(&side->mutex);
    pthread_join(side->thread, NULL);
    pthread_cond_destroy(&side->changed);
    pthread_mutex_destroy(&side->mutex);
}

/* ---- the scene and its files ---- */

static uint64_t add_file(uint64_t hash, const char *path) {
    struct stat facts;
    char expanded[HD_MAX_PATH];
    HdError ignored;
    if (path == NULL || hd_path_expand_home(path, expanded, &ignored) != HD_OK ||
        stat(expanded, &facts) != 0)
        return hd_hash_bytes(hash, "", 1);
    const int64_t description[] = {(int64_t)facts.st_ino, (int64_t)facts.st_size,
                                   (int64_t)facts.st_mtim.tv_sec, (int64_t)facts.st_mtim.tv_nsec};
    return hd_hash_numbers(hash, description, sizeof description, sizeof *description);
}

/* Returns a hash that changes when one of the files is written or replaced: the scene (NULL: none),
   its textures and its meshes. */
static uint64_t hash_files(const char *path, const HdSceneFile *file) {
    uint64_t hash = add_file(HD_HASH_START, path);
    if (file->texture_path[0] != '\0')
        hash = add_file(hash, file->texture_path);
    if (file->scene.environment.file != NULL)
        hash = add_file(hash, file->scene.environment.file);
    for (int i = 0; i < file->mesh_entry_count; i++)
        hash = add_file(hash, file->mesh_entries[i].file);
    return hash;
}

static HdStatus read_file(HdViewSide *side, HdSceneFile *file, HdError *error) {
    side->files = hash_files(side->scene_plan.path, &side->file);
    HdStatus status = hd_load_scene(file, &side->scene_plan, NULL, error);
    snprintf(side->file_error, sizeof side->file_error, "%.4000s",
             status == HD_OK ? "" : error->message);
    return status;
}

/* The pipeline may depend on the depth of the trees. */
static void set_file(HdViewSide *side, const HdSceneFile *file) {
    const bool was_deep = hd_scene_has_deep_trees(&side->file.scene);
    hd_scene_file_free(&side->file);
    side->file = *file;
    side->is_uploaded = false;
    side->is_opened = side->is_opened && was_deep == hd_scene_has_deep_trees(&file->scene);
    side->files = hash_files(side->scene_plan.path, &side->file);
}

HdStatus hd_view_side_open(HdViewSide *side, const HdScenePlan *scene, const HdDevicePlan *devices,
                           HdError *error) {
    HdSceneFile file;
    *side = (HdViewSide){.scene_plan = *scene, .devices = *devices};
    HD_TRY(read_file(side, &file, error));
    set_file(side, &file);
    pthread_mutex_init(&side->mutex, NULL);
    pthread_cond_init(&side->changed, NULL);
    const int reason = hd_start_thread(&side->thread, work, side);
    side->has_thread = reason == 0;
    if (side->has_thread)
        return HD_OK;
    hd_view_side_close(side);
    return hd_fail(error, HD_FAILED, "cannot start a thread that renders: %s", strerror(reason));
}

static void read_again(HdViewSide *side) {
    HdSceneFile file;
    HdError error;
    stop_work(side);
    if (read_file(side, &file, &error) == HD_OK)
        set_file(side, &file);
}

bool hd_view_side_follow_files(HdViewSide *side) {
    if (hash_files(side->scene_plan.path, &side->file) == side->files)
        return false;
    read_again(side);
    return true;
}

/* ---- settings ---- */

static void next_backend(HdViewSide *side) {
    HdDevicePlan *plan = &side->devices;
    int next = 0;
    while (plan->backend != NULL && next < HD_BACKEND_COUNT &&
           strcmp(hd_backends[next++]->name, plan->backend) != 0)
        continue;
    plan->backend = next < HD_BACKEND_COUNT ? hd_backends[next]->name : NULL;
    plan->device = NULL;
}

static void next_device(HdViewSide *side) {
    static HdDevice devices[HD_BACKEND_COUNT * HD_MAX_DEVICES];
    HdError ignored;
    char first[sizeof side->device] = "", name[sizeof side->device];
    int count = 0;
    bool was_here = false;
    if (hd_devices_named(NULL, "all", devices, &count, &ignored) != HD_OK)
        return;
    for (int i = 0; i < count; i++) {
        snprintf(name, sizeof name, "%s:%d", devices[i].backend->name, devices[i].index);
        if (i == 0 || was_here)
            memcpy(first, name, sizeof name);
        if (was_here)
            break;
        was_here = strcmp(name, side->device) == 0;
    }
    memcpy(side->device, first, sizeof first);
    side->devices.backend = NULL;
    side->devices.device = side->device;
}

static void change_scene(HdViewSide *side, HdViewSetting setting, int by) {
    const HdScene *scene = &side->file.scene;
    HdScenePlan *plan = &side->scene_plan;
    if (setting == HD_VIEW_DEPTH)
        plan->depth = hd_min(hd_max(scene->depth + by, 0), HD_MAX_DEPTH);
    else if (setting == HD_VIEW_SAMPLES)
        plan->samples = hd_min(hd_max(scene->samples_per_side + by, 1), HD_MAX_SAMPLES_PER_SIDE);
    else
        plan->sampling = (int)(scene->sampling + 1) % HD_SAMPLING_REFERENCE;
}

void hd_view_side_change(HdViewSide *side, HdViewSetting setting, int by) {
    HdPrecision *precision = &side->devices.render.precision;
    stop_work(side); /* the thread reads the plan */
    if (setting == HD_VIEW_BACKEND)
        next_backend(side);
    else if (setting == HD_VIEW_DEVICE)
        next_device(side);
    else if (setting == HD_VIEW_PRECISION)
        *precision = *precision == HD_PRECISION_FLOAT ? HD_PRECISION_DOUBLE : HD_PRECISION_FLOAT;
    else
        change_scene(side, setting, by);
    side->is_opened = side->is_opened && setting > HD_VIEW_PRECISION;
    read_again(side);
}

void hd_view_side_close(HdViewSide *side) {
    if (side->has_thread)
        end_thread(side);
    hd_scene_file_free(&side->file);
    hd_frame_free(&side->frame);
    hd_frame_free(&side->part);
    hd_view_image_free(&side->made);
    hd_view_image_free(&side->image);
    *side = (HdViewSide){.has_thread = false};
}
