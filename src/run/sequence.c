/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "run/sequence.h"

#include <math.h>
#include <pthread.h>
#include <string.h>

#include "render/frame.h"
#include "run/frame_scheduler.h"
#include "scene/camera.h"
#include "system/atomic_file.h"
#include "system/interrupt.h"
#include "system/machine.h"
#include "system/thread_pool.h"
#include "verify/trust.h"

/* One for each lane count. */
#define COUNTED(lanes) +1
enum { MAX_TABLES = 0 HD_LANE_COUNTS(COUNTED) };

typedef struct Run Run;

/* A device of the team, which may be the only one. */
typedef struct Member {
    Run *run;
    int number;
    bool has_thread;
    pthread_t thread;
} Member;

struct Run {
    const HdSequence *sequence;
    HdFrameScheduler scheduler; /* its mutex is locked after the store's, never before it */
    double start;               /* start by hd_monotonic_seconds */
    HdFrameStore *store;
    HdStages *stages; /* stages of the store */
    Member members[HD_MAX_WORKERS];
    pthread_mutex_t mutex; /* lock of the members below */
    HdSceneTables tables[MAX_TABLES];
    int table_count;
    int waiting; /* renderers without the scene */
    int alive;
    HdStatus status;
    HdError error;
};

/* ---- the scene on a device ---- */

static HdRenderer *renderer_of(const Run *run, int number) {
    return run->sequence->team->list[number].renderer;
}

/* Compiles the scene once for all renderers with the same number of lanes. */
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

/* Uploads the scene to a renderer; the last one frees the tables. */
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

/* Times a CPU beside GPUs, since its first frame might take longer than all of theirs. */
static HdStatus estimate_pace(Run *run, int number, HdError *error) {
    const HdSequence *sequence = run->sequence;
    const HdFrameList *missing = &sequence->resume->missing;
    const HdJob job = {
        .scene = sequence->scene,
        .first_frame = missing->frames[0],
        .frame_count = missing->count,
    };
    const HdTrialRequest request = hd_trial_request(0.0);
    HdTrial trial;
    bool has_gpu = false;
    for (int i = 0; i < run->scheduler.count; i++)
        has_gpu = has_gpu || !run->scheduler.list[i].is_cpu;
    if (!run->scheduler.list[number].is_cpu || !has_gpu ||
        hd_scene_has_error_bound(sequence->scene))
        return HD_OK;
    HD_TRY(hd_trial(renderer_of(run, number), &job, &request, &trial, error));
    hd_scheduler_estimate(&run->scheduler, number, trial.frame_seconds);
    hd_stages_wake(run->stages);
    return HD_OK;
}

/* Several devices get the scene while others trace; a single one has it already. */
static HdStatus prepare(Run *run, int number, HdError *error) {
    if (run->sequence->team->count > 1)
        HD_TRY(upload(run, number, error));
    return estimate_pace(run, number, error);
}

/* ---- tracing on a device ---- */

/* A frame in flight on the renderer. */
typedef struct InFlight {
    int place; /* index in the list */
    HdFrameInFlight frame;
    HdSpan prepare; /* since the start of the run */
} InFlight;

typedef struct Worker {
    Run *run;
    int number;
    HdFrameMaker maker;
    int begun, ended; /* numbers of frames so far */
    InFlight in_flight[HD_FRAMES_IN_FLIGHT];
    double traced;   /* time when the last frame's tracing ended */
    double finished; /* time when the last frame ended */
} Worker;

static double seconds_since_start(const Worker *worker) {
    return hd_monotonic_seconds() - worker->run->start;
}

static InFlight *in_flight_of(Worker *worker, int count) {
    return &worker->in_flight[count % HD_FRAMES_IN_FLIGHT];
}

static int count_in_flight(const Worker *worker) {
    return worker->begun - worker->ended;
}

/* Derives a frame's times; frames are traced one after the other. If the wait was at least as long
   as tracing, tracing began with the wait; otherwise as soon as the device was free. The device's
   clock may differ slightly from the host's. */
static void note_times(Worker *worker, const InFlight *in_flight, double waited_from,
                       double trace_seconds, HdFrameTimes *times) {
    double now = seconds_since_start(worker);
    double prepared = in_flight->prepare.began + in_flight->prepare.seconds;
    double began = fmax(prepared, worker->traced);
    if (now - waited_from >= trace_seconds)
        began = waited_from;
    worker->traced = fmin(began + trace_seconds, now);
    double rest_from = fmax(worker->traced, waited_from);
    times->prepare = in_flight->prepare;
    times->trace = (HdSpan){began, trace_seconds};
    times->copy = (HdSpan){rest_from, now - rest_from};
}

/* Fills the oldest frame in flight, which stays in flight. */
static HdStatus fill_oldest(Worker *worker, HdError *error) {
    InFlight *in_flight = in_flight_of(worker, worker->ended);
    HdFrameTimes *times;
    HdFrame *frame =
        hd_frame_store_frame(worker->run->store, in_flight->place, worker->number, &times);
    double waited_from = seconds_since_start(worker);
    HD_TRY(hd_frame_end(&worker->maker, &in_flight->frame, frame, error));
    note_times(worker, in_flight, waited_from, frame->trace_seconds, times);
    times->longest_launch = hd_renderer_take_longest_launch(worker->maker.renderer);
    if (hd_interrupt_signal() != 0)
        return hd_fail(error, HD_INTERRUPTED, "interrupted between two frames");
    return HD_OK;
}

static void submit_oldest(Worker *worker) {
    const InFlight *in_flight = in_flight_of(worker, worker->ended++);
    double now = seconds_since_start(worker);
    double seconds = now - fmax(in_flight->prepare.began, worker->finished);
    worker->finished = now;
    hd_scheduler_ended(&worker->run->scheduler, worker->number, seconds, hd_monotonic_seconds());
    hd_stages_submit(worker->run->stages, in_flight->place);
}

static void release_all(Worker *worker) {
    hd_renderer_drop(worker->maker.renderer);
    for (; worker->ended < worker->begun; worker->ended++) {
        InFlight *in_flight = in_flight_of(worker, worker->ended);
        hd_frame_tables_free(&in_flight->frame.tables);
        hd_scheduler_ended(&worker->run->scheduler, worker->number, 0.0, hd_monotonic_seconds());
        hd_stages_release(worker->run->stages, in_flight->place);
    }
}

/* Reports the failure to the store and returns true; false if another device may succeed. */
static bool report_failure(Worker *worker, int place, HdStatus status, const HdError *error) {
    if (status == HD_INTERRUPTED || hd_renderer_has_failed(worker->maker.renderer))
        return false;
    hd_stages_fail(worker->run->stages, place, error);
    return true;
}

/* Collects the oldest frame. If the store does not want it, releases all frames: another worker may
   fail at an earlier one, which this worker must be free to claim. */
static HdStatus finish_oldest(Worker *worker, HdError *error) {
    int place = in_flight_of(worker, worker->ended)->place;
    if (hd_stages_wait(worker->run->stages, place)) {
        HdStatus status = fill_oldest(worker, error);
        if (status == HD_OK) {
            submit_oldest(worker);
            return HD_OK;
        }
        if (!report_failure(worker, place, status, error))
            return status;
    }
    release_all(worker);
    return HD_OK;
}

static bool wants(void *context, int left) {
    const Worker *worker = context;
    return hd_scheduler_wants(&worker->run->scheduler, worker->number, left,
                              hd_monotonic_seconds());
}

/* Claims a frame, or returns a negative number. A single worker claims ahead of the capacity. One
   of several may have to claim an earlier frame, which the others wait for, so it claims only what
   it can finish. */
static int claim_frame(Worker *worker) {
    const HdClaimer claimer = {
        .wants = wants,
        .context = worker,
        .ahead = worker->run->scheduler.count == 1 ? HD_FRAMES_IN_FLIGHT : 0,
    };
    if (count_in_flight(worker) >= hd_frame_max_in_flight(&worker->maker))
        return -1;
    return hd_stages_claim(worker->run->stages, &claimer, count_in_flight(worker) == 0);
}

/* On failure the frame is not begun; earlier ones stay in flight. */
static HdStatus begin_frame(Worker *worker, int place, HdError *error) {
    const HdSequence *sequence = worker->run->sequence;
    InFlight *in_flight = in_flight_of(worker, worker->begun);
    double now = seconds_since_start(worker);
    HdCamera camera;
    *in_flight = (InFlight){.place = place, .prepare = {.began = now}};
    HdStatus status =
        hd_camera_at(&camera, sequence->scene, sequence->resume->all->frames[place], error);
    if (status == HD_OK)
        status = hd_frame_prepare(&worker->maker, &camera, &in_flight->frame, error);
    in_flight->prepare.seconds = seconds_since_start(worker) - now;
    if (status == HD_OK)
        status = hd_frame_begin(&worker->maker, &in_flight->frame, error);
    if (status == HD_OK) {
        worker->begun++;
        hd_scheduler_begun(&worker->run->scheduler, worker->number, hd_monotonic_seconds());
        return HD_OK;
    }
    if (report_failure(worker, place, status, error))
        return HD_OK;
    hd_stages_release(worker->run->stages, place);
    return status;
}

/* Traces all frames. A device that accepts no more may still finish those in flight. */
static HdStatus trace(Worker *worker, HdError *error) {
    HdStatus status = HD_OK, beginning = HD_OK;
    HdError of_beginning;
    while (status == HD_OK) {
        int place = beginning == HD_OK ? claim_frame(worker) : -1;
        if (place >= 0)
            beginning = begin_frame(worker, place, &of_beginning);
        else if (count_in_flight(worker) > 0)
            status = finish_oldest(worker, error);
        else
            break;
    }
    release_all(worker);
    if (status != HD_OK || beginning == HD_OK)
        return status;
    *error = of_beginning;
    return beginning;
}

/* Traces frames until the store has none left. Reports failures of frames to the store. Fails if
   the device fails (hd_renderer_has_failed) or before the first frame, which counts as the device's
   fault; with HD_INTERRUPTED after a signal. Then releases the frames in flight. */
static HdStatus trace_frames(const Member *member, bool *is_fault_of_device, HdError *error) {
    const HdSequence *sequence = member->run->sequence;
    HdRenderer *renderer = renderer_of(member->run, member->number);
    Worker worker = {.run = member->run,
                     .number = member->number,
                     .maker = {.renderer = renderer,
                               .scene = sequence->scene,
                               .request = sequence->outputs->request,
                               .watch = sequence->watch}};
    HD_TRY(hd_frame_maker_open(&worker.maker, error));
    HdStatus status = trace(&worker, error);
    *is_fault_of_device = hd_renderer_has_failed(renderer);
    hd_frame_maker_close(&worker.maker);
    return status;
}

/* ---- the end of a device ---- */

static void drop_device(Run *run, int number, HdStatus status, const HdError *error) {
    hd_scheduler_leave(&run->scheduler, number);
    if (--run->alive > 0)
        run->sequence->dropped(run->sequence->context, number, error);
    else if (run->status == HD_OK)
        run->status = hd_fail(&run->error, status, "no device is left, for the last one failed: %s",
                              error->message);
}

/* With one device, its error message is used unchanged. */
static void finish_member(const Member *member, HdStatus status, const HdError *error,
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
        hd_stages_wake(run->stages);
}

/* ---- threads ---- */

static void *run_member(void *argument) {
    const Member *member = argument;
    Run *run = member->run;
    HdError error;
    bool is_fault_of_device = true;
    HdStatus status = prepare(run, member->number, &error);
    if (status == HD_OK)
        status = trace_frames(member, &is_fault_of_device, &error);
    finish_member(member, status, &error, is_fault_of_device && status != HD_INTERRUPTED);
    return NULL;
}

static void start_member(Member *member) {
    HdError error;
    int reason = hd_start_thread(&member->thread, run_member, member);
    member->has_thread = reason == 0;
    if (reason == 0)
        return;
    HdStatus status =
        hd_fail(&error, HD_FAILED, "cannot start a thread for the device: %s", strerror(reason));
    finish_member(member, status, &error, true);
}

/* A single device needs no thread of its own. */
static HdStatus trace_all(Run *run, HdError *error) {
    const int count = run->sequence->team->count;
    for (int i = 0; i < count; i++) {
        run->members[i] = (Member){.run = run, .number = i};
        if (count > 1)
            start_member(&run->members[i]);
        else
            run_member(&run->members[i]);
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
        .workers = sequence->team->count > 0 ? sequence->team->count : 1,
        .start = run->start,
        .stored = sequence->stored,
        .context = sequence->context,
    };
    HD_TRY(hd_frame_store_start(&run->store, &plan, error));
    run->stages = hd_frame_store_stages(run->store);
    return HD_OK;
}

/* A single device gets the scene before the outputs are made. */
HdStatus hd_sequence_render(const HdSequence *sequence, HdError *error) {
    Run run = {
        .sequence = sequence,
        .start = hd_monotonic_seconds(),
        .scheduler = {.count = sequence->team->count},
        .waiting = sequence->team->count,
        .alive = sequence->team->count,
    };
    pthread_mutex_init(&run.mutex, NULL);
    pthread_mutex_init(&run.scheduler.mutex, NULL);
    for (int i = 0; i < run.scheduler.count; i++)
        run.scheduler.list[i].is_cpu = sequence->team->list[i].device.is_cpu;
    hd_known_folders_forget(); /* folders of an earlier sequence may since have been removed */
    HdStatus status = sequence->team->count == 1 ? upload(&run, 0, error) : HD_OK;
    if (status == HD_OK)
        status = start_store(&run, error);
    if (status == HD_OK)
        status = hd_frame_store_end(run.store, trace_all(&run, error), error);
    free_tables(&run);
    pthread_mutex_destroy(&run.scheduler.mutex);
    pthread_mutex_destroy(&run.mutex);
    return status;
}
