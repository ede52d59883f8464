/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "run/sequence.h"

#include <pthread.h>
#include <string.h>

#include "run/tracer.h"
#include "system/atomic_file.h"
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
    HdTracerJob job;
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
static HdStatus find_tables(Run *run, int lanes, const HdSceneTables **found, HdError *error) {
    for (int i = 0; i < run->table_count; i++)
        if (run->tables[i].lanes == lanes) {
            *found = &run->tables[i];
            return HD_OK;
        }
    HdSceneTables *tables = &run->tables[run->table_count];
    HdStatus status = hd_compile_scene(tables, run->sequence->scene, run->sequence->team->precision,
                                       lanes, error);
    run->table_count += status == HD_OK;
    *found = tables;
    return status;
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
    HdStatus status = find_tables(run, hd_renderer_lanes(renderer), &tables, error);
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

static bool has_gpu(const HdTurns *turns) {
    for (int i = 0; i < turns->count; i++)
        if (!turns->list[i].is_cpu)
            return true;
    return false;
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
    if (!run->turns.list[number].is_cpu || !has_gpu(&run->turns) ||
        hd_scene_is_surveyed(sequence->scene))
        return HD_OK;
    HdStatus status = hd_trial(renderer_of(run, number), &job, &wish, &trial, error);
    if (status != HD_OK)
        return status;
    hd_turns_estimate(&run->turns, number, trial.frame_seconds);
    hd_stages_ask_again(run->job.stages);
    return HD_OK;
}

/* Several devices get the scene while frames are traced; one alone has it already. */
static HdStatus prepare(Run *run, int number, HdError *error) {
    HdStatus status = run->sequence->team->count > 1 ? upload(run, number, error) : HD_OK;
    return status == HD_OK ? estimate_pace(run, number, error) : status;
}

/* ---- the end of a device ---- */

static void end_run(Run *run, HdStatus status, const HdError *error) {
    if (run->status == HD_OK) {
        run->status = status;
        run->error = *error;
    }
}

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
    if (status != HD_OK && is_fault_of_device && run->sequence->team->count > 1)
        drop_device(run, member->number, status, error);
    else if (status != HD_OK)
        end_run(run, status, error);
    bool is_over = run->status != HD_OK;
    pthread_mutex_unlock(&run->mutex);
    if (is_over)
        hd_stages_stop(run->job.stages);
    else
        hd_stages_ask_again(run->job.stages);
}

/* ---- threads ---- */

static void *trace(void *argument) {
    const Member *member = argument;
    Run *run = member->run;
    HdError error;
    HdStatus status = prepare(run, member->number, &error);
    bool is_fault_of_device = status != HD_INTERRUPTED;
    if (status == HD_OK)
        status = hd_trace_frames(&run->job, renderer_of(run, member->number), member->number,
                                 &is_fault_of_device, &error);
    leave(member, status, &error, is_fault_of_device);
    return NULL;
}

static void start_member(Member *member) {
    HdError error;
    int reason = hd_start_thread(&member->thread, trace, member);
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
            trace(&run->members[i]);
    }
    for (int i = 0; i < count; i++)
        if (run->members[i].has_thread)
            pthread_join(run->members[i].thread, NULL);
    if (run->status != HD_OK)
        *error = run->error;
    return run->status;
}

/* ---- the sequence ---- */

static void begin_devices(Run *run) {
    const HdSequence *sequence = run->sequence;
    run->job.turns = &run->turns;
    pthread_mutex_init(&run->mutex, NULL);
    pthread_mutex_init(&run->turns.mutex, NULL);
    for (int i = 0; i < sequence->team->count; i++)
        run->turns.list[i].is_cpu = sequence->team->list[i].device.is_cpu;
}

static void end_devices(Run *run) {
    free_tables(run);
    pthread_mutex_destroy(&run->turns.mutex);
    pthread_mutex_destroy(&run->mutex);
}

static HdStatus start_store(Run *run, HdError *error) {
    const HdSequence *sequence = run->sequence;
    const HdFrameStorePlan plan = {
        .outputs = sequence->outputs,
        .resume = sequence->resume,
        .width = sequence->scene->width,
        .height = sequence->scene->height,
        .tracers = sequence->team->count > 0 ? sequence->team->count : 1,
        .start = run->job.start,
        .stored = sequence->stored,
        .context = sequence->context,
    };
    HdStatus status = hd_frame_store_start(&run->job.store, &plan, error);
    if (status == HD_OK)
        run->job.stages = hd_frame_store_stages(run->job.store);
    return status;
}

/* One device alone gets the scene before there are outputs. */
HdStatus hd_sequence_render(const HdSequence *sequence, HdError *error) {
    Run run = {
        .sequence = sequence,
        .job = {.scene = sequence->scene,
                .frames = sequence->resume->all,
                .wish = sequence->outputs->wish,
                .watch = sequence->watch,
                .start = hd_monotonic_seconds()},
        .turns = {.count = sequence->team->count},
        .waiting = sequence->team->count,
        .alive = sequence->team->count,
    };
    begin_devices(&run);
    hd_known_folders_forget(); /* what was there before another sequence may rightly be gone */
    HdStatus status = sequence->team->count == 1 ? upload(&run, 0, error) : HD_OK;
    if (status == HD_OK)
        status = start_store(&run, error);
    if (status == HD_OK)
        status = hd_frame_store_end(run.job.store, trace_all(&run, error), error);
    end_devices(&run);
    return status;
}
