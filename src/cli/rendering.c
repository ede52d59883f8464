/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "cli/rendering.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "choice/devices.h"
#include "cli/notes.h"
#include "cli/progress.h"
#include "cli/statistics.h"
#include "output/fingerprint.h"
#include "output/stale_files.h"
#include "system/interrupt.h"
#include "system/warnings.h"

enum { RENDERER_LINE = 512 };

typedef struct Run {
    const HdRendering *rendering;
    const HdOptions *options;
    HdResume resume;
    HdProgress progress;
    HdStatistics statistics; /* stream NULL: not wanted */
    HdDeviceTeam team;
    char (*renderer_lines)[RENDERER_LINE]; /* of each device */
    pthread_mutex_t telling;               /* one thread at a time; of the progress too */
    int rendered;                          /* frames so far */
    uint64_t rays;                         /* of all frames so far */
    double missing;                        /* steps of 255 at most, of the worst frame so far */
} Run;

/* Nobody else tells of anything now. */
static void tell_fallbacks(const Run *run) {
    char text[HD_FALLBACK_LENGTH];
    while (hd_fallback_take(text))
        if (!run->options->quiet)
            fprintf(stderr, "hedron: %s\n", text);
}

static void scene_uploaded(void *context, int number, const HdSceneTables *tables) {
    Run *run = context;
    HdRenderer *renderer = run->team.renderers[number];
    hd_renderer_describe(renderer, run->renderer_lines[number], RENDERER_LINE);
    pthread_mutex_lock(&run->telling);
    if (run->options->verbose) {
        hd_progress_end(&run->progress);
        hd_note_renderer(&run->team.devices[number], run->renderer_lines[number],
                         hd_renderer_kernels_note(renderer), tables);
    }
    tell_fallbacks(run);
    hd_progress_update(&run->progress, run->rendered);
    pthread_mutex_unlock(&run->telling);
}

static void device_dropped(void *context, int number, const HdError *error) {
    Run *run = context;
    pthread_mutex_lock(&run->telling);
    hd_progress_end(&run->progress);
    hd_note_dropped(&run->team.devices[number], error->message);
    pthread_mutex_unlock(&run->telling);
}

/* Programs are told of every frame, people of those that were rendered. */
static void tell_progress(Run *run, const HdStoredFrame *stored) {
    pthread_mutex_lock(&run->telling);
    hd_progress_tell_frame(&run->progress, stored->number, stored->done);
    run->rendered += !stored->was_finished;
    hd_progress_update(&run->progress, run->rendered);
    pthread_mutex_unlock(&run->telling);
}

static HdStatus frame_stored(void *context, const HdStoredFrame *stored, HdError *error) {
    Run *run = context;
    HdRunFacts facts = {
        .scene = &run->rendering->file->scene,
        .device = &run->team.devices[stored->tracer],
        .renderer = run->renderer_lines[stored->tracer],
    };
    HdStatus status = HD_OK;
    if (run->rendering->stored != NULL)
        status = run->rendering->stored(stored, error);
    if (status == HD_OK && run->statistics.stream != NULL)
        status = hd_statistics_add(&run->statistics, &facts, stored, error);
    if (status == HD_OK)
        tell_progress(run, stored);
    if (stored->was_finished)
        return status;
    run->rays += hd_frame_rays(stored->frame);
    if (stored->frame->has_bound && stored->frame->largest_bound > run->missing)
        run->missing = stored->frame->largest_bound;
    return status;
}

static void note_device(const HdDevice *device, const char *why, const HdRenderOptions *render,
                        const HdScene *scene) {
    HdLaunch launch;
    hd_note_device(device, why);
    if (hd_launch_recall(&launch, device, render, scene))
        hd_note_launch(&launch);
}

static HdStatus open_devices(Run *run, HdError *error) {
    const HdOptions *options = run->options;
    HdScene plain = run->rendering->file->scene; /* what it owns stays with the other */
    HdRenderOptions render = options->render;
    const HdJob job = {
        .scene = &plain,
        .first_frame = run->resume.missing.frames[0],
        .frame_count = run->resume.missing.count,
    };
    const HdDeviceWish wish = {
        .backend = options->backend,
        .device = options->device,
        .kind = run->rendering->device_kind,
        .options = &render,
        .job = &job,
    };
    HdDeviceReason reason;
    render.has_deep_trees = hd_scene_has_deep_trees(&plain);
    hd_scene_drop_survey(&plain);
    if (!options->verbose)
        hd_progress_prepare(&run->progress, "preparing the device");
    HdStatus status = hd_open_devices(&run->team, &wish, &reason, error);
    hd_progress_end(&run->progress);
    if (status == HD_INTERRUPTED)
        return hd_fail(error, status, "interrupted after %d of %d frames",
                       run->resume.first_missing, run->resume.all->count);
    if (status != HD_OK)
        return status;
    if (reason.note[0] != '\0' && !options->quiet)
        fprintf(stderr, "hedron: %s\n", reason.note);
    for (int i = 0; i < run->team.count && options->verbose; i++)
        note_device(&run->team.devices[i], reason.why, &render, &plain);
    return HD_OK;
}

/* Only where somebody may be waiting at a terminal. */
static void announce_interrupt(const Run *run) {
    if (run->options->quiet || !isatty(STDERR_FILENO))
        return;
    hd_interrupt_announce(run->progress.form == HD_PROGRESS_BAR
                              ? "\r\033[Khedron: stopping; press Ctrl-C again to stop now\n"
                              : "hedron: stopping; press Ctrl-C again to stop now\n");
}

static HdStatus prepare_to_tell(Run *run, HdError *error) {
    size_t count = run->team.count > 0 ? (size_t)run->team.count : 1;
    run->renderer_lines = calloc(count, sizeof *run->renderer_lines);
    if (run->renderer_lines == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room to tell of the devices");
    return HD_OK;
}

/* What a renderer says of itself may change with its first frame. */
static void note_changes(const Run *run) {
    for (int i = 0; i < run->team.count; i++) {
        char line[RENDERER_LINE];
        hd_renderer_describe(run->team.renderers[i], line, sizeof line);
        if (run->renderer_lines[i][0] != '\0' && strcmp(line, run->renderer_lines[i]) != 0)
            hd_note_renderer_line(line);
    }
}

static HdStatus render_all(Run *run, HdError *error) {
    const HdRendering *rendering = run->rendering;
    HdSequence sequence = {
        .scene = &rendering->file->scene,
        .resume = &run->resume,
        .precision = run->options->render.precision,
        .outputs = rendering->outputs,
        .renderers = run->team.renderers,
        .renderer_count = run->team.count,
        .uploaded = scene_uploaded,
        .dropped = device_dropped,
        .stored = frame_stored,
        .context = run,
    };
    if (run->team.count > 0 && run->team.devices[0].backend->functions->kernels != NULL &&
        !run->options->verbose)
        hd_progress_prepare(&run->progress, "building kernels");
    announce_interrupt(run);
    HdStatus status = hd_sequence_render(&sequence, error);
    hd_interrupt_announce(NULL);
    hd_progress_end(&run->progress);
    tell_fallbacks(run);
    if (status == HD_OK && run->team.count > 0)
        hd_progress_tell_end(&run->progress, run->rays);
    if (run->options->verbose)
        note_changes(run);
    if (status == HD_OK && !run->options->quiet)
        hd_note_missing(&rendering->file->scene, run->missing);
    return status;
}

static HdProgressForm progress_form(const Run *run) {
    if (run->options->tells_frames)
        return HD_PROGRESS_FRAMES;
    return run->options->quiet ? HD_PROGRESS_NONE
                               : hd_progress_form(run->rendering->tells_progress);
}

/* A device that cannot be used leaves the statistics of an earlier run alone. */
static HdStatus render_with_statistics(Run *run, HdError *error) {
    const HdProgressForm form = progress_form(run);
    HdError ignored;
    run->progress =
        hd_progress_start(form, form == HD_PROGRESS_FRAMES ? run->rendering->frames->count
                                                           : run->resume.missing.count);
    HdStatus status = run->resume.missing.count > 0 ? open_devices(run, error) : HD_OK;
    if (status == HD_OK && run->options->statistics != NULL)
        status = hd_statistics_open(&run->statistics, run->options->statistics, error);
    if (status == HD_OK)
        status = prepare_to_tell(run, error);
    if (status == HD_OK)
        status = render_all(run, error);
    if (run->statistics.stream != NULL) {
        HdStatus closed = hd_statistics_close(&run->statistics, status == HD_OK ? error : &ignored);
        status = status == HD_OK ? closed : status;
    }
    hd_close_devices(&run->team);
    free(run->renderer_lines);
    return status;
}

/* What fast arithmetic makes is not the same everywhere, and promises no bytes. */
static void mark_outputs(const HdRendering *rendering, const HdRenderOptions *render) {
    HdOutputPlan *outputs = rendering->outputs;
    if (render->math == HD_MATH_STRICT && outputs->has_png)
        hd_outputs_mark(
            outputs,
            hd_run_fingerprint(rendering->file, render->precision, &outputs->style.picture),
            rendering->resumes);
}

static void tell_finished(const Run *run) {
    if (run->resume.finished_count > 0 && !run->options->quiet)
        fprintf(stderr, "hedron: %d of %d frames were finished already\n",
                run->resume.finished_count, run->resume.all->count);
}

HdStatus hd_render(const HdRendering *rendering, const HdOptions *options, HdError *error) {
    Run run = {.rendering = rendering, .options = options, .telling = PTHREAD_MUTEX_INITIALIZER};
    const char *scene = options->operand_count > 0 ? options->operands[0] : NULL;
    HdStatus status = HD_OK;
    if (options->statistics != NULL)
        status = hd_statistics_check(options->statistics, scene, rendering->outputs,
                                     rendering->frames->frames[0], error);
    if (status != HD_OK)
        return status;
    if (options->verbose) {
        hd_note_scene(rendering->name, &rendering->file->scene);
        hd_note_outputs(rendering->outputs, rendering->frames->count);
    }
    hd_stale_files_remove(rendering->outputs, rendering->frames);
    mark_outputs(rendering, &options->render);
    status = hd_resume_find(&run.resume, rendering->outputs, rendering->frames, error);
    if (status != HD_OK)
        return status;
    tell_finished(&run);
    status = render_with_statistics(&run, error);
    hd_resume_free(&run.resume);
    return status;
}
