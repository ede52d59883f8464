/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "view/side.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "base/hash.h"
#include "choice/candidates.h"
#include "render/backends.h"
#include "run/load_scene.h"
#include "system/path.h"

static uint64_t add_file(uint64_t hash, const char *path) {
    struct stat facts;
    char expanded[HD_MAX_PATH];
    HdError ignored;
    if (path == NULL || hd_path_expand_home(path, expanded, &ignored) != HD_OK ||
        stat(expanded, &facts) != 0)
        return hd_hash_bytes(hash, "", 1);
    const int64_t told[] = {(int64_t)facts.st_ino, (int64_t)facts.st_size,
                            (int64_t)facts.st_mtim.tv_sec, (int64_t)facts.st_mtim.tv_nsec};
    return hd_hash_bytes(hash, told, sizeof told);
}

/* A number that changes when one of the files is written or replaced: that of the scene (NULL:
   none), its texture and its meshes. */
static uint64_t hash_files(const char *path, const HdSceneFile *file) {
    uint64_t hash = add_file(HD_HASH_START, path);
    if (file->texture_path[0] != '\0')
        hash = add_file(hash, file->texture_path);
    for (int i = 0; i < file->mesh_entry_count; i++)
        hash = add_file(hash, file->mesh_entries[i].file);
    return hash;
}

static HdStatus read_file(HdViewSide *side, HdSceneFile *file, HdError *error) {
    side->files = hash_files(side->plan.scene.path, &side->file);
    HdStatus status = hd_load_scene(file, &side->plan.scene, NULL, error);
    snprintf(side->mistake, sizeof side->mistake, "%.4000s", status == HD_OK ? "" : error->message);
    return status;
}

/* The pipeline that is opened may hang on how deep the trees are. */
static void take_file(HdViewSide *side, const HdSceneFile *file) {
    const bool was_deep = hd_scene_has_deep_trees(&side->file.scene);
    hd_scene_file_free(&side->file);
    side->file = *file;
    side->scene_change++;
    side->device_change += was_deep != hd_scene_has_deep_trees(&file->scene);
    side->files = hash_files(side->plan.scene.path, &side->file);
}

HdStatus hd_view_side_open(HdViewSide *side, const HdViewPlan *plan, void (*wake)(void *context),
                           void *context, HdError *error) {
    HdSceneFile file;
    *side = (HdViewSide){.plan = *plan, .device_change = 1};
    HdStatus status = read_file(side, &file, error);
    if (status != HD_OK)
        return status;
    take_file(side, &file);
    status = hd_view_worker_start(&side->worker, wake, context, error);
    if (status != HD_OK)
        hd_view_side_close(side);
    return status;
}

static void read_again(HdViewSide *side) {
    HdSceneFile file;
    HdError error;
    hd_view_worker_rest(side->worker);
    if (read_file(side, &file, &error) == HD_OK)
        take_file(side, &file);
}

bool hd_view_side_follow_files(HdViewSide *side) {
    if (hash_files(side->plan.scene.path, &side->file) == side->files)
        return false;
    read_again(side);
    return true;
}

/* ---- settings ---- */

static void next_backend(HdViewSide *side) {
    HdDevicePlan *plan = &side->plan.devices;
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
    side->plan.devices.backend = NULL;
    side->plan.devices.device = side->device;
}

static int within(int number, int least, int most) {
    return number < least ? least : number > most ? most : number;
}

static void change_scene(HdViewSide *side, HdViewSetting setting, int by) {
    const HdScene *scene = &side->file.scene;
    HdScenePlan *plan = &side->plan.scene;
    if (setting == HD_VIEW_DEPTH)
        plan->depth = within(scene->depth + by, 0, HD_MAX_DEPTH);
    else if (setting == HD_VIEW_SAMPLES)
        plan->samples = within(scene->samples_per_side + by, 1, HD_MAX_SAMPLES_PER_SIDE);
    else
        plan->sampling =
            scene->sampling == HD_SAMPLING_ADAPTIVE ? HD_SAMPLING_GRID : HD_SAMPLING_ADAPTIVE;
}

void hd_view_side_change(HdViewSide *side, HdViewSetting setting, int by) {
    HdPrecision *precision = &side->plan.devices.render.precision;
    hd_view_worker_rest(side->worker); /* it reads the plan */
    if (setting == HD_VIEW_BACKEND)
        next_backend(side);
    else if (setting == HD_VIEW_DEVICE)
        next_device(side);
    else if (setting == HD_VIEW_PRECISION)
        *precision = *precision == HD_PRECISION_FLOAT ? HD_PRECISION_DOUBLE : HD_PRECISION_FLOAT;
    else
        change_scene(side, setting, by);
    side->device_change += setting <= HD_VIEW_PRECISION;
    read_again(side);
}

void hd_view_side_close(HdViewSide *side) {
    hd_view_worker_end(side->worker);
    hd_scene_file_free(&side->file);
    hd_view_image_free(&side->image);
    *side = (HdViewSide){.worker = NULL};
}
