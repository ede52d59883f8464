/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "view/viewer.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/trigonometry.h"
#include "view/viewer_state.h"

/* After the last touch the view counts as moving for so long, before it is made whole. */
#define STILL_SECONDS 0.25

/* Between two looks at the files. */
#define WATCH_SECONDS 0.2

/* What one press of a key does. */
#define ORBIT_STEP (HD_PI / 60.0)
#define PAN_STEP   0.03
#define DOLLY_STEP 1.06

enum { FIRST_GAIN = 16, MOST_GAIN = 128 };

static void change_view(HdViewer *viewer, double now) {
    viewer->change++;
    viewer->moved = now;
}

static const HdSceneFile *file_of(const HdViewer *viewer) {
    return &viewer->sides[0].file;
}

static int frames_per_second(const HdViewer *viewer) {
    return file_of(viewer)->output.style.frames_per_second;
}

/* ---- where the eye is ---- */

static void leave_flight(HdViewer *viewer) {
    if (!viewer->is_free)
        viewer->pose = hd_pose_of_flight(&file_of(viewer)->scene, viewer->frame);
    viewer->is_free = true;
    viewer->is_playing = false;
}

static void orbit(HdViewer *viewer, double right, double up) {
    leave_flight(viewer);
    hd_pose_orbit(&viewer->pose, right, up);
}

static void pan(HdViewer *viewer, double right, double up) {
    leave_flight(viewer);
    hd_pose_pan(&viewer->pose, right, up);
}

static void dolly(HdViewer *viewer, double factor) {
    leave_flight(viewer);
    hd_pose_dolly(&viewer->pose, factor);
}

static void show_frame(HdViewer *viewer, int frame) {
    const int count = file_of(viewer)->scene.frame_count;
    viewer->frame = (frame % count + count) % count;
    viewer->is_free = false;
}

static void step(HdViewer *viewer, int frames) {
    viewer->is_playing = false;
    show_frame(viewer, viewer->frame + frames);
}

static void play(HdViewer *viewer, double now) {
    viewer->is_playing = !viewer->is_playing;
    if (viewer->is_playing)
        viewer->is_free = false;
    viewer->played_from = now - (double)viewer->frame / frames_per_second(viewer);
}

static void fly_on(HdViewer *viewer, double now) {
    const double passed = (now - viewer->played_from) * frames_per_second(viewer);
    const int frame = (int)fmod(passed, file_of(viewer)->scene.frame_count);
    if (!viewer->is_playing || frame == viewer->frame)
        return;
    show_frame(viewer, frame);
    change_view(viewer, now);
}

static HdStatus find_camera(const HdViewer *viewer, HdCamera *camera, HdError *error) {
    HdScene scene = file_of(viewer)->scene; /* what it owns stays there */
    if (viewer->is_free)
        hd_pose_apply(&viewer->pose, &scene);
    return hd_camera_at(camera, &scene, viewer->is_free ? 0 : viewer->frame, error);
}

/* ---- what is wished of the workers ---- */

static bool all_idle(const HdViewer *viewer) {
    bool idle = true;
    for (int i = 0; i < viewer->side_count; i++)
        idle = idle && hd_view_worker_is_idle(viewer->sides[i].worker);
    return idle;
}

static HdDetail most_detail(const HdViewer *viewer) {
    const HdScene *scene = &file_of(viewer)->scene;
    HdDetail full = {scene->width, scene->height, scene->samples_per_side, scene->depth};
    if (viewer->most_width > 0 && viewer->most_width < full.width) {
        const double scale = (double)viewer->most_width / full.width;
        full.width = viewer->most_width;
        full.height = (int)fmax(1.0, scale * full.height);
    }
    return full;
}

static void wish_for(HdViewer *viewer, bool is_moving) {
    HdError error;
    HdViewWish wish = {.is_moving = is_moving};
    const HdDetail full = most_detail(viewer);
    viewer->asked = viewer->change;
    viewer->settling = is_moving ? 0 : viewer->change;
    if (find_camera(viewer, &wish.camera, &error) != HD_OK) {
        snprintf(viewer->note, sizeof viewer->note, "%.500s", error.message);
        return;
    }
    wish.detail = hd_pace_choose(&viewer->pace, &full);
    for (int i = 0; i < viewer->side_count; i++) {
        HdViewSide *side = &viewer->sides[i];
        wish.devices = &side->plan.devices;
        wish.file = &side->file;
        wish.device_change = side->device_change;
        wish.scene_change = side->scene_change;
        hd_view_worker_show(side->worker, &wish);
    }
}

bool hd_viewer_is_moving(const HdViewer *viewer, double now) {
    return viewer->is_playing || now - viewer->moved < STILL_SECONDS;
}

/* A moving picture that is under way is waited for, so that pictures come; a whole one is not. */
static void ask_workers(HdViewer *viewer, double now) {
    const bool idle = all_idle(viewer);
    if (viewer->asked != viewer->change && (idle || viewer->settling != 0))
        wish_for(viewer, true);
    else if (idle && viewer->settling != viewer->change && !hd_viewer_is_moving(viewer, now))
        wish_for(viewer, false);
}

/* ---- what they made ---- */

static void note_moving_picture(HdViewer *viewer, const HdViewImage *image, double now) {
    const double seconds = now - viewer->last_picture;
    hd_pace_note(&viewer->pace, &image->detail, image->seconds);
    viewer->last_picture = now;
    if (seconds > 1.0)
        viewer->picture_seconds = 0.0;
    else if (viewer->picture_seconds > 0.0)
        viewer->picture_seconds += 0.1 * (seconds - viewer->picture_seconds);
    else
        viewer->picture_seconds = seconds;
}

static void fetch_pictures(HdViewer *viewer, double now) {
    for (int i = 0; i < viewer->side_count; i++) {
        HdViewSide *side = &viewer->sides[i];
        if (!hd_view_worker_image(side->worker, &side->image, &side->version))
            continue;
        viewer->version++;
        if (viewer->settling == 0 && i == 0)
            note_moving_picture(viewer, &side->image, now);
    }
}

const HdViewImage *hd_viewer_picture(HdViewer *viewer, int *version) {
    HdError error;
    const HdViewImage *first = &viewer->sides[0].image;
    const bool is_new = *version != viewer->version;
    *version = viewer->version;
    if (viewer->side_count == 1)
        return first;
    if (is_new && hd_split_compose(&viewer->composed, first, &viewer->sides[1].image, viewer->gain,
                                   &viewer->figures, &error) != HD_OK)
        snprintf(viewer->note, sizeof viewer->note, "%.500s", error.message);
    return &viewer->composed;
}

/* ---- what is kept ---- */

/* The scene's name without its folder and ending. */
static void base_name(const HdViewer *viewer, char name[128]) {
    const char *given = viewer->sides[0].plan.scene.path;
    const char *path = given != NULL ? given : "hedron";
    const char *slash = strrchr(path, '/');
    snprintf(name, 128, "%s", slash != NULL ? slash + 1 : path);
    char *dot = strrchr(name, '.');
    if (dot != NULL && dot != name)
        *dot = '\0';
}

static void free_name(const HdViewer *viewer, char path[160]) {
    char name[128];
    base_name(viewer, name);
    for (int number = 1; number < 1000; number++) {
        snprintf(path, 160, "%s-%03d.png", name, number);
        if (access(path, F_OK) != 0)
            return;
    }
}

static void save(HdViewer *viewer) {
    char path[160], line[192];
    HdError error;
    viewer->saves = false;
    free_name(viewer, path);
    if (hd_view_worker_save(viewer->sides[viewer->active].worker, path, &error) != HD_OK) {
        snprintf(viewer->note, sizeof viewer->note, "%.500s", error.message);
        return;
    }
    snprintf(viewer->note, sizeof viewer->note, "saved %s", path);
    snprintf(line, sizeof line, "%s\n", path);
    viewer->host.say(viewer->host.context, line);
}

static void save_when_whole(HdViewer *viewer) {
    if (viewer->saves && viewer->settling == viewer->change && all_idle(viewer))
        save(viewer);
}

static void print_camera(HdViewer *viewer) {
    char *text = NULL;
    size_t size = 0;
    const HdScene *scene = &file_of(viewer)->scene;
    const HdPose pose = viewer->is_free ? viewer->pose : hd_pose_of_flight(scene, viewer->frame);
    FILE *stream = open_memstream(&text, &size);
    if (stream == NULL)
        return;
    hd_pose_print(stream, &pose, scene->field_of_view_degrees);
    fclose(stream);
    snprintf(viewer->note, sizeof viewer->note, "the camera goes to standard output");
    viewer->host.say(viewer->host.context, text);
    free(text);
}

/* ---- keys and mouse ---- */

static void split(HdViewer *viewer, double now) {
    HdError error;
    HdStatus status = HD_OK;
    if (viewer->side_count == 2)
        hd_view_side_close(&viewer->sides[1]);
    else
        status = hd_view_side_open(&viewer->sides[1], &viewer->sides[0].plan, viewer->host.wake,
                                   viewer->host.context, &error);
    if (status != HD_OK)
        snprintf(viewer->note, sizeof viewer->note, "%.500s", error.message);
    viewer->side_count = status == HD_OK && viewer->side_count == 1 ? 2 : 1;
    viewer->active = viewer->side_count - 1;
    change_view(viewer, now);
}

static void change_gain(HdViewer *viewer, bool is_more) {
    const int gain = is_more ? 2 * viewer->gain : viewer->gain / 2;
    viewer->gain = gain < 1 ? 1 : gain > MOST_GAIN ? MOST_GAIN : gain;
    viewer->version++;
}

/* A flight that was read anew may be shorter. */
static void settings_changed(HdViewer *viewer, double now) {
    viewer->frame %= file_of(viewer)->scene.frame_count;
    change_view(viewer, now);
}

/* False where the action is none that moves the eye. */
static bool move_eye(HdViewer *viewer, HdViewAction action, double now) {
    switch (action) {
    case HD_VIEW_PLAY:
        play(viewer, now);
        return true;
    case HD_VIEW_TO_FLIGHT:
        show_frame(viewer, viewer->frame);
        return true;
    case HD_VIEW_EARLIER:
    case HD_VIEW_LATER:
        step(viewer, action == HD_VIEW_LATER ? 1 : -1);
        return true;
    case HD_VIEW_ORBIT_LEFT:
    case HD_VIEW_ORBIT_RIGHT:
        orbit(viewer, action == HD_VIEW_ORBIT_RIGHT ? ORBIT_STEP : -ORBIT_STEP, 0.0);
        return true;
    case HD_VIEW_ORBIT_UP:
    case HD_VIEW_ORBIT_DOWN:
        orbit(viewer, 0.0, action == HD_VIEW_ORBIT_UP ? ORBIT_STEP : -ORBIT_STEP);
        return true;
    case HD_VIEW_PAN_LEFT:
    case HD_VIEW_PAN_RIGHT:
        pan(viewer, action == HD_VIEW_PAN_RIGHT ? PAN_STEP : -PAN_STEP, 0.0);
        return true;
    case HD_VIEW_PAN_UP:
    case HD_VIEW_PAN_DOWN:
        pan(viewer, 0.0, action == HD_VIEW_PAN_UP ? PAN_STEP : -PAN_STEP);
        return true;
    case HD_VIEW_NEARER:
    case HD_VIEW_FARTHER:
        dolly(viewer, action == HD_VIEW_FARTHER ? DOLLY_STEP : 1.0 / DOLLY_STEP);
        return true;
    default:
        return false;
    }
}

/* False where the action is none of these. */
static bool change_shown(HdViewer *viewer, HdViewAction action, double now) {
    switch (action) {
    case HD_VIEW_SPLIT:
        split(viewer, now);
        return true;
    case HD_VIEW_OTHER_SIDE:
        viewer->active = (viewer->active + 1) % viewer->side_count;
        return true;
    case HD_VIEW_LESS_GAIN:
    case HD_VIEW_MORE_GAIN:
        change_gain(viewer, action == HD_VIEW_MORE_GAIN);
        return true;
    case HD_VIEW_OVERLAY:
        viewer->hides_figures = !viewer->hides_figures;
        return true;
    case HD_VIEW_HELP:
        viewer->shows_help = !viewer->shows_help;
        return true;
    case HD_VIEW_QUIT:
        viewer->has_ended = true;
        return true;
    default:
        return false;
    }
}

void hd_viewer_key(HdViewer *viewer, int key, double now) {
    const HdViewAction action = hd_view_action_of(key);
    if (action == HD_VIEW_NOTHING)
        return;
    viewer->note[0] = '\0';
    if (move_eye(viewer, action, now))
        change_view(viewer, now);
    else if (action == HD_VIEW_SAVE)
        viewer->saves = true;
    else if (action == HD_VIEW_PRINT)
        print_camera(viewer);
    else if (!change_shown(viewer, action, now) &&
             hd_view_side_change(&viewer->sides[viewer->active], action))
        settings_changed(viewer, now);
}

void hd_viewer_drag(HdViewer *viewer, bool moves, double right, double down, double now) {
    if (moves)
        pan(viewer, -right, down);
    else
        orbit(viewer, -HD_PI * right, HD_PI * down);
    change_view(viewer, now);
}

/* ---- from open to close ---- */

static void watch_files(HdViewer *viewer, double now) {
    if (now - viewer->watched < WATCH_SECONDS)
        return;
    viewer->watched = now;
    for (int i = 0; i < viewer->side_count; i++)
        if (hd_view_side_follow_files(&viewer->sides[i]))
            settings_changed(viewer, now);
}

void hd_viewer_tick(HdViewer *viewer, double now) {
    fetch_pictures(viewer, now);
    watch_files(viewer, now);
    fly_on(viewer, now);
    ask_workers(viewer, now);
    save_when_whole(viewer);
}

bool hd_viewer_has_ended(const HdViewer *viewer) {
    return viewer->has_ended;
}

bool hd_viewer_is_split(const HdViewer *viewer) {
    return viewer->side_count > 1;
}

void hd_viewer_size(const HdViewer *viewer, int *width, int *height) {
    *width = file_of(viewer)->scene.width;
    *height = file_of(viewer)->scene.height;
}

void hd_viewer_limit(HdViewer *viewer, int width) {
    viewer->most_width = width;
}

HdStatus hd_viewer_open(HdViewer **viewer, const HdViewPlan *plan, const HdViewHost *host,
                        HdError *error) {
    if (plan->scene.path != NULL && strcmp(plan->scene.path, "-") == 0)
        return hd_fail(error, HD_BAD_INPUT,
                       "'hedron view' needs a scene's file, which it reads again when it changes, "
                       "and not standard input");
    HdViewer *v = calloc(1, sizeof *v);
    if (v == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room for a view");
    v->host = *host;
    v->gain = FIRST_GAIN;
    v->change = 1;
    v->side_count = 1;
    HdStatus status = hd_view_side_open(&v->sides[0], plan, host->wake, host->context, error);
    if (status != HD_OK) {
        free(v);
        return status;
    }
    *viewer = v;
    return HD_OK;
}

void hd_viewer_close(HdViewer *viewer) {
    if (viewer == NULL)
        return;
    for (int i = 0; i < viewer->side_count; i++)
        hd_view_side_close(&viewer->sides[i]);
    hd_view_image_free(&viewer->composed);
    free(viewer);
}
