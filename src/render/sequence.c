/* SPDX-License-Identifier: MIT */
#include "render/sequence.h"

#include "choice/trial.h"
#include "render/team.h"
#include "render/upload.h"
#include "system/atomic_file.h"
#include "system/machine.h"

typedef struct Run {
    const HdSequence *sequence;
    HdSceneUpload *upload;
    HdOutputs *outputs;
    HdTracerJob job;
} Run;

typedef struct Uploading {
    const HdSequence *sequence;
    int renderer;
} Uploading;

static void uploaded(void *context, const HdSceneTables *tables) {
    const Uploading *uploading = context;
    const HdSequence *sequence = uploading->sequence;
    sequence->uploaded(sequence->context, uploading->renderer, tables);
}

static HdStatus upload(Run *run, int renderer, HdError *error) {
    const HdSequence *sequence = run->sequence;
    Uploading uploading = {sequence, renderer};
    return hd_scene_upload(run->upload, sequence->renderers[renderer], uploaded, &uploading, error);
}

/* What has to be rendered. */
static const HdFrameList *missing_frames(const HdSequence *sequence) {
    return sequence->resume != NULL ? &sequence->resume->missing : sequence->frames;
}

/* ---- several renderers ---- */

static bool has_gpu(const HdSequence *sequence) {
    for (int i = 0; i < sequence->renderer_count; i++)
        if (!hd_renderer_device(sequence->renderers[i])->is_cpu)
            return true;
    return false;
}

/* Beside GPUs a CPU may be so slow that its first frame would keep them all waiting. */
static HdStatus prepare_member(void *context, int renderer, double *seconds, HdError *error) {
    Run *run = context;
    const HdSequence *sequence = run->sequence;
    HdRenderer *own = sequence->renderers[renderer];
    const HdJob job = {
        .scene = sequence->scene,
        .first_frame = missing_frames(sequence)->frames[0],
        .frame_count = missing_frames(sequence)->count,
    };
    HdStatus status = upload(run, renderer, error);
    if (status != HD_OK || hd_scene_is_surveyed(sequence->scene) || !has_gpu(sequence) ||
        !hd_renderer_device(own)->is_cpu)
        return status;
    return hd_trial_estimate_on(own, sequence->precision, &job, 0.0, seconds, error);
}

static void drop_member(void *context, int renderer, const HdError *error) {
    const Run *run = context;
    run->sequence->dropped(run->sequence->context, renderer, error);
}

static HdStatus trace_together(Run *run, HdError *error) {
    const HdTracerTeam team = {
        .job = &run->job,
        .renderers = run->sequence->renderers,
        .count = run->sequence->renderer_count,
        .prepare = prepare_member,
        .dropped = drop_member,
        .context = run,
    };
    return hd_tracer_team_run(&team, error);
}

/* ---- the sequence ---- */

static HdStatus trace_alone(Run *run, HdError *error) {
    HdTracer tracer;
    HdStatus status = hd_tracer_open(&tracer, &run->job, run->sequence->renderers[0], 0, error);
    if (status != HD_OK)
        return status;
    status = hd_tracer_run(&tracer, NULL, error);
    hd_tracer_close(&tracer);
    return status;
}

/* What fails in the store comes before what fails here: its frames are earlier ones. */
static HdStatus trace_and_store(Run *run, HdError *error) {
    const HdSequence *sequence = run->sequence;
    const HdFrameStorePlan plan = {
        .outputs = run->outputs,
        .frames = sequence->frames,
        .resume = sequence->resume,
        .width = sequence->scene->width,
        .height = sequence->scene->height,
        .tracers = sequence->renderer_count > 0 ? sequence->renderer_count : 1,
        .start = run->job.start,
        .stored = sequence->stored,
        .context = sequence->context,
    };
    HdError store_error;
    int stored = 0;
    HdStatus status = hd_frame_store_start(&run->job.store, &plan, error);
    if (status != HD_OK)
        return status;
    if (sequence->renderer_count == 1)
        status = trace_alone(run, error);
    else if (sequence->renderer_count > 1)
        status = trace_together(run, error);
    HdStatus store_status = hd_frame_store_end(run->job.store, &stored, &store_error);
    if (store_status != HD_OK) {
        status = store_status;
        *error = store_error;
    }
    if (status == HD_INTERRUPTED)
        return hd_fail(error, HD_INTERRUPTED, "interrupted after %d of %d frames", stored,
                       sequence->frames->count);
    return status;
}

/* One renderer gets its scene before there are outputs; several get theirs while frames are traced.
 */
static HdStatus prepare_devices(Run *run, HdError *error) {
    const HdSequence *sequence = run->sequence;
    const HdScene *scene = sequence->scene;
    HdStatus status = hd_scene_upload_create(&run->upload, scene, sequence->precision,
                                             sequence->renderer_count, error);
    if (status == HD_OK && sequence->renderer_count == 1)
        status = upload(run, 0, error);
    if (status == HD_OK)
        status = hd_outputs_probe(sequence->outputs, missing_frames(sequence)->frames[0], error);
    return status;
}

static HdStatus prepare(Run *run, HdError *error) {
    const HdSequence *sequence = run->sequence;
    HdStatus status = sequence->renderer_count > 0 ? prepare_devices(run, error) : HD_OK;
    if (status == HD_OK)
        status = hd_outputs_open(&run->outputs, sequence->outputs, sequence->scene->width,
                                 sequence->scene->height, error);
    return status;
}

HdStatus hd_sequence_render(const HdSequence *sequence, HdError *error) {
    Run run = {
        .sequence = sequence,
        .job = {.scene = sequence->scene,
                .frames = sequence->frames,
                .precision = sequence->precision,
                .wish = hd_outputs_wish(sequence->outputs),
                .start = hd_monotonic_seconds()},
    };
    hd_known_folders_forget(); /* what was there before another sequence may rightly be gone */
    HdStatus status = prepare(&run, error);
    if (status == HD_OK)
        status = trace_and_store(&run, error);
    if (status == HD_OK)
        status = hd_outputs_close(run.outputs, error);
    else
        hd_outputs_abort(run.outputs);
    hd_scene_upload_free(run.upload);
    return status;
}
