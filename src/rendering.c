/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "rendering.h"

#include <stdio.h>
#include <unistd.h>

#include "fallbacks.h"
#include "interrupt.h"
#include "progress.h"
#include "rendering_notes.h"
#include "statistics.h"

typedef struct Run {
    const HdRendering *rendering;
    const HdOptions *options;
    HdProgress progress;
    HdStatistics statistics; /* stream NULL: not wanted */
    HdDevice device;
    HdRenderer *renderer;
    char renderer_line[512];
    uint64_t rays;  /* of all frames so far */
    double missing; /* steps of 255 at most, of the worst frame so far */
} Run;

static void tell_fallbacks(const Run *run) {
    char text[HD_FALLBACK_LENGTH];
    while (hd_fallback_take(text))
        if (!run->options->quiet)
            fprintf(stderr, "hedron: %s\n", text);
}

static void scene_uploaded(void *context, const HdSceneTables *tables) {
    Run *run = context;
    hd_renderer_describe(run->renderer, run->renderer_line, sizeof run->renderer_line);
    if (run->options->verbose)
        hd_note_renderer(&run->device, run->renderer_line, hd_renderer_kernels_note(run->renderer),
                         tables);
    tell_fallbacks(run);
    hd_progress_update(&run->progress, 0);
}

static HdStatus frame_stored(void *context, const HdStoredFrame *stored, HdError *error) {
    Run *run = context;
    HdRunFacts facts = {
        .scene = run->rendering->scene,
        .device = &run->device,
        .renderer = run->renderer_line,
    };
    HdStatus status = HD_OK;
    if (run->rendering->stored != NULL)
        status = run->rendering->stored(stored, error);
    if (status == HD_OK && run->statistics.stream != NULL)
        status = hd_statistics_add(&run->statistics, &facts, stored, error);
    run->rays += hd_frame_rays(stored->frame);
    if (stored->frame->has_bound && stored->frame->largest_bound > run->missing)
        run->missing = stored->frame->largest_bound;
    if (status == HD_OK)
        hd_progress_update(&run->progress, stored->done);
    return status;
}

static void note_device(const Run *run, const char *why) {
    HdLaunch launch;
    hd_note_device(&run->device, why);
    if (hd_launch_recall(&launch, &run->device, &run->options->render, run->rendering->scene))
        hd_note_launch(&launch);
}

static HdStatus open_device(Run *run, HdError *error) {
    const HdOptions *options = run->options;
    HdDeviceReason reason;
    HdDeviceWish wish = {
        .backend = options->backend,
        .device = options->device,
        .kind = run->rendering->device_kind,
    };
    HdScene plain = *run->rendering->scene; /* what it owns stays with the other */
    HdJob job = {
        .scene = &plain,
        .first_frame = run->rendering->frames->frames[0],
        .frame_count = run->rendering->frames->count,
    };
    hd_scene_drop_survey(&plain);
    if (!options->verbose)
        hd_progress_prepare(&run->progress, "preparing the device");
    HdStatus status =
        hd_open_device(&run->renderer, &run->device, &wish, &options->render, &job, &reason, error);
    hd_progress_end(&run->progress);
    if (status == HD_INTERRUPTED)
        return hd_fail(error, status, "interrupted after 0 of %d frames", job.frame_count);
    if (status != HD_OK)
        return status;
    if (reason.note[0] != '\0' && !options->quiet)
        fprintf(stderr, "hedron: %s\n", reason.note);
    if (options->verbose)
        note_device(run, reason.why);
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

static HdStatus render_all(Run *run, HdError *error) {
    const HdRendering *rendering = run->rendering;
    HdSequence sequence = {
        .scene = rendering->scene,
        .frames = rendering->frames,
        .precision = run->options->render.precision,
        .outputs = &rendering->outputs,
        .uploaded = scene_uploaded,
        .stored = frame_stored,
        .context = run,
    };
    if (run->device.backend != &hd_backend_c && !run->options->verbose)
        hd_progress_prepare(&run->progress, "building kernels");
    announce_interrupt(run);
    HdStatus status = hd_sequence_render(&sequence, run->renderer, error);
    hd_interrupt_announce(NULL);
    hd_progress_end(&run->progress);
    tell_fallbacks(run);
    if (status == HD_OK)
        hd_progress_tell_end(&run->progress, run->rays);
    if (status == HD_OK && !run->options->quiet)
        hd_note_missing(rendering->scene, run->missing);
    return status;
}

/* A device that cannot be used leaves the statistics of an earlier run alone. */
static HdStatus render_with_statistics(Run *run, HdError *error) {
    const HdRendering *rendering = run->rendering;
    HdError ignored;
    run->progress = hd_progress_start(
        run->options->quiet ? HD_PROGRESS_NONE : hd_progress_form(rendering->tells_progress),
        rendering->frames->count);
    HdStatus status = open_device(run, error);
    if (status == HD_OK && run->options->statistics != NULL)
        status = hd_statistics_open(&run->statistics, run->options->statistics, error);
    if (status == HD_OK)
        status = render_all(run, error);
    if (run->statistics.stream != NULL) {
        HdStatus closed = hd_statistics_close(&run->statistics, status == HD_OK ? error : &ignored);
        status = status == HD_OK ? closed : status;
    }
    hd_renderer_close(run->renderer);
    return status;
}

HdStatus hd_render(const HdRendering *rendering, const HdOptions *options, HdError *error) {
    Run run = {.rendering = rendering, .options = options};
    const char *scene = options->operand_count > 0 ? options->operands[0] : NULL;
    HdStatus status = hd_outputs_check(&rendering->outputs, rendering->frames->count, error);
    if (status == HD_OK && options->statistics != NULL)
        status = hd_statistics_check(options->statistics, scene, &rendering->outputs,
                                     rendering->frames->frames[0], error);
    if (status != HD_OK)
        return status;
    if (options->verbose) {
        hd_note_scene(rendering->name, rendering->scene);
        hd_note_outputs(&rendering->outputs, rendering->frames->count);
    }
    return render_with_statistics(&run, error);
}
