/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "view/viewer.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/minmax.h"
#include "base/trigonometry.h"
#include "scene/sample_pattern.h"
#include "view/side.h"

/* Seconds without input after which the whole picture is rendered. */
#define STILL_SECONDS 0.25

/* Interval between two checks of the files in seconds. */
#define WATCH_SECONDS 0.2

/* Steps of one key press. */
#define ORBIT_STEP (HD_PI / 60.0)
#define PAN_STEP   0.03
#define DOLLY_STEP 1.06

/* Flags of a viewer; it saves once the picture is whole. */
enum { SAVES = 1, HIDES_FIGURES = 2, SHOWS_HELP = 4, HAS_ENDED = 8 };

enum { FIRST_GAIN = 16, MAX_GAIN = 128 };

struct HdViewer {
    FILE *out; /* owned by the caller */
    HdViewSide sides[2];
    int side_count, active;
    HdPose pose;
    bool is_free; /* the view is `pose`, not on the camera path */
    int frame;
    bool is_playing;
    double played_from;  /* time of frame 0 */
    int change;          /* number of the current view */
    int asked, settling; /* changes for which moving and whole pictures were requested */
    double now;          /* time of the current key, drag or tick */
    double moved;        /* time of the last change */
    double watched;
    HdPace pace;
    int max_width;          /* limit of moving pictures; 0: the scene's */
    double last_picture;    /* time of the last moving picture */
    double picture_seconds; /* interval between two, smoothed; 0: unknown */
    HdViewImage composed;
    HdSplitFigures figures;
    int version; /* number of the shown picture */
    int gain;
    unsigned flags;
    char note[512]; /* result of the last key */
};

static void change_view(HdViewer *viewer) {
    viewer->change++;
    viewer->moved = viewer->now;
}

static const HdSceneFile *file_of(const HdViewer *viewer) {
    return &viewer->sides[0].file;
}

/* ---- the eye ---- */

static void leave_path(HdViewer *viewer) {
    if (!viewer->is_free)
        viewer->pose = hd_pose_on_path(&file_of(viewer)->scene, viewer->frame);
    viewer->is_free = true;
    viewer->is_playing = false;
}

static void move_eye(HdViewer *viewer, void (*move)(HdPose *pose, double right, double up),
                     double right, double up) {
    leave_path(viewer);
    move(&viewer->pose, right, up);
    change_view(viewer);
}

static void show_frame(HdViewer *viewer, int frame) {
    const int count = file_of(viewer)->scene.frame_count;
    viewer->frame = (frame % count + count) % count;
    viewer->is_free = false;
    change_view(viewer);
}

static void advance_path(HdViewer *viewer) {
    const double passed =
        (viewer->now - viewer->played_from) * hd_frame_rate(&file_of(viewer)->output.style);
    const int frame = (int)fmod(passed, file_of(viewer)->scene.frame_count);
    if (viewer->is_playing && frame != viewer->frame)
        show_frame(viewer, frame);
}

static HdStatus find_camera(const HdViewer *viewer, HdCamera *camera, HdError *error) {
    HdScene scene = file_of(viewer)->scene; /* the side keeps ownership */
    if (viewer->is_free)
        hd_pose_apply(&viewer->pose, &scene);
    return hd_camera_at(camera, &scene, viewer->is_free ? 0 : viewer->frame, error);
}

/* ---- requests to the workers ---- */

static bool all_idle(HdViewer *viewer) {
    bool idle = true;
    for (int i = 0; i < viewer->side_count; i++)
        idle = idle && hd_view_side_is_idle(&viewer->sides[i]);
    return idle;
}

static HdDetail max_detail(const HdViewer *viewer) {
    const HdScene *scene = &file_of(viewer)->scene;
    HdDetail full = {scene->width, scene->height, scene->samples_per_side, hd_sample_rows(scene),
                     scene->depth};
    if (viewer->max_width > 0 && viewer->max_width < full.width) {
        const double scale = (double)viewer->max_width / full.width;
        full.width = viewer->max_width;
        full.height = (int)fmax(1.0, scale * full.height);
    }
    return full;
}

static void request_for(HdViewer *viewer, bool quickly) {
    HdError error;
    HdViewRequest request = {.is_moving = quickly};
    const HdDetail full = max_detail(viewer);
    viewer->asked = viewer->change;
    viewer->settling = quickly ? 0 : viewer->change;
    if (find_camera(viewer, &request.camera, &error) != HD_OK) {
        snprintf(viewer->note, sizeof viewer->note, "%.500s", error.message);
        return;
    }
    request.detail = hd_pace_choose(&viewer->pace, &full);
    for (int i = 0; i < viewer->side_count; i++)
        hd_view_side_show(&viewer->sides[i], &request);
}

static bool is_moving(const HdViewer *viewer) {
    return viewer->is_playing || viewer->now - viewer->moved < STILL_SECONDS;
}

int hd_viewer_wait_ms(HdViewer *viewer) {
    return !all_idle(viewer) ? 1 : is_moving(viewer) ? 4 : 100;
}

/* A pending moving picture is awaited, so that pictures appear; a whole one is not. */
static void request_pictures(HdViewer *viewer) {
    const bool idle = all_idle(viewer);
    if (viewer->asked != viewer->change && (idle || viewer->settling != 0))
        request_for(viewer, true);
    else if (idle && viewer->settling != viewer->change && !is_moving(viewer))
        request_for(viewer, false);
}

/* ---- pictures of the workers ---- */

static void note_moving_picture(HdViewer *viewer, const HdViewImage *image) {
    const double seconds = viewer->now - viewer->last_picture;
    hd_pace_note(&viewer->pace, &image->detail, image->seconds);
    viewer->last_picture = viewer->now;
    if (seconds > 1.0)
        viewer->picture_seconds = 0.0;
    else if (viewer->picture_seconds > 0.0)
        viewer->picture_seconds += 0.1 * (seconds - viewer->picture_seconds);
    else
        viewer->picture_seconds = seconds;
}

static void fetch_pictures(HdViewer *viewer) {
    for (int i = 0; i < viewer->side_count; i++) {
        if (!hd_view_side_fetch(&viewer->sides[i]))
            continue;
        viewer->version++;
        if (viewer->settling == 0 && i == 0)
            note_moving_picture(viewer, &viewer->sides[i].image);
    }
}

const HdViewImage *hd_viewer_picture(HdViewer *viewer, int *version) {
    HdError error;
    const HdViewImage *first = &viewer->sides[0].image;
    const bool is_new = *version != viewer->version;
    *version = viewer->version;
    if (viewer->side_count == 1)
        return first;
    if (is_new && hd_view_image_split(&viewer->composed, first, &viewer->sides[1].image,
                                      viewer->gain, &viewer->figures, &error) != HD_OK)
        snprintf(viewer->note, sizeof viewer->note, "%.500s", error.message);
    return &viewer->composed;
}

/* ---- saving ---- */

/* Makes a name from the scene's, without its folder and ending, and the first free number. */
static void choose_name(const HdViewer *viewer, char path[160]) {
    char name[128];
    const char *scene = viewer->sides[0].scene_plan.path;
    const char *slash = scene != NULL ? strrchr(scene, '/') : NULL;
    snprintf(name, sizeof name, "%s", slash != NULL ? slash + 1 : scene != NULL ? scene : "hedron");
    char *dot = strrchr(name, '.');
    if (dot != NULL && dot != name)
        *dot = '\0';
    int number = 1;
    do
        snprintf(path, 160, "%s-%03d.png", name, number);
    while (access(path, F_OK) == 0 && ++number < 1000);
}

static void save_when_whole(HdViewer *viewer) {
    char path[160];
    HdError error;
    if ((viewer->flags & SAVES) == 0 || viewer->settling != viewer->change || !all_idle(viewer))
        return;
    viewer->flags ^= SAVES;
    choose_name(viewer, path);
    if (hd_view_side_save(&viewer->sides[viewer->active], path, &error) != HD_OK) {
        snprintf(viewer->note, sizeof viewer->note, "%.500s", error.message);
        return;
    }
    snprintf(viewer->note, sizeof viewer->note, "saved %s", path);
    fprintf(viewer->out, "%s\n", path);
    fflush(viewer->out);
}

static void print_camera(HdViewer *viewer, int by) {
    const HdScene *scene = &file_of(viewer)->scene;
    const HdPose pose = viewer->is_free ? viewer->pose : hd_pose_on_path(scene, viewer->frame);
    (void)by;
    hd_pose_print(viewer->out, &pose, scene->field_of_view_degrees);
    fflush(viewer->out);
    snprintf(viewer->note, sizeof viewer->note, "the camera goes to standard output");
}

/* ---- keys ---- */

static void play(HdViewer *viewer, int by) {
    (void)by;
    viewer->is_playing = !viewer->is_playing;
    if (viewer->is_playing)
        viewer->is_free = false;
    viewer->played_from =
        viewer->now - (double)viewer->frame / hd_frame_rate(&file_of(viewer)->output.style);
    change_view(viewer);
}

/* 0: returns from a free view, and continues a camera path that plays. */
static void step(HdViewer *viewer, int by) {
    viewer->is_playing = viewer->is_playing && by == 0;
    show_frame(viewer, viewer->frame + by);
}

static void dolly(HdViewer *viewer, int by) {
    leave_path(viewer);
    hd_pose_dolly(&viewer->pose, by > 0 ? 1.0 / DOLLY_STEP : DOLLY_STEP);
    change_view(viewer);
}

static void split(HdViewer *viewer, int by) {
    HdError error;
    HdStatus status = HD_OK;
    const HdViewSide *first = &viewer->sides[0];
    (void)by;
    if (viewer->side_count == 2)
        hd_view_side_close(&viewer->sides[1]);
    else
        status = hd_view_side_open(&viewer->sides[1], &first->scene_plan, &first->devices, &error);
    if (status != HD_OK)
        snprintf(viewer->note, sizeof viewer->note, "%.500s", error.message);
    viewer->side_count = status == HD_OK && viewer->side_count == 1 ? 2 : 1;
    viewer->active = viewer->side_count - 1;
    change_view(viewer);
}

static void other_side(HdViewer *viewer, int by) {
    (void)by;
    viewer->active = (viewer->active + 1) % viewer->side_count;
}

static void change_gain(HdViewer *viewer, int by) {
    viewer->gain = by > 0 ? hd_min(2 * viewer->gain, MAX_GAIN) : hd_max(viewer->gain / 2, 1);
    viewer->version++;
}

/* Action of a key: a function of the above, a step of the eye, a setting of the active side, or
   only flags that it sets or toggles. */
static const struct Key {
    int key;
    void (*act)(HdViewer *viewer, int by);
    void (*move)(HdPose *pose, double right, double up);
    double right, up;
    HdViewSetting setting;
    int by;
    unsigned sets, turns;
} keys[] = {
    {.key = ' ', .act = play},
    {.key = '0', .act = step, .by = 0},
    {.key = ',', .act = step, .by = -1},
    {.key = '.', .act = step, .by = 1},
    {.key = HD_KEY_LEFT, .move = hd_pose_orbit, .right = -ORBIT_STEP},
    {.key = HD_KEY_RIGHT, .move = hd_pose_orbit, .right = ORBIT_STEP},
    {.key = HD_KEY_UP, .move = hd_pose_orbit, .up = ORBIT_STEP},
    {.key = HD_KEY_DOWN, .move = hd_pose_orbit, .up = -ORBIT_STEP},
    {.key = 'a', .move = hd_pose_pan, .right = -PAN_STEP},
    {.key = 'd', .move = hd_pose_pan, .right = PAN_STEP},
    {.key = 'w', .move = hd_pose_pan, .up = PAN_STEP},
    {.key = 's', .move = hd_pose_pan, .up = -PAN_STEP},
    {.key = '+', .act = dolly, .by = 1},
    {.key = '=', .act = dolly, .by = 1},
    {.key = '-', .act = dolly, .by = -1},
    {.key = 'b', .setting = HD_VIEW_BACKEND, .by = 1},
    {.key = 'v', .setting = HD_VIEW_DEVICE, .by = 1},
    {.key = 'f', .setting = HD_VIEW_PRECISION, .by = 1},
    {.key = '[', .setting = HD_VIEW_DEPTH, .by = -1},
    {.key = ']', .setting = HD_VIEW_DEPTH, .by = 1},
    {.key = 'n', .setting = HD_VIEW_SAMPLES, .by = -1},
    {.key = 'm', .setting = HD_VIEW_SAMPLES, .by = 1},
    {.key = 'x', .setting = HD_VIEW_SAMPLING, .by = 1},
    {.key = '2', .act = split},
    {.key = '\t', .act = other_side},
    {.key = 'g', .act = change_gain, .by = -1},
    {.key = 'G', .act = change_gain, .by = 1},
    {.key = 'p', .sets = SAVES},
    {.key = 'c', .act = print_camera},
    {.key = 'o', .turns = HIDES_FIGURES},
    {.key = 'h', .turns = SHOWS_HELP},
    {.key = '?', .turns = SHOWS_HELP},
    {.key = 'q', .sets = HAS_ENDED},
    {.key = 27, .sets = HAS_ENDED},
    {.key = 3, .sets = HAS_ENDED}, /* Ctrl-C in a terminal that sends it as a character */
};

/* Help for the keys; each line below 64 characters. */
static const char *const key_lines[] = {
    "space    play the camera path, or stop it",
    ", .      a frame back, a frame on",
    "0        back from a free view to the camera path",
    "arrows   turn about the target (drag with the left button)",
    "w a s d  move (drag with the right button)",
    "+ -      nearer, farther (the wheel)",
    "b v      next backend, next device",
    "f        float or double",
    "[ ]      less or more depth",
    "n m      fewer or more samples",
    "x        grid or multi-jittered samples",
    "2        split: two settings and their difference",
    "tab      the other side of the split, for the keys above",
    "g G      less or more of the difference",
    "p        save the picture, once it is finished",
    "c        print the camera as JSON",
    "o h q    figures, this help, quit",
};

/* A camera path that was read again may be shorter. */
static void settings_changed(HdViewer *viewer) {
    viewer->frame %= file_of(viewer)->scene.frame_count;
    change_view(viewer);
}

void hd_viewer_key(HdViewer *viewer, int code, double now) {
    const struct Key *key = keys, *end_of_keys = keys + sizeof keys / sizeof keys[0];
    while (key < end_of_keys && key->key != code)
        key++;
    if (key == end_of_keys)
        return;
    viewer->now = now;
    viewer->note[0] = '\0';
    viewer->flags = (viewer->flags | key->sets) ^ key->turns;
    if (key->act != NULL) {
        key->act(viewer, key->by);
    } else if (key->move != NULL) {
        move_eye(viewer, key->move, key->right, key->up);
    } else if (key->by != 0) {
        hd_view_side_change(&viewer->sides[viewer->active], key->setting, key->by);
        settings_changed(viewer);
    }
}

void hd_viewer_drag(HdViewer *viewer, bool moves, double right, double down, double now) {
    viewer->now = now;
    if (moves)
        move_eye(viewer, hd_pose_pan, -right, down);
    else
        move_eye(viewer, hd_pose_orbit, -HD_PI * right, HD_PI * down);
}

/* ---- lines of text ---- */

typedef struct Lines {
    char (*text)[HD_VIEW_LINE];
    int count;
} Lines;

/* Breaks text that is too long for a line at a space. */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
static void
add(Lines *lines, const char *format, ...) {
    char all[4600], *text = all;
    va_list values;
    va_start(values, format);
    vsnprintf(all, sizeof all, format, values);
    va_end(values);
    while (*text != '\0' && lines->count < HD_VIEW_LINES) {
        size_t length = strcspn(text, "\n");
        if (length > HD_VIEW_LINE - 2) {
            length = HD_VIEW_LINE - 2;
            while (length > HD_VIEW_LINE / 2 && text[length] != ' ')
                length--;
        }
        snprintf(lines->text[lines->count++], HD_VIEW_LINE, "%.*s", (int)length, text);
        text += length;
        text += *text == ' ' || *text == '\n';
    }
}

static void add_settings(Lines *lines, HdViewer *viewer, int number) {
    HdViewSide *side = &viewer->sides[number];
    const HdScene *scene = &side->file.scene;
    const bool is_split = viewer->side_count > 1;
    char device[512], problem[4096], prefix[24] = "";
    hd_view_side_describe(side, device, sizeof device, problem, sizeof problem);
    if (is_split)
        snprintf(prefix, sizeof prefix, "%s%s: ", number == 0 ? "left" : "right",
                 viewer->active == number ? " *" : "");
    add(lines, "%s%s", prefix, device);
    add(lines, "%s%s, depth %d, %s, %d x %d samples", prefix,
        side->devices.render.precision == HD_PRECISION_DOUBLE ? "double" : "float", scene->depth,
        hd_sampling_names[scene->sampling], scene->samples_per_side, hd_sample_rows(scene));
    if (problem[0] != '\0')
        add(lines, "! %s", problem);
    if (side->file_error[0] != '\0' && number == 0)
        add(lines, "! %s", side->file_error);
}

static void add_whole(Lines *lines, const HdViewImage *image) {
    char bound[64] = "";
    if (image->has_bound)
        snprintf(bound, sizeof bound, ", error bound %.2g of 255", image->largest_bound);
    add(lines, "finished: %d x %d, %.0f ms, %.1f Mrays/s%s", image->width, image->height,
        1e3 * image->seconds, 1e-6 * (double)image->rays / image->seconds, bound);
}

static void add_speed(Lines *lines, const HdViewer *viewer, const HdViewImage *image) {
    if (image->width == 0)
        add(lines, "waiting for the first picture");
    else if (image->is_settled)
        add_whole(lines, image);
    else if (viewer->settling != 0)
        add(lines, "refining: %d x %d samples, %.0f %%", image->detail.samples,
            image->detail.sample_rows, 100.0 * image->share);
    else
        add(lines, "moving: %d x %d, %d x %d, depth %d, %.1f ms, %.1f frames/s, %.1f Mrays/s",
            image->width, image->height, image->detail.samples, image->detail.sample_rows,
            image->detail.depth, 1e3 * image->seconds,
            viewer->picture_seconds > 0.0 ? 1.0 / viewer->picture_seconds : 0.0,
            1e-6 * (double)image->rays / image->seconds);
}

static void add_difference(Lines *lines, const HdViewer *viewer) {
    const HdSplitFigures *figures = &viewer->figures;
    if (figures->is_unlike)
        add(lines, "difference: the pictures have different sizes");
    else
        add(lines, "difference x %d below: largest %d of 255, %.2f %% of the pixels", viewer->gain,
            figures->largest, 100.0 * figures->share);
}

static void add_place(Lines *lines, const HdViewer *viewer) {
    const int count = viewer->sides[0].file.scene.frame_count;
    if (viewer->is_free)
        add(lines, "a free view; h: help");
    else
        add(lines, "frame %d of %d%s; h: help", viewer->frame, count,
            viewer->is_playing ? ", playing" : "");
}

int hd_viewer_lines(HdViewer *viewer, char text[HD_VIEW_LINES][HD_VIEW_LINE]) {
    Lines lines = {.text = text};
    const bool has_figures = (viewer->flags & HIDES_FIGURES) == 0;
    for (int i = 0; i < viewer->side_count && has_figures; i++) {
        add_settings(&lines, viewer, i);
        add_speed(&lines, viewer, &viewer->sides[i].image);
    }
    if (has_figures && viewer->side_count > 1)
        add_difference(&lines, viewer);
    if (has_figures)
        add_place(&lines, viewer);
    if ((viewer->flags & SAVES) != 0)
        add(&lines, "once the picture is finished, it goes to a file");
    if (!has_figures && viewer->sides[0].file_error[0] != '\0')
        add(&lines, "! %s", viewer->sides[0].file_error);
    add(&lines, "%s", viewer->note);
    for (size_t i = 0;
         (viewer->flags & SHOWS_HELP) != 0 && i < sizeof key_lines / sizeof key_lines[0]; i++)
        add(&lines, "%s", key_lines[i]);
    return lines.count;
}

/* ---- open and close ---- */

static void watch_files(HdViewer *viewer) {
    if (viewer->now - viewer->watched < WATCH_SECONDS)
        return;
    viewer->watched = viewer->now;
    for (int i = 0; i < viewer->side_count; i++)
        if (hd_view_side_follow_files(&viewer->sides[i]))
            settings_changed(viewer);
}

bool hd_viewer_tick(HdViewer *viewer, double now) {
    viewer->now = now;
    fetch_pictures(viewer);
    watch_files(viewer);
    advance_path(viewer);
    request_pictures(viewer);
    save_when_whole(viewer);
    return (viewer->flags & HAS_ENDED) == 0;
}

bool hd_viewer_is_split(const HdViewer *viewer) {
    return viewer->side_count > 1;
}

void hd_viewer_size(const HdViewer *viewer, int *width, int *height) {
    *width = file_of(viewer)->scene.width;
    *height = file_of(viewer)->scene.height;
}

void hd_viewer_limit(HdViewer *viewer, int width) {
    viewer->max_width = width;
}

HdStatus hd_viewer_open(HdViewer **viewer, const HdScenePlan *scene, const HdDevicePlan *devices,
                        FILE *out, HdError *error) {
    HdViewer *v = calloc(1, sizeof *v);
    if (v == NULL)
        return HD_NO_ROOM(error, "a view");
    v->out = out;
    v->gain = FIRST_GAIN;
    v->change = 1;
    v->side_count = 1;
    HdStatus status = hd_view_side_open(&v->sides[0], scene, devices, error);
    if (status == HD_OK)
        *viewer = v;
    else
        free(v);
    return status;
}

void hd_viewer_close(HdViewer *viewer) {
    if (viewer == NULL)
        return;
    for (int i = 0; i < viewer->side_count; i++)
        hd_view_side_close(&viewer->sides[i]);
    hd_view_image_free(&viewer->composed);
    free(viewer);
}
