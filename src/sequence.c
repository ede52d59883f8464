/* SPDX-License-Identifier: MIT */
#include "sequence.h"

#include "camera.h"
#include "clock.h"
#include "interrupt.h"

typedef struct Run {
    const HdSequence *sequence;
    HdRenderer *renderer;
    double start;
    HdOutputs *outputs;
    HdFrameStore *store;
} Run;

static HdStatus trace_frame(Run *run, int number, HdFrame *frame, HdFrameTimes *times,
                            HdError *error) {
    const HdSequence *sequence = run->sequence;
    HdCamera camera;
    HdFrameTables tables;
    double began = hd_monotonic_seconds();
    HdStatus status = hd_camera_at(&camera, sequence->scene, number, error);
    if (status == HD_OK)
        status = hd_compile_frame(&tables, sequence->scene, &camera, sequence->precision, error);
    if (status != HD_OK)
        return status;
    double prepared = hd_monotonic_seconds();
    status = hd_renderer_render(run->renderer, &tables, frame, error);
    double traced = hd_monotonic_seconds();
    hd_frame_tables_free(&tables);
    times->prepare = (HdSpan){began - run->start, prepared - began};
    times->trace = (HdSpan){prepared - run->start, frame->trace_seconds};
    /* A device has a clock of its own, which may not agree to the last digit. */
    double rest = traced - prepared - frame->trace_seconds;
    double copy = rest > 0.0 ? rest : 0.0;
    times->copy = (HdSpan){traced - copy - run->start, copy};
    return status;
}

/* Renders until a frame fails here or, which hd_frame_store_end tells, in the store. */
static HdStatus render_frames(Run *run, HdError *error) {
    const HdFrameList *frames = run->sequence->frames;
    HdStatus status = HD_OK;
    for (int i = 0; i < frames->count && status == HD_OK; i++) {
        HdFrameTimes *times;
        HdFrame *frame = hd_frame_store_next(run->store, &times);
        if (frame == NULL)
            break;
        status = trace_frame(run, frames->frames[i], frame, times, error);
        if ((status == HD_OK || status == HD_INTERRUPTED) && hd_interrupt_signal() != 0)
            status = HD_INTERRUPTED;
        if (status == HD_OK)
            hd_frame_store_give(run->store);
    }
    return status;
}

/* What fails in the store comes before what fails here: its frames are earlier ones. */
static HdStatus render_and_store(Run *run, HdError *error) {
    const HdSequence *sequence = run->sequence;
    const HdFrameStorePlan plan = {
        .outputs = run->outputs,
        .frames = sequence->frames,
        .width = sequence->scene->width,
        .height = sequence->scene->height,
        .start = run->start,
        .stored = sequence->stored,
        .context = sequence->context,
    };
    HdError store_error;
    int stored = 0;
    HdStatus status = hd_frame_store_start(&run->store, &plan, error);
    if (status != HD_OK)
        return status;
    status = render_frames(run, error);
    HdStatus store_status = hd_frame_store_end(run->store, &stored, &store_error);
    if (store_status != HD_OK) {
        status = store_status;
        *error = store_error;
    }
    if (status == HD_INTERRUPTED)
        return hd_fail(error, HD_INTERRUPTED, "interrupted after %d of %d frames", stored,
                       sequence->frames->count);
    return status;
}

static HdStatus prepare(Run *run, HdError *error) {
    const HdSequence *sequence = run->sequence;
    const HdScene *scene = sequence->scene;
    HdSceneTables tables;
    HdStatus status = hd_compile_scene(&tables, scene, sequence->precision, error);
    if (status != HD_OK)
        return status;
    status = hd_renderer_upload(run->renderer, &tables, error);
    if (status == HD_OK)
        sequence->uploaded(sequence->context, &tables);
    hd_scene_tables_free(&tables);
    if (status == HD_OK)
        status = hd_outputs_probe(sequence->outputs, sequence->frames->frames[0], error);
    if (status == HD_OK)
        status =
            hd_outputs_open(&run->outputs, sequence->outputs, scene->width, scene->height, error);
    return status;
}

HdStatus hd_sequence_render(const HdSequence *sequence, HdRenderer *renderer, HdError *error) {
    Run run = {.sequence = sequence, .renderer = renderer, .start = hd_monotonic_seconds()};
    HdStatus status = prepare(&run, error);
    if (status == HD_OK)
        status = render_and_store(&run, error);
    if (status == HD_OK)
        status = hd_outputs_close(run.outputs, error);
    else
        hd_outputs_abort(run.outputs);
    return status;
}
