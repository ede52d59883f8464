/* SPDX-License-Identifier: MIT */
#include "cli/rendering.h"

#include <string.h>

#include "base/text.h"
#include "cli/console.h"
#include "cli/statistics.h"
#include "output/fingerprint.h"

typedef struct Run {
    const HdRendering *rendering;
    const HdOptions *options;
    HdResume resume;
    HdConsole console;
    HdStatistics statistics; /* stream NULL: not wanted */
    HdDeviceTeam team;
    HdWatch watch;
    char scene_name[HD_MAX_PATH], spelled[8192];   /* what pictures say */
    char lines[HD_MOST_TRACERS][HD_RENDERER_LINE]; /* of each renderer that got the scene */
} Run;

/* ---- while frames are rendered ---- */

static void scene_uploaded(void *context, int number, const HdSceneTables *tables) {
    Run *run = context;
    const HdRenderer *renderer = run->team.list[number].renderer;
    hd_renderer_describe(renderer, run->lines[number], HD_RENDERER_LINE);
    hd_console_tell_upload(&run->console, renderer, run->lines[number], tables);
}

static void device_dropped(void *context, int number, const HdError *error) {
    Run *run = context;
    hd_console_tell_loss(&run->console, &run->team.list[number].device, error->message);
}

static HdStatus add_statistics(Run *run, const HdStoredFrame *stored, HdError *error) {
    HdRunFacts facts = {.scene = &run->rendering->file->scene};
    if (!stored->was_finished) {
        facts.device = &run->team.list[stored->tracer].device;
        facts.renderer = run->lines[stored->tracer];
    }
    return hd_statistics_add(&run->statistics, &facts, stored, error);
}

static HdStatus frame_stored(void *context, const HdStoredFrame *stored, HdError *error) {
    Run *run = context;
    HdStatus status = HD_OK;
    hd_console_hold(&run->console); /* both may go to the same terminal */
    if (run->rendering->stored != NULL)
        status = run->rendering->stored(stored, error);
    if (status == HD_OK && run->statistics.stream != NULL)
        status = add_statistics(run, stored, error);
    hd_console_release(&run->console);
    if (status == HD_OK)
        hd_console_tell_frame(&run->console, stored);
    return status;
}

/* ---- from the devices to the last frame ---- */

static HdStatus open_devices(Run *run, HdError *error) {
    HdScene plain = run->rendering->file->scene; /* what it owns stays with the other */
    HdRenderOptions render = run->options->render;
    const HdJob job = {
        .scene = &plain,
        .first_frame = run->resume.missing.frames[0],
        .frame_count = run->resume.missing.count,
    };
    const HdDeviceWish wish = {
        .backend = run->options->backend,
        .device = run->options->device,
        .kind = run->rendering->device_kind,
        .options = &render,
        .job = &job,
    };
    render.has_deep_trees = hd_scene_has_deep_trees(&plain);
    render.first_hits = run->rendering->outputs->wish.layers != 0;
    hd_scene_drop_survey(&plain);
    HdStatus status = hd_open_devices(&run->team, &wish, error);
    hd_console_clear(&run->console);
    if (status == HD_INTERRUPTED)
        return hd_fail(error, status, "interrupted after %d of %d frames",
                       run->resume.first_missing, run->resume.all->count);
    if (status == HD_OK)
        hd_console_tell_devices(&run->console, &run->team);
    return status;
}

static HdStatus render_all(Run *run, HdError *error) {
    const HdRendering *rendering = run->rendering;
    const HdSequence sequence = {
        .scene = &rendering->file->scene,
        .resume = &run->resume,
        .precision = run->options->render.precision,
        .outputs = rendering->outputs,
        .team = &run->team,
        .uploaded = scene_uploaded,
        .dropped = device_dropped,
        .stored = frame_stored,
        .context = run,
        .watch = &run->watch,
    };
    if (run->team.count > 0 && run->team.list[0].device.backend->functions->kernels != NULL)
        hd_console_prepare(&run->console, "building kernels");
    hd_console_announce_interrupt(&run->console);
    hd_console_watch(&run->console, &run->watch);
    HdStatus status = hd_sequence_render(&sequence, error);
    hd_console_end(&run->console, sequence.scene, &run->team, run->lines, status);
    return status;
}

/* A device that cannot be used leaves the statistics of an earlier run alone. */
static HdStatus render_missing(Run *run, HdError *error) {
    HdError ignored;
    HdStatus status = run->resume.missing.count > 0 ? open_devices(run, error) : HD_OK;
    if (status == HD_OK && run->options->statistics != NULL)
        status = hd_statistics_open(&run->statistics, error);
    if (status == HD_OK)
        status = render_all(run, error);
    if (run->statistics.stream != NULL) {
        HdStatus closed = hd_statistics_close(&run->statistics, !run->options->no_sync,
                                              status == HD_OK ? error : &ignored);
        status = status == HD_OK ? closed : status;
    }
    hd_close_devices(&run->team);
    return status;
}

/* ---- what is to be rendered ---- */

/* Names of folders are nobody else's matter, and differ between machines. */
static void label_outputs(Run *run) {
    const char *name = run->rendering->name;
    const char *slash = strrchr(name, '/');
    hd_escape(slash != NULL ? slash + 1 : name, run->scene_name, sizeof run->scene_name);
    hd_options_spell(run->options, true, run->spelled, sizeof run->spelled);
    run->rendering->outputs->scene = run->scene_name;
    run->rendering->outputs->options = run->spelled;
    run->rendering->outputs->durability = run->options->no_sync ? HD_FLEETING : HD_DURABLE;
}

/* What fast arithmetic makes is not the same everywhere, and promises no bytes. */
static void mark_outputs(const HdRendering *rendering, const HdRenderOptions *render) {
    HdOutputPlan *outputs = rendering->outputs;
    if (render->math == HD_MATH_STRICT && (outputs->can_mark || outputs->film_count > 0))
        hd_outputs_mark(
            outputs,
            hd_run_fingerprint(rendering->file, render->precision, &outputs->style.picture),
            rendering->resumes);
}

HdStatus hd_render(const HdRendering *rendering, const HdOptions *options, HdError *error) {
    Run run = {.rendering = rendering, .options = options};
    const char *scene = options->operand_count > 0 ? options->operands[0] : NULL;
    HdStatus status = HD_OK;
    if (options->statistics != NULL)
        status = hd_statistics_settle(&run.statistics, options->statistics, scene,
                                      rendering->outputs, rendering->frames->frames[0], error);
    if (status != HD_OK)
        return status;
    hd_console_open(&run.console, options, rendering->tells_progress);
    hd_console_tell_run(&run.console, rendering->name, &rendering->file->scene, rendering->outputs,
                        rendering->frames->count);
    label_outputs(&run);
    mark_outputs(rendering, &options->render);
    status = hd_resume_find(&run.resume, rendering->outputs, rendering->frames, error);
    if (status == HD_OK) {
        hd_console_start(&run.console, &run.resume);
        status = render_missing(&run, error);
    }
    hd_resume_free(&run.resume);
    return status;
}
