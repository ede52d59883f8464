/* SPDX-License-Identifier: MIT */
#include "sequence.h"

#include "camera.h"
#include "clock.h"
#include "interrupt.h"

typedef struct Run {
    const HdSequence *sequence;
    HdRenderer *renderer;
    HdFrame frame;
    HdOutputs *outputs;
} Run;

static HdStatus trace_frame(Run *run, int number, HdFrameTimes *times, HdError *error) {
    const HdSequence *sequence = run->sequence;
    HdCamera camera;
    HdFrameTables tables;
    double start = hd_monotonic_seconds();
    HdStatus status = hd_camera_at(&camera, sequence->scene, number, error);
    if (status == HD_OK)
        status = hd_compile_frame(&tables, sequence->scene, &camera, sequence->precision, error);
    if (status != HD_OK)
        return status;
    double prepared = hd_monotonic_seconds();
    status = hd_renderer_render(run->renderer, &tables, &run->frame, error);
    double traced = hd_monotonic_seconds();
    hd_frame_tables_free(&tables);
    times->prepare = prepared - start;
    times->trace = run->frame.trace_seconds;
    /* A device has a clock of its own, which may not agree to the last digit. */
    times->copy = traced - prepared > times->trace ? traced - prepared - times->trace : 0.0;
    return status;
}

static HdStatus store_frame(Run *run, int number, HdFrameTimes *times, HdError *error) {
    double start = hd_monotonic_seconds();
    HdStatus status = hd_outputs_store(run->outputs, &run->frame, number, &times->convert, error);
    times->store = hd_monotonic_seconds() - start - times->convert;
    return status;
}

static HdStatus render_frame(Run *run, int index, HdError *error) {
    const HdSequence *sequence = run->sequence;
    HdStoredFrame stored = {
        .number = sequence->frames->frames[index],
        .done = index + 1,
        .frame = &run->frame,
    };
    HdStatus status = trace_frame(run, stored.number, &stored.times, error);
    if ((status == HD_OK || status == HD_INTERRUPTED) && hd_interrupt_signal() != 0)
        status = hd_fail(error, HD_INTERRUPTED, "interrupted after %d of %d frames", index,
                         sequence->frames->count);
    if (status == HD_OK)
        status = store_frame(run, stored.number, &stored.times, error);
    if (status == HD_OK)
        status = sequence->stored(sequence->context, &stored, error);
    return status;
}

static HdStatus prepare(Run *run, HdError *error) {
    const HdSequence *sequence = run->sequence;
    const HdScene *scene = sequence->scene;
    HdSceneTables tables;
    HdStatus status = hd_frame_create(&run->frame, scene->width, scene->height, error);
    if (status == HD_OK)
        status = hd_compile_scene(&tables, scene, sequence->precision, error);
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
    Run run = {.sequence = sequence, .renderer = renderer};
    HdStatus status = prepare(&run, error);
    for (int i = 0; i < sequence->frames->count && status == HD_OK; i++)
        status = render_frame(&run, i, error);
    if (status == HD_OK)
        status = hd_outputs_close(run.outputs, error);
    else
        hd_outputs_abort(run.outputs);
    hd_frame_free(&run.frame);
    return status;
}
