/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "cli/console.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/text.h"
#include "device/kernel_source.h"
#include "system/interrupt.h"
#include "system/warnings.h"

/* ---- before anything is done ---- */

static void note_meshes(const HdScene *scene) {
    int64_t dropped = 0;
    for (int i = 0; i < scene->mesh_count; i++)
        dropped += scene->meshes[i].degenerate_count;
    fprintf(stderr,
            "meshes    %d with %" PRId64 " triangles, and %" PRId64
            " without an area left out; in %d place%s, %d texture%s\n",
            scene->mesh_count, hd_scene_triangle_count(scene), dropped, scene->instance_count,
            hd_plural(scene->instance_count), scene->picture_count,
            hd_plural(scene->picture_count));
}

static void note_accuracy(const HdScene *scene) {
    static const char *const samplings[] = {
        [HD_SAMPLING_GRID] = "all samples of each pixel",
        [HD_SAMPLING_ADAPTIVE] = "as many samples as each pixel needs",
        [HD_SAMPLING_REFERENCE] = "dense samples",
    };
    fprintf(stderr, "accuracy  %s; ", samplings[scene->sampling]);
    if (scene->max_error > 0.0)
        fprintf(stderr,
                "rays and lights are left out that change no pixel by more than %g of 255 steps\n",
                scene->max_error);
    else
        fprintf(stderr, "rays end by depth and cut-off\n");
}

static void note_scene(const char *name, const HdScene *scene) {
    const int lights = hd_scene_light_count(scene);
    fprintf(stderr,
            "scene     %s: %d solid%s, %s floor, %d light%s, %d frame%s of %d x %d pixels, %d x %d "
            "samples, depth %d\n",
            name, scene->solid_count, hd_plural(scene->solid_count),
            scene->floor.present ? "a" : "no", lights, hd_plural(lights), scene->frame_count,
            hd_plural(scene->frame_count), scene->width, scene->height, scene->samples_per_side,
            scene->samples_per_side, scene->depth);
    if (scene->mesh_count > 0)
        note_meshes(scene);
    if (hd_scene_is_surveyed(scene))
        note_accuracy(scene);
}

static void note_outputs(const HdOutputPlan *plan, int frame_count) {
    fprintf(stderr, "outputs   ");
    for (int i = 0; i < plan->count; i++)
        fprintf(stderr, "%s%s", i > 0 ? ", " : "", plan->list[i].name);
    fprintf(stderr, " (%d frame%s, %d bits where the format has a choice, %s)\n", frame_count,
            hd_plural(frame_count), plan->style.picture.bits,
            plan->style.picture.curve == HD_CURVE_SRGB ? "sRGB" : "linear");
}

void hd_console_tell_run(const char *name, const HdScene *scene, const HdOutputPlan *plan,
                         int frame_count) {
    note_scene(name, scene);
    note_outputs(plan, frame_count);
}

void hd_console_start(HdConsole *console, const HdOptions *options, bool wants_lines,
                      const HdResume *resume) {
    HdProgressForm form = HD_PROGRESS_NONE;
    if (resume->finished_count > 0 && !options->quiet)
        fprintf(stderr, "hedron: %d of %d frames were finished already\n", resume->finished_count,
                resume->all->count);
    if (options->tells_frames)
        form = HD_PROGRESS_FRAMES;
    else if (!options->quiet)
        form = hd_progress_form(wants_lines);
    *console = (HdConsole){
        .verbose = options->verbose,
        .quiet = options->quiet,
        .progress = hd_progress_start(form, form == HD_PROGRESS_FRAMES ? resume->all->count
                                                                       : resume->missing.count),
        .mutex = PTHREAD_MUTEX_INITIALIZER,
    };
}

/* ---- devices ---- */

void hd_console_prepare(const HdConsole *console, const char *what) {
    if (!console->verbose)
        hd_progress_prepare(&console->progress, what);
}

static void note_device(const HdTeamDevice *opened, const char *why) {
    const HdDevice *device = &opened->device;
    char launch[128];
    fprintf(stderr, "device    %s %d, %s (%s): %s\n", device->backend->name, device->index,
            device->name, device->driver, why);
    hd_launch_describe(&opened->launch, launch, sizeof launch);
    if (opened->is_tuned)
        fprintf(stderr, "launch    %s: the best for this kind of scene, by 'hedron tune'\n",
                launch);
}

void hd_console_tell_devices(const HdConsole *console, const HdDeviceTeam *team) {
    hd_progress_end(&console->progress);
    if (team == NULL)
        return;
    if (team->note[0] != '\0' && !console->quiet)
        fprintf(stderr, "hedron: %s\n", team->note);
    for (int i = 0; i < team->count && console->verbose; i++)
        note_device(&team->list[i], team->why);
}

static void note_renderer(const HdRenderer *renderer, const char *line,
                          const HdSceneTables *tables) {
    const char *kernels = hd_renderer_kernels_note(renderer);
    HdKernelNeeds needs = hd_kernel_needs(tables);
    char built_for[256];
    fprintf(stderr, "renderer  %s\n", line);
    hd_kernel_needs_describe(&needs, built_for, sizeof built_for);
    fprintf(stderr, "kernels   %d planes; %s\n", tables->plane_count,
            hd_renderer_device(renderer)->backend->kernels == NULL
                ? "compiled ahead, for scenes of any size"
                : built_for);
    if (kernels[0] != '\0')
        fprintf(stderr, "build     %s\n", kernels);
}

static void tell_fallbacks(const HdConsole *console) {
    char text[HD_FALLBACK_LENGTH];
    while (hd_fallback_take(text))
        if (!console->quiet)
            fprintf(stderr, "hedron: %s\n", text);
}

void hd_console_tell_upload(HdConsole *console, const HdRenderer *renderer, const char *line,
                            const HdSceneTables *tables) {
    pthread_mutex_lock(&console->mutex);
    if (console->verbose) {
        hd_progress_end(&console->progress);
        note_renderer(renderer, line, tables);
    }
    tell_fallbacks(console);
    hd_progress_update(&console->progress, console->rendered);
    pthread_mutex_unlock(&console->mutex);
}

void hd_console_tell_loss(HdConsole *console, const HdDevice *device, const char *why) {
    pthread_mutex_lock(&console->mutex);
    hd_progress_end(&console->progress);
    fprintf(stderr,
            "hedron: %s:%d (%s) failed, so other devices trace its frames from here on: %s\n",
            device->backend->name, device->index, device->name, why);
    pthread_mutex_unlock(&console->mutex);
}

/* ---- frames ---- */

static void count_frame(HdConsole *console, const HdFrame *frame) {
    console->rendered++;
    console->rays += hd_frame_rays(frame);
    if (frame->has_bound && frame->largest_bound > console->missing)
        console->missing = frame->largest_bound;
}

/* Programs are told of every frame, people of those that were rendered. */
void hd_console_tell_frame(HdConsole *console, const HdStoredFrame *stored) {
    pthread_mutex_lock(&console->mutex);
    hd_progress_tell_frame(&console->progress, stored->number, stored->done);
    if (!stored->was_finished)
        count_frame(console, stored->frame);
    hd_progress_update(&console->progress, console->rendered);
    pthread_mutex_unlock(&console->mutex);
}

void hd_console_announce_interrupt(const HdConsole *console) {
    if (console->quiet || !isatty(STDERR_FILENO))
        return;
    hd_interrupt_announce(console->progress.form == HD_PROGRESS_BAR
                              ? "\r\033[Khedron: stopping; press Ctrl-C again to stop now\n"
                              : "hedron: stopping; press Ctrl-C again to stop now\n");
}

/* ---- the end ---- */

static void note_changes(const HdDeviceTeam *team, const char (*lines)[HD_RENDERER_LINE]) {
    for (int i = 0; i < team->count; i++) {
        char line[HD_RENDERER_LINE];
        hd_renderer_describe(team->list[i].renderer, line, sizeof line);
        if (lines[i][0] != '\0' && strcmp(line, lines[i]) != 0)
            fprintf(stderr, "renderer  %s\n", line);
    }
}

/* Where more may be missing from a picture than the scene allows. */
static void tell_missing(const HdConsole *console, const HdScene *scene) {
    if (scene->max_error > 0.0 && console->missing > scene->max_error)
        fprintf(stderr,
                "hedron: up to %.3g steps of 255 may be missing from a pixel, more than the %g of "
                "--max-error: rays end by --depth or --cutoff, or the scene has too many of them\n",
                console->missing, scene->max_error);
}

void hd_console_end(const HdConsole *console, const HdScene *scene, const HdDeviceTeam *team,
                    const char (*lines)[HD_RENDERER_LINE], HdStatus status) {
    hd_interrupt_announce(NULL);
    hd_progress_end(&console->progress);
    tell_fallbacks(console);
    if (status == HD_OK && team->count > 0)
        hd_progress_tell_end(&console->progress, console->rays);
    if (console->verbose)
        note_changes(team, lines);
    if (status == HD_OK && !console->quiet)
        tell_missing(console, scene);
}
