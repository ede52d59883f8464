/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "render/team.h"

#include <pthread.h>
#include <string.h>

#include "system/machine.h"

typedef struct Run Run;

typedef struct Member {
    Run *run;
    int number;
    bool has_thread;
    pthread_t thread;
} Member;

struct Run {
    const HdTracerTeam *team;
    Member members[HD_MOST_TRACERS];
    pthread_mutex_t mutex; /* of what follows; taken after the store's, never before it */
    HdTracerPace paces[HD_MOST_TRACERS];
    int alive;
    HdStatus status;
    HdError error;
};

/* ---- pace ---- */

static bool wants(void *context, int left) {
    const Member *member = context;
    Run *run = member->run;
    pthread_mutex_lock(&run->mutex);
    bool wanted = hd_tracer_pace_wants(run->paces, run->team->count, member->number, left,
                                       hd_monotonic_seconds());
    pthread_mutex_unlock(&run->mutex);
    return wanted;
}

static void begun(void *context) {
    const Member *member = context;
    Run *run = member->run;
    pthread_mutex_lock(&run->mutex);
    hd_tracer_pace_begun(&run->paces[member->number], hd_monotonic_seconds());
    pthread_mutex_unlock(&run->mutex);
}

static void finished(void *context, double seconds) {
    const Member *member = context;
    Run *run = member->run;
    pthread_mutex_lock(&run->mutex);
    hd_tracer_pace_finished(&run->paces[member->number], seconds, hd_monotonic_seconds());
    pthread_mutex_unlock(&run->mutex);
}

static void given_back(void *context) {
    const Member *member = context;
    Run *run = member->run;
    pthread_mutex_lock(&run->mutex);
    hd_tracer_pace_given_back(&run->paces[member->number], hd_monotonic_seconds());
    pthread_mutex_unlock(&run->mutex);
}

static void note_estimate(const Member *member, double seconds) {
    Run *run = member->run;
    pthread_mutex_lock(&run->mutex);
    run->paces[member->number].seconds = seconds;
    pthread_mutex_unlock(&run->mutex);
    hd_frame_store_ask_again(run->team->job->store);
}

/* ---- the end of a device ---- */

static void end_run(Run *run, HdStatus status, const HdError *error) {
    if (run->status == HD_OK) {
        run->status = status;
        run->error = *error;
    }
}

static void drop_device(Run *run, int number, HdStatus status, const HdError *error) {
    run->paces[number].is_gone = true;
    if (--run->alive > 0)
        run->team->dropped(run->team->context, number, error);
    else if (run->status == HD_OK)
        run->status = hd_fail(&run->error, status, "no device is left, for the last one failed: %s",
                              error->message);
}

static void leave(const Member *member, HdStatus status, const HdError *error,
                  bool is_fault_of_device) {
    Run *run = member->run;
    HdFrameStore *store = run->team->job->store;
    pthread_mutex_lock(&run->mutex);
    if (status != HD_OK && is_fault_of_device)
        drop_device(run, member->number, status, error);
    else if (status != HD_OK)
        end_run(run, status, error);
    bool is_over = run->status != HD_OK;
    pthread_mutex_unlock(&run->mutex);
    if (is_over)
        hd_frame_store_stop(store);
    else
        hd_frame_store_ask_again(store);
}

/* ---- threads ---- */

/* Tells whether it came to tracing: before that whatever fails is this device's own. */
static HdStatus trace(const Member *member, bool *has_begun, HdError *error) {
    const HdTracerTeam *team = member->run->team;
    HdTracer tracer;
    double seconds = 0.0;
    const HdTracerWatch watch = {
        .wants = wants,
        .begun = begun,
        .finished = finished,
        .given_back = given_back,
        .context = (void *)member,
    };
    *has_begun = false;
    HdStatus status = team->prepare(team->context, member->number, &seconds, error);
    if (status != HD_OK)
        return status;
    note_estimate(member, seconds);
    status =
        hd_tracer_open(&tracer, team->job, team->renderers[member->number], member->number, error);
    if (status == HD_OK) {
        *has_begun = true;
        status = hd_tracer_run(&tracer, &watch, error);
        hd_tracer_close(&tracer);
    }
    return status;
}

static void *member_main(void *argument) {
    const Member *member = argument;
    HdError error;
    bool has_begun;
    HdStatus status = trace(member, &has_begun, &error);
    bool has_failed =
        !has_begun || hd_renderer_has_failed(member->run->team->renderers[member->number]);
    leave(member, status, &error, status != HD_INTERRUPTED && has_failed);
    return NULL;
}

static void start_member(Run *run, int number) {
    Member *member = &run->members[number];
    HdError error;
    int reason = pthread_create(&member->thread, NULL, member_main, member);
    member->has_thread = reason == 0;
    if (reason == 0)
        return;
    HdStatus status =
        hd_fail(&error, HD_FAILED, "cannot start a thread for the device: %s", strerror(reason));
    leave(member, status, &error, true);
}

static void create_members(Run *run, const HdTracerTeam *team) {
    memset(run, 0, sizeof *run);
    run->team = team;
    run->alive = team->count;
    pthread_mutex_init(&run->mutex, NULL);
    for (int i = 0; i < team->count; i++) {
        run->members[i] = (Member){.run = run, .number = i};
        run->paces[i].is_cpu = hd_renderer_device(team->renderers[i])->is_cpu;
    }
}

HdStatus hd_tracer_team_run(const HdTracerTeam *team, HdError *error) {
    Run run;
    create_members(&run, team);
    for (int i = 0; i < team->count; i++)
        start_member(&run, i);
    for (int i = 0; i < team->count; i++)
        if (run.members[i].has_thread)
            pthread_join(run.members[i].thread, NULL);
    pthread_mutex_destroy(&run.mutex);
    if (run.status != HD_OK)
        *error = run.error;
    return run.status;
}
