/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "cli/console.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

#include "base/text.h"
#include "cli/mesh_report.h"
#include "device/kernel_source.h"
#include "scene/sample_pattern.h"
#include "system/interrupt.h"
#include "system/machine.h"
#include "system/thread_pool.h"

enum { BAR_WIDTH = 24, SECONDS_BETWEEN_LINES = 5, MAX_HOURS = 99999, USUAL_COLUMNS = 80 };

/* Seconds before a running frame is polled, and between polls; share of a frame between plain
   lines: a frame of an hour gets a hundred of them. */
static const double LONG_FRAME = 1.0, POLL_INTERVAL = 0.2, MIN_PART = 0.01;

/* Seconds of preparing devices from which on the last line mentions it. */
static const double MIN_PREPARING = 0.1;

/* ---- progress ---- */

/* Writes "m:ss", or "h:mm:ss" from an hour on, rounded to the nearest second. */
static void format_time(double seconds, char text[32]) {
    const double most = MAX_HOURS * 3600.0;
    long whole = (long)((seconds < most ? seconds : most) + 0.5);
    if (whole < 3600)
        snprintf(text, 32, "%ld:%02ld", whole / 60, whole % 60);
    else
        snprintf(text, 32, "%ld:%02ld:%02ld", whole / 3600, whole / 60 % 60, whole % 60);
}

static double frames_of(const HdProgress *progress) {
    return progress->done + progress->part;
}

/* Returns the seconds without opening devices and building kernels before the first frame. */
static double seconds_rendering(const HdProgress *progress) {
    return progress->seconds - progress->seconds_preparing;
}

static double seconds_left(const HdProgress *progress) {
    const double frames = frames_of(progress);
    return (progress->total - frames) * seconds_rendering(progress) / frames;
}

void hd_progress_line(const HdProgress *progress, char text[128]) {
    const double seconds = seconds_rendering(progress), part = progress->part;
    const bool is_end = progress->done == progress->total;
    char time[32];
    snprintf(text, 128, "%d/%d frames", progress->done, progress->total);
    if (frames_of(progress) <= 0.0)
        return;
    if (part >= 1.0)
        hd_add_text(text, 128, ", ", "%.1f of the next", part);
    else if (part > 0.0)
        hd_add_text(text, 128, ", ", "%d %% of the next", (int)(100.0 * part));
    if (progress->done > 0)
        hd_add_text(text, 128, ", ", "%.2f frames/s",
                    seconds > 0.0 ? progress->done / seconds : 0.0);
    format_time(is_end ? progress->seconds : seconds_left(progress), time);
    hd_add_text(text, 128, ", ", "%s %s", time, is_end ? "in all" : "left");
    if (is_end && progress->seconds_preparing >= MIN_PREPARING)
        hd_add_text(text, 128, ", ", "%.1f s of it to prepare", progress->seconds_preparing);
}

void hd_progress_bar(const HdProgress *progress, const char *line, int columns, char text[160]) {
    char bar[BAR_WIDTH + 1] = "........................";
    int filled = progress->total > 0
                     ? (int)(frames_of(progress) * BAR_WIDTH / progress->total + 1e-9)
                     : BAR_WIDTH;
    memset(bar, '#', (size_t)filled);
    if (BAR_WIDTH + 3 + (int)strlen(line) <= columns)
        snprintf(text, 160, "[%s] %.120s", bar, line);
    else
        snprintf(text, 160, "%.*s", columns, line);
}

static int terminal_columns(void) {
    struct winsize size;
    const bool is_known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
    return is_known ? size.ws_col : USUAL_COLUMNS;
}

static void draw(const char *text) {
    fprintf(stderr, "\r%s\033[K", text);
    fflush(stderr);
}

void hd_console_clear(const HdConsole *console) {
    if (console->form == HD_PROGRESS_BAR)
        fprintf(stderr, "\r\033[K");
}

static bool is_frame_long(const HdConsole *console, double now) {
    return console->tracing_from > 0.0 && now - console->frame_seconds >= LONG_FRAME;
}

/* Returns the frames that are traced but not stored, in frames. It also counts the work that a lost
   device did on a frame, so it may exceed what is left. */
static double part_in_flight(const HdConsole *console) {
    const double part = hd_watch_frames(console->watch) - console->rendered;
    const double most = console->total - console->rendered - 0.01;
    return part > most ? most : part;
}

static HdProgress progress_of(const HdConsole *console, double now) {
    HdProgress progress = {
        .done = console->rendered,
        .total = console->total,
        .seconds = now - console->start_seconds,
    };
    if (console->tracing_from > 0.0)
        progress.seconds_preparing = console->tracing_from - console->start_seconds;
    if (is_frame_long(console, now) && part_in_flight(console) > 0.0)
        progress.part = part_in_flight(console);
    return progress;
}

static bool shows_progress(const HdConsole *console) {
    return console->form == HD_PROGRESS_BAR || console->form == HD_PROGRESS_LINES;
}

/* Redraws the bar, or writes a line if the last one is long enough ago. */
static void update(HdConsole *console) {
    char line[128], bar[160];
    double now = hd_monotonic_seconds();
    if (!shows_progress(console) || !hd_wait_to_write(STDERR_FILENO))
        return;
    const HdProgress progress = progress_of(console, now);
    hd_progress_line(&progress, line);
    if (console->form == HD_PROGRESS_BAR) {
        /* some terminals begin a new line after the last column */
        hd_progress_bar(&progress, line, terminal_columns() - 1, bar);
        draw(bar);
    } else if (progress.done < progress.total &&
               now - console->line_seconds >= SECONDS_BETWEEN_LINES &&
               frames_of(&progress) - console->line_frames >= MIN_PART) {
        fprintf(stderr, "%s\n", line);
        console->line_seconds = now;
        console->line_frames = frames_of(&progress);
    }
}

/* ---- within frames ---- */

static void wait_poll_interval(HdConsole *console) {
    struct timespec until;
    clock_gettime(CLOCK_REALTIME, &until); /* the condition's clock; a jump only lengthens a wait */
    until.tv_nsec += (long)(1e9 * POLL_INTERVAL);
    until.tv_sec += until.tv_nsec / 1000000000;
    until.tv_nsec %= 1000000000;
    pthread_cond_timedwait(&console->over, &console->mutex, &until);
}

static void *watch(void *argument) {
    HdConsole *console = argument;
    pthread_mutex_lock(&console->mutex);
    while (!console->is_over) {
        wait_poll_interval(console);
        const bool goes_on = !console->is_over && hd_interrupt_signal() == 0;
        if (goes_on && is_frame_long(console, hd_monotonic_seconds()))
            update(console);
    }
    pthread_mutex_unlock(&console->mutex);
    return NULL;
}

/* If the thread cannot start, only whole frames are reported. */
void hd_console_watch(HdConsole *console, const HdWatch *frames) {
    if (!console->quiet && isatty(STDERR_FILENO))
        hd_interrupt_announce(console->form == HD_PROGRESS_BAR
                                  ? "\r\033[Khedron: stopping; press Ctrl-C again to stop now\n"
                                  : "hedron: stopping; press Ctrl-C again to stop now\n");
    console->watch = frames;
    console->is_over = !shows_progress(console);
    if (!console->is_over && hd_start_thread(&console->watcher, watch, console) != 0)
        console->is_over = true;
}

void hd_console_hold(HdConsole *console) {
    pthread_mutex_lock(&console->mutex);
    if (console->form == HD_PROGRESS_BAR && hd_wait_to_write(STDERR_FILENO))
        hd_console_clear(console);
}

/* ---- start ---- */

/* Chooses a bar on a terminal that can redraw a line; elsewhere plain lines, if wanted. */
static HdProgressForm choose_form(const HdReportPlan *reporting) {
    const char *terminal = getenv("TERM");
    bool can_redraw = terminal != NULL && strcmp(terminal, "dumb") != 0;
    if (reporting->reports_frames)
        return HD_PROGRESS_FRAMES;
    if (reporting->quiet)
        return HD_PROGRESS_NONE;
    if (can_redraw && isatty(STDERR_FILENO))
        return HD_PROGRESS_BAR;
    return reporting->wants_lines ? HD_PROGRESS_LINES : HD_PROGRESS_NONE;
}

void hd_console_open(HdConsole *console, const HdReportPlan *reporting) {
    *console = (HdConsole){
        .verbose = reporting->verbose,
        .quiet = reporting->quiet,
        .form = choose_form(reporting),
        .mutex = PTHREAD_MUTEX_INITIALIZER,
        .over = PTHREAD_COND_INITIALIZER,
    };
}

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
        [HD_SAMPLING_GRID] = "a grid of samples in each pixel",
        [HD_SAMPLING_MULTIJITTER] = "multi-jittered samples in each pixel",
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

static void note_scene(const char *name, const HdSceneFile *file, int frame) {
    const HdScene *scene = &file->scene;
    const int lights = hd_scene_light_count(scene);
    fprintf(stderr,
            "scene     %s: %d solid%s, %s floor, %d light%s, %d frame%s of %d x %d pixels, %d x %d "
            "samples, depth %d\n",
            name, scene->solid_count, hd_plural(scene->solid_count),
            scene->floor.present ? "a" : "no", lights, hd_plural(lights), scene->frame_count,
            hd_plural(scene->frame_count), scene->width, scene->height, scene->samples_per_side,
            hd_sample_rows(scene), scene->depth);
    if (scene->mesh_count > 0)
        note_meshes(scene);
    hd_mesh_report_print(stderr, "mesh      ", file, frame);
    if (hd_scene_has_error_bound(scene))
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

void hd_console_report_run(const HdConsole *console, const char *name, const HdSceneFile *file,
                           const HdOutputPlan *plan, const HdFrameList *frames) {
    if (console->verbose) {
        note_scene(name, file, frames->frames[0]);
        note_outputs(plan, frames->count);
    }
    if (!console->quiet && plan->film_count > 0 && plan->style.picture.bits > 8)
        fprintf(stderr, "hedron: films have 8 bits a channel, though output.bits is %d\n",
                plan->style.picture.bits);
}

void hd_console_prepare(const HdConsole *console, const char *what) {
    if (!console->verbose && console->form == HD_PROGRESS_BAR)
        draw(what);
}

void hd_console_start(HdConsole *console, const HdResume *resume) {
    if (resume->finished_count > 0 && !console->quiet)
        fprintf(stderr, "hedron: %d of %d frames were finished already\n", resume->finished_count,
                resume->all->count);
    console->total =
        console->form == HD_PROGRESS_FRAMES ? resume->all->count : resume->missing.count;
    console->start_seconds = console->line_seconds = hd_monotonic_seconds();
    if (resume->missing.count > 0)
        hd_console_prepare(console, "preparing the device");
}

/* ---- devices ---- */

static void note_device(const HdTeamDevice *opened, const char *why) {
    const HdDevice *device = &opened->device;
    char launch[128];
    fprintf(stderr, "device    %s %d, %s (%s): %s\n", device->backend->name, device->index,
            device->name, device->driver, why);
    hd_launch_describe(&opened->options, launch, sizeof launch);
    if (opened->is_tuned)
        fprintf(stderr, "launch    %s: the best for this kind of scene, by 'hedron tune'\n",
                launch);
}

void hd_console_report_devices(const HdConsole *console, const HdDeviceTeam *team) {
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
            hd_renderer_device(renderer)->backend->functions->kernels == NULL
                ? "compiled ahead, for scenes of any size"
                : built_for);
    if (kernels[0] != '\0')
        fprintf(stderr, "build     %s\n", kernels);
}

static void report_fallbacks(const HdConsole *console) {
    char text[HD_FALLBACK_LENGTH];
    while (hd_fallback_take(text))
        if (!console->quiet)
            fprintf(stderr, "hedron: %s\n", text);
}

void hd_console_report_upload(HdConsole *console, const HdRenderer *renderer, const char *line,
                              const HdSceneTables *tables) {
    pthread_mutex_lock(&console->mutex);
    if (console->tracing_from <= 0.0)
        console->tracing_from = console->frame_seconds = hd_monotonic_seconds();
    if (console->verbose) {
        hd_console_clear(console);
        note_renderer(renderer, line, tables);
    }
    report_fallbacks(console);
    update(console);
    pthread_mutex_unlock(&console->mutex);
}

void hd_console_report_loss(HdConsole *console, const HdDevice *device, const char *why) {
    pthread_mutex_lock(&console->mutex);
    hd_console_clear(console);
    fprintf(stderr,
            "hedron: %s:%d (%s) failed, so other devices trace its frames from here on: %s\n",
            device->backend->name, device->index, device->name, why);
    pthread_mutex_unlock(&console->mutex);
}

/* ---- frames ---- */

static void count_frame(HdConsole *console, const HdFrame *frame) {
    console->rendered++;
    console->frame_seconds = hd_monotonic_seconds();
    console->rays += hd_frame_rays(frame);
    if (frame->has_bound && frame->largest_bound > console->missing)
        console->missing = frame->largest_bound;
    update(console);
}

/* Reports every frame to programs, rendered ones to people. */
void hd_console_release(HdConsole *console, const HdStoredFrame *stored) {
    if (stored != NULL && console->form == HD_PROGRESS_FRAMES && hd_wait_to_write(STDERR_FILENO))
        fprintf(stderr, "hedron: frame %d stored, %d of %d\n", stored->number, stored->done,
                console->total);
    if (stored != NULL && !stored->was_finished)
        count_frame(console, stored->frame);
    pthread_mutex_unlock(&console->mutex);
}

/* ---- end ---- */

static void note_changes(const HdDeviceTeam *team, const char (*lines)[HD_RENDERER_LINE]) {
    for (int i = 0; i < team->count; i++) {
        char line[HD_RENDERER_LINE];
        hd_renderer_describe(team->list[i].renderer, line, sizeof line);
        if (lines[i][0] != '\0' && strcmp(line, lines[i]) != 0)
            fprintf(stderr, "renderer  %s\n", line);
    }
}

static void end_watch(HdConsole *console) {
    pthread_mutex_lock(&console->mutex);
    const bool was_over = console->is_over;
    console->is_over = true;
    pthread_cond_signal(&console->over);
    pthread_mutex_unlock(&console->mutex);
    if (!was_over)
        pthread_join(console->watcher, NULL);
}

/* Writes the last plain line, with the rays of all frames per second. */
static void report_rate(const HdConsole *console) {
    char line[128];
    HdProgress all = progress_of(console, hd_monotonic_seconds());
    const double seconds = seconds_rendering(&all);
    all.done = all.total;
    all.part = 0.0;
    hd_progress_line(&all, line);
    fprintf(stderr, "%s, %.2f M rays/s\n", line,
            seconds > 0.0 ? 1e-6 * (double)console->rays / seconds : 0.0);
}

void hd_console_end(HdConsole *console, const HdScene *scene, const HdDeviceTeam *team,
                    const char (*lines)[HD_RENDERER_LINE], HdStatus status) {
    end_watch(console);
    hd_interrupt_announce(NULL);
    hd_console_clear(console);
    report_fallbacks(console);
    if (status == HD_OK && team->count > 0 && console->form == HD_PROGRESS_LINES)
        report_rate(console);
    if (console->verbose)
        note_changes(team, lines);
    /* A picture may exceed the scene's limit. */
    if (status == HD_OK && !console->quiet && scene->max_error > 0.0 &&
        console->missing > scene->max_error)
        fprintf(stderr,
                "hedron: up to %.3g steps of 255 may be missing from a pixel, more than the %g of "
                "--max-error: rays end by --depth or --cutoff, or the scene has too many of them\n",
                console->missing, scene->max_error);
}
