/* SPDX-License-Identifier: MIT */
#include "sequence.h"

#include "camera.h"
#include "clock.h"
#include "interrupt.h"
#include "refinement.h"

/* A frame that the renderer works on. */
typedef struct Flight {
    HdFrameTables tables;
    HdSpan prepare;
} Flight;

typedef struct Run {
    const HdSequence *sequence;
    HdRenderer *renderer;
    HdRefinement *refinement; /* NULL: the scene is not surveyed */
    double start;
    HdFrameWish wish;
    HdOutputs *outputs;
    HdFrameStore *store;
    int submitted, collected; /* frames of the list */
    Flight
        flights[HD_FRAMES_IN_FLIGHT]; /* a frame's is its place in the list modulo their number */
    double traced;                    /* when the last frame's tracing was over */
} Run;

static double seconds_since_start(const Run *run) {
    return hd_monotonic_seconds() - run->start;
}

static Flight *flight_of(Run *run, int place) {
    return &run->flights[place % HD_FRAMES_IN_FLIGHT];
}

static HdStatus submit_next(Run *run, HdError *error) {
    const HdSequence *sequence = run->sequence;
    Flight *flight = flight_of(run, run->submitted);
    HdCamera camera;
    double began = seconds_since_start(run);
    HdStatus status =
        hd_camera_at(&camera, sequence->scene, sequence->frames->frames[run->submitted], error);
    if (status == HD_OK)
        status =
            hd_compile_frame(&flight->tables, sequence->scene, &camera, sequence->precision, error);
    if (status != HD_OK)
        return status;
    flight->prepare = (HdSpan){began, seconds_since_start(run) - began};
    status = hd_renderer_submit(run->renderer, &flight->tables, &run->wish, error);
    if (status == HD_OK)
        run->submitted++;
    else
        hd_frame_tables_free(&flight->tables);
    return status;
}

/* Frames are traced one after the other. One that was waited for as long as its tracing took was
   traced then; another one as soon as the device could. What a device says by its own clock may not
   agree with ours to the last digit. */
static void note_times(Run *run, const Flight *flight, double waited_from, double trace_seconds,
                       HdFrameTimes *times) {
    double now = seconds_since_start(run);
    double prepared = flight->prepare.began + flight->prepare.seconds;
    double began = prepared > run->traced ? prepared : run->traced;
    if (now - waited_from >= trace_seconds)
        began = waited_from;
    run->traced = began + trace_seconds < now ? began + trace_seconds : now;
    double rest_from = run->traced > waited_from ? run->traced : waited_from;
    times->prepare = flight->prepare;
    times->trace = (HdSpan){began, trace_seconds};
    times->copy = (HdSpan){rest_from, now - rest_from};
}

static HdStatus collect_oldest(Run *run, HdError *error) {
    Flight *flight = flight_of(run, run->collected);
    HdFrameTimes *times;
    HdFrame *frame = hd_frame_store_next(run->store, &times);
    if (frame == NULL)
        return HD_FAILED; /* hd_frame_store_end tells why */
    double waited_from = seconds_since_start(run);
    HdStatus status = hd_renderer_collect(run->renderer, frame, error);
    run->collected++;
    hd_frame_tables_free(&flight->tables);
    if ((status == HD_OK || status == HD_INTERRUPTED) && hd_interrupt_signal() != 0)
        return HD_INTERRUPTED;
    if (status != HD_OK)
        return status;
    note_times(run, flight, waited_from, frame->trace_seconds, times);
    times->longest_launch = hd_renderer_take_longest_launch(run->renderer);
    hd_frame_store_give(run->store);
    return HD_OK;
}

/* A surveyed frame is made of several, which are waited for one after the other. */
static HdStatus refine_next(Run *run, HdError *error) {
    const HdSequence *sequence = run->sequence;
    HdFrameTimes *times;
    HdFrame *frame = hd_frame_store_next(run->store, &times);
    if (frame == NULL)
        return HD_FAILED; /* hd_frame_store_end tells why */
    double began = seconds_since_start(run);
    HdCamera camera;
    HdStatus status =
        hd_camera_at(&camera, sequence->scene, sequence->frames->frames[run->collected], error);
    double prepared = seconds_since_start(run);
    if (status == HD_OK)
        status = hd_refinement_render(run->refinement, &camera, frame, error);
    if ((status == HD_OK || status == HD_INTERRUPTED) && hd_interrupt_signal() != 0)
        return HD_INTERRUPTED;
    if (status != HD_OK)
        return status;
    run->collected++;
    *times = (HdFrameTimes){.prepare = {began, prepared - began},
                            .trace = {prepared, frame->trace_seconds},
                            .copy = {-1.0, 0.0},
                            .longest_launch = hd_renderer_take_longest_launch(run->renderer)};
    hd_frame_store_give(run->store);
    return HD_OK;
}

static HdStatus refine_frames(Run *run, HdError *error) {
    HdStatus status = HD_OK;
    while (status == HD_OK && run->collected < run->sequence->frames->count)
        status = refine_next(run, error);
    return status;
}

static void drop_rest(Run *run) {
    hd_renderer_drop(run->renderer);
    for (; run->collected < run->submitted; run->collected++)
        hd_frame_tables_free(&flight_of(run, run->collected)->tables);
}

/* Renders until a frame fails here or in the store. A frame that cannot be submitted fails after
   those that were. */
static HdStatus render_frames(Run *run, HdError *error) {
    const int count = run->sequence->frames->count;
    HdStatus status = HD_OK, submitting = HD_OK;
    while (status == HD_OK && run->collected < count) {
        int in_flight = run->submitted - run->collected;
        if (submitting == HD_OK && run->submitted < count && in_flight < HD_FRAMES_IN_FLIGHT)
            submitting = submit_next(run, error);
        else
            status = in_flight > 0 ? collect_oldest(run, error) : submitting;
    }
    drop_rest(run);
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
    status = run->refinement != NULL ? refine_frames(run, error) : render_frames(run, error);
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
    HdStatus status = hd_compile_scene(&tables, scene, sequence->precision,
                                       hd_renderer_lanes(run->renderer), error);
    if (status != HD_OK)
        return status;
    status = hd_renderer_upload(run->renderer, &tables, error);
    if (status == HD_OK)
        sequence->uploaded(sequence->context, &tables);
    hd_scene_tables_free(&tables);
    if (status == HD_OK && hd_scene_is_surveyed(scene))
        status = hd_refinement_create(&run->refinement, scene, run->renderer, sequence->precision,
                                      run->wish.curve, error);
    if (status == HD_OK)
        status = hd_outputs_probe(sequence->outputs, sequence->frames->frames[0], error);
    if (status == HD_OK)
        status =
            hd_outputs_open(&run->outputs, sequence->outputs, scene->width, scene->height, error);
    return status;
}

HdStatus hd_sequence_render(const HdSequence *sequence, HdRenderer *renderer, HdError *error) {
    Run run = {
        .sequence = sequence,
        .renderer = renderer,
        .start = hd_monotonic_seconds(),
        .wish = hd_outputs_wish(sequence->outputs),
    };
    HdStatus status = prepare(&run, error);
    if (status == HD_OK)
        status = render_and_store(&run, error);
    if (status == HD_OK)
        status = hd_outputs_close(run.outputs, error);
    else
        hd_outputs_abort(run.outputs);
    hd_refinement_free(run.refinement);
    return status;
}
