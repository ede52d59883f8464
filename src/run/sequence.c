/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "run/sequence.h"

#include <math.h>
#include <pthread.h>
#include <string.h>

#include "render/frame.h"
#include "run/turns.h"
#include "scene/camera.h"
#include "system/atomic_file.h"
#include "system/interrupt.h"
#include "system/machine.h"
#include "system/thread_pool.h"
#include "verify/trust.h"

/* One for each count of lanes. */
#define COUNTED(lanes) +1
enum { MOST_TABLES = 0 HD_LANE_COUNTS(COUNTED) };

typedef struct Run Run;

/* A device of the team that traces the frames; it may be the only one. */
typedef struct Member {
    Run *run;
    int number;
    bool has_thread;
    pthread_t thread;
} Member;

struct Run {
    const HdSequence *sequence;
    HdTurns turns; /* its mutex is taken after the store's, never before it */
    double start;  /* by hd_monotonic_seconds */
    HdFrameStore *store;
    HdStages *stages; /* of the store */
    Member members[HD_MOST_TRACERS];
    pthread_mutex_t mutex; /* of what follows */
    HdSceneTables tables[MOST_TABLES];
    int table_count;
    int waiting; /* renderers that have not got the scene */
    int alive;
    HdStatus status;
    HdError error;
};

/* ---- the scene on a device ---- */

static HdRenderer *renderer_of(const Run *run, int number) {
    return run->sequence->team->list[number].renderer;
}

/* The scene is compiled once for all renderers of the same lanes. */
static HdStatus find_tables(Run *run, const HdRenderer *renderer, const HdSceneTables **found,
                            HdError *error) {
    const int lanes = hd_renderer_lanes(renderer);
    for (int i = 0; i < run->table_count; i++)
        if (run->tables[i].lanes == lanes) {
            *found = &run->tables[i];
            return HD_OK;
        }
    HdSceneTables *tables = &run->tables[run->table_count];
    HD_TRY(hd_compile_scene(tables, run->sequence->scene, hd_renderer_options(renderer)->precision,
                            lanes, error));
    run->table_count++;
    *found = tables;
    return HD_OK;
}

static void free_tables(Run *run) {
    for (; run->table_count > 0; run->table_count--)
        hd_scene_tables_free(&run->tables[run->table_count - 1]);
}

/* The tables are freed after the last renderer. */
static HdStatus upload(Run *run, int number, HdError *error) {
    const HdSequence *sequence = run->sequence;
    HdRenderer *renderer = renderer_of(run, number);
    const HdSceneTables *tables;
    pthread_mutex_lock(&run->mutex);
    HdStatus status = find_tables(run, renderer, &tables, error);
    pthread_mutex_unlock(&run->mutex);
    if (status == HD_OK)
        status = hd_put_tables(renderer, tables, error);
    pthread_mutex_lock(&run->mutex);
    if (status == HD_OK)
        sequence->uploaded(sequence->context, number, tables);
    if (--run->waiting == 0)
        free_tables(run);
    pthread_mutex_unlock(&run->mutex);
    return status;
}

/* Beside GPUs a CPU may be so slow that its first frame would keep them all waiting. */
static HdStatus estimate_pace(Run *run, int number, HdError *error) {
    const HdSequence *sequence = run->sequence;
    const HdFrameList *missing = &sequence->resume->missing;
    const HdJob job = {
        .scene = sequence->scene,
        .first_frame = missing->frames[0],
        .frame_count = missing->count,
    };
    const HdTrialWish wish = hd_trial_estimates(0.0);
    HdTrial trial;
    bool has_gpu = false;
    for (int i = 0; i < run->turns.count; i++)
        has_gpu = has_gpu || !run->turns.list[i].is_cpu;
    if (!run->turns.list[number].is_cpu || !has_gpu || hd_scene_is_surveyed(sequence->scene))
        return HD_OK;
    HD_TRY(hd_trial(renderer_of(run, number), &job, &wish, &trial, error));
    hd_turns_estimate(&run->turns, number, trial.frame_seconds);
    hd_stages_ask_again(run->stages);
    return HD_OK;
}

/* Several devices get the scene while frames are traced; one alone has it already. */
static HdStatus prepare(Run *run, int number, HdError *error) {
    if (run->sequence->team->count > 1)
        HD_TRY(upload(run, number, error));
    return estimate_pace(run, number, error);
}

/* ---- a device traces frames ---- */

/* A frame that the renderer works on. */
typedef struct Flight {
    int place; /* in the list */
    HdFlight frame;
    HdSpan prepare; /* since the start of the run */
} Flight;

typedef struct Tracer {
    Run *run;
    int number;
    HdFrameMaker maker;
    int begun, ended; /* frames so far */
    Flight flights[HD_FRAMES_IN_FLIGHT];
    double traced;   /* when the last frame's tracing was over */
    double finished; /* when the last frame was */
} Tracer;

static double seconds_since_start(const Tracer *tracer) {
    return hd_monotonic_seconds() - tracer->run->start;
}

static Flight *flight_of(Tracer *tracer, int count) {
    return &tracer->flights[count % HD_FRAMES_IN_FLIGHT];
}

static int in_flight(const Tracer *tracer) {
    return tracer->begun - tracer->ended;
}

/* Frames are traced one after the other. One that was waited for as long as its tracing took was
   traced then; another one as soon as the device could. What a device says by its own clock may not
   agree with ours to the last digit. */
static void note_times(Tracer *tracer, const Flight *flight, double waited_from,
                       double trace_seconds, HdFrameTimes *times) {
    double now = seconds_since_start(tracer);
    double prepared = flight->prepare.began + flight->prepare.seconds;
    double began = fmax(prepared, tracer->traced);
    if (now - waited_from >= trace_seconds)
        began = waited_from;
    tracer->traced = fmin(began + trace_seconds, now);
    double rest_from = fmax(tracer->traced, waited_from);
    times->prepare = flight->prepare;
    times->trace = (HdSpan){began, trace_seconds};
    times->copy = (HdSpan){rest_from, now - rest_from};
}

/* Fills the oldest frame under way, which it stays. */
static HdStatus fill_oldest(Tracer *tracer, HdError *error) {
    Flight *flight = flight_of(tracer, tracer->ended);
    HdFrameTimes *times;
    HdFrame *frame =
        hd_frame_store_frame(tracer->run->store, flight->place, tracer->number, &times);
    double waited_from = seconds_since_start(tracer);
    HD_TRY(hd_frame_end(&tracer->maker, &flight->frame, frame, error));
    note_times(tracer, flight, waited_from, frame->trace_seconds, times);
    times->longest_launch = hd_renderer_take_longest_launch(tracer->maker.renderer);
    if (hd_interrupt_signal() != 0)
        return hd_fail(error, HD_INTERRUPTED, "interrupted between two frames");
    return HD_OK;
}

static void give_oldest(Tracer *tracer) {
    const Flight *flight = flight_of(tracer, tracer->ended++);
    double now = seconds_since_start(tracer);
    double taken = now - fmax(flight->prepare.began, tracer->finished);
    tracer->finished = now;
    hd_turns_ended(&tracer->run->turns, tracer->number, taken, hd_monotonic_seconds());
    hd_stages_give(tracer->run->stages, flight->place);
}

static void give_all_back(Tracer *tracer) {
    hd_renderer_drop(tracer->maker.renderer);
    for (; tracer->ended < tracer->begun; tracer->ended++) {
        Flight *flight = flight_of(tracer, tracer->ended);
        hd_frame_tables_free(&flight->frame.tables);
        hd_turns_ended(&tracer->run->turns, tracer->number, 0.0, hd_monotonic_seconds());
        hd_stages_give_back(tracer->run->stages, flight->place);
    }
}

/* Whether the store is told of what failed, for no device would do better. */
static bool is_told(Tracer *tracer, int place, HdStatus status, const HdError *error) {
    if (status == HD_INTERRUPTED || hd_renderer_has_failed(tracer->maker.renderer))
        return false;
    hd_stages_fail(tracer->run->stages, place, error);
    return true;
}

/* Once the store wants the oldest frame no more, another tracer may still fail at an earlier one,
   which is then to be taken. */
static HdStatus finish_oldest(Tracer *tracer, HdError *error) {
    int place = flight_of(tracer, tracer->ended)->place;
    if (hd_stages_wait(tracer->run->stages, place)) {
        HdStatus status = fill_oldest(tracer, error);
        if (status == HD_OK) {
            give_oldest(tracer);
            return HD_OK;
        }
        if (!is_told(tracer, place, status, error))
            return status;
    }
    give_all_back(tracer);
    return HD_OK;
}

static bool wants(void *context, int left) {
    const Tracer *tracer = context;
    return hd_turns_want(&tracer->run->turns, tracer->number, left, hd_monotonic_seconds());
}

/* Negative: none now. A tracer alone begins frames before there is room for them. One of several
   may be given an earlier frame than those it has begun, which others wait for: it begins what it
   can finish. */
static int take_frame(Tracer *tracer) {
    const HdTaker taker = {
        .wants = wants,
        .context = tracer,
        .ahead = tracer->run->turns.count == 1 ? HD_FRAMES_IN_FLIGHT : 0,
    };
    if (in_flight(tracer) >= hd_frame_most_flights(&tracer->maker))
        return -1;
    return hd_stages_take(tracer->run->stages, &taker, in_flight(tracer) == 0);
}

/* On failure the frame is not begun; the earlier ones are still under way. */
static HdStatus begin(Tracer *tracer, int place, HdError *error) {
    const HdSequence *sequence = tracer->run->sequence;
    Flight *flight = flight_of(tracer, tracer->begun);
    double now = seconds_since_start(tracer);
    HdCamera camera;
    *flight = (Flight){.place = place, .prepare = {.began = now}};
    HdStatus status =
        hd_camera_at(&camera, sequence->scene, sequence->resume->all->frames[place], error);
    if (status == HD_OK)
        status = hd_frame_prepare(&tracer->maker, &camera, &flight->frame, error);
    flight->prepare.seconds = seconds_since_start(tracer) - now;
    if (status == HD_OK)
        status = hd_frame_begin(&tracer->maker, &flight->frame, error);
    if (status == HD_OK) {
        tracer->begun++;
        hd_turns_begun(&tracer->run->turns, tracer->number, hd_monotonic_seconds());
        return HD_OK;
    }
    if (is_told(tracer, place, status, error))
        return HD_OK;
    hd_stages_give_back(tracer->run->stages, place);
    return status;
}

/* Where the device takes no more, it may still finish what it has. */
static HdStatus trace(Tracer *tracer, HdError *error) {
    HdStatus status = HD_OK, beginning = HD_OK;
    HdError of_beginning;
    while (status == HD_OK) {
        int place = beginning == HD_OK ? take_frame(tracer) : -1;
        if (place >= 0)
            beginning = begin(tracer, place, &of_beginning);
        else if (in_flight(tracer) > 0)
            status = finish_oldest(tracer, error);
        else
            break;
    }
    give_all_back(tracer);
    if (status != HD_OK || beginning == HD_OK)
        return status;
    *error = of_beginning;
    return beginning;
}

/* Traces frames until the store has none left. What a frame itself is to blame for, the store is
   told. Fails where the device fails (hd_renderer_has_failed), which is its fault, as is all that
   fails before the first frame, and with HD_INTERRUPTED after a signal: what was under way is then
   given back to the store. */
static HdStatus trace_frames(const Member *member, bool *is_fault_of_device, HdError *error) {
    const HdSequence *sequence = member->run->sequence;
    HdRenderer *renderer = renderer_of(member->run, member->number);
    Tracer tracer = {.run = member->run,
                     .number = member->number,
                     .maker = {.renderer = renderer,
                               .scene = sequence->scene,
                               .wish = sequence->outputs->wish,
                               .watch = sequence->watch}};
    HD_TRY(hd_frame_maker_open(&tracer.maker, error));
    HdStatus status = trace(&tracer, error);
    *is_fault_of_device = hd_renderer_has_failed(renderer);
    hd_frame_maker_close(&tracer.maker);
    return status;
}

/* ---- the end of a device ---- */

static void drop_device(Run *run, int number, HdStatus status, const HdError *error) {
    hd_turns_leave(&run->turns, number);
    if (--run->alive > 0)
        run->sequence->dropped(run->sequence->context, number, error);
    else if (run->status == HD_OK)
        run->status = hd_fail(&run->error, status, "no device is left, for the last one failed: %s",
                              error->message);
}

/* The words of one alone are the run's. */
static void leave(const Member *member, HdStatus status, const HdError *error,
                  bool is_fault_of_device) {
    Run *run = member->run;
    pthread_mutex_lock(&run->mutex);
    if (status != HD_OK && is_fault_of_device && run->sequence->team->count > 1) {
        drop_device(run, member->number, status, error);
    } else if (status != HD_OK && run->status == HD_OK) {
        run->status = status;
        run->error = *error;
    }
    bool is_over = run->status != HD_OK;
    pthread_mutex_unlock(&run->mutex);
    if (is_over)
        hd_stages_stop(run->stages);
    else
        hd_stages_ask_again(run->stages);
}

/* ---- threads ---- */

static void *work(void *argument) {
    const Member *member = argument;
    Run *run = member->run;
    HdError error;
    bool is_fault_of_device = true;
    HdStatus status = prepare(run, member->number, &error);
    if (status == HD_OK)
        status = trace_frames(member, &is_fault_of_device, &error);
    leave(member, status, &error, is_fault_of_device && status != HD_INTERRUPTED);
    return NULL;
}

static void start_member(Member *member) {
    HdError error;
    int reason = hd_start_thread(&member->thread, work, member);
    member->has_thread = reason == 0;
    if (reason == 0)
        return;
    HdStatus status =
        hd_fail(&error, HD_FAILED, "cannot start a thread for the device: %s", strerror(reason));
    leave(member, status, &error, true);
}

/* One alone needs no thread of its own. */
static HdStatus trace_all(Run *run, HdError *error) {
    const int count = run->sequence->team->count;
    for (int i = 0; i < count; i++) {
        run->members[i] = (Member){.run = run, .number = i};
        if (count > 1)
            start_member(&run->members[i]);
        else
            work(&run->members[i]);
    }
    for (int i = 0; i < count; i++)
        if (run->members[i].has_thread)
            pthread_join(run->members[i].thread, NULL);
    if (run->status != HD_OK)
        *error = run->error;
    return run->status;
}

/* ---- the sequence ---- */

static HdStatus start_store(Run *run, HdError *error) {
    const HdSequence *sequence = run->sequence;
    const HdFrameStorePlan plan = {
        .outputs = sequence->outputs,
        .resume = sequence->resume,
        .width = sequence->scene->width,
        .height = sequence->scene->height,
        .tracers = sequence->team->count > 0 ? sequence->team->count : 1,
        .start = run->start,
        .stored = sequence->stored,
        .context = sequence->context,
    };
    HD_TRY(hd_frame_store_start(&run->store, &plan, error));
    run->stages = hd_frame_store_stages(run->store);
    return HD_OK;
}

/* One device alone gets the scene before there are outputs. */
HdStatus hd_sequence_render(const HdSequence *sequence, HdError *error) {
    Run run = {
        .sequence = sequence,
        .start = hd_monotonic_seconds(),
        .turns = {.count = sequence->team->count},
        .waiting = sequence->team->count,
        .alive = sequence->team->count,
    };
    pthread_mutex_init(&run.mutex, NULL);
    pthread_mutex_init(&run.turns.mutex, NULL);
    for (int i = 0; i < run.turns.count; i++)
        run.turns.list[i].is_cpu = sequence->team->list[i].device.is_cpu;
    hd_known_folders_forget(); /* what was there before another sequence may rightly be gone */
    HdStatus status = sequence->team->count == 1 ? upload(&run, 0, error) : HD_OK;
    if (status == HD_OK)
        status = start_store(&run, error);
    if (status == HD_OK)
        status = hd_frame_store_end(run.store, trace_all(&run, error), error);
    free_tables(&run);
    pthread_mutex_destroy(&run.turns.mutex);
    pthread_mutex_destroy(&run.mutex);
    return status;
}
