/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "run/tracer.h"

#include <math.h>

#include "render/frame.h"
#include "scene/camera.h"
#include "system/interrupt.h"
#include "system/machine.h"

/* ---- turns ---- */

static bool awaits_gpu(const HdTurn *list, int count) {
    for (int i = 0; i < count; i++)
        if (!list[i].is_gone && !list[i].is_cpu && list[i].seconds <= 0.0)
            return true;
    return false;
}

/* When a tracer has finished so many frames more. */
static double end_of(const HdTurn *turn, int more, double now) {
    return fmax(turn->busy_until, now) + more * turn->seconds;
}

/* Who finishes another frame first, if each has taken as many as `taken` says: -1: nobody. */
static int first_to_finish(const HdTurn *list, const int *taken, int count, double now) {
    int first = -1;
    double least = 0.0;
    for (int i = 0; i < count; i++) {
        if (list[i].is_gone || list[i].seconds <= 0.0)
            continue;
        double end = end_of(&list[i], taken[i] + 1, now);
        if (first < 0 || end < least) {
            first = i;
            least = end;
        }
    }
    return first;
}

static bool is_turn_of(const HdTurns *turns, int number, int left, double now) {
    const HdTurn *own = &turns->list[number];
    int taken[HD_MOST_TRACERS] = {0};
    if (turns->count == 1)
        return true;
    if (own->is_cpu && awaits_gpu(turns->list, turns->count))
        return false;
    if (own->seconds <= 0.0)
        return own->in_flight == 0;
    for (int i = 0; i < left; i++) {
        int first = first_to_finish(turns->list, taken, turns->count, now);
        if (first == number)
            return true;
        taken[first]++;
    }
    return false;
}

bool hd_turns_want(HdTurns *turns, int number, int left, double now) {
    pthread_mutex_lock(&turns->mutex);
    bool wanted = is_turn_of(turns, number, left, now);
    pthread_mutex_unlock(&turns->mutex);
    return wanted;
}

void hd_turns_estimate(HdTurns *turns, int number, double seconds) {
    pthread_mutex_lock(&turns->mutex);
    turns->list[number].seconds = seconds;
    pthread_mutex_unlock(&turns->mutex);
}

void hd_turns_leave(HdTurns *turns, int number) {
    pthread_mutex_lock(&turns->mutex);
    turns->list[number].is_gone = true;
    pthread_mutex_unlock(&turns->mutex);
}

void hd_turns_begun(HdTurns *turns, int number, double now) {
    HdTurn *turn = &turns->list[number];
    pthread_mutex_lock(&turns->mutex);
    turn->busy_until = end_of(turn, 1, now);
    turn->in_flight++;
    pthread_mutex_unlock(&turns->mutex);
}

static void end_frame(HdTurn *turn, double now) {
    turn->in_flight--;
    turn->busy_until = now + turn->in_flight * turn->seconds;
}

void hd_turns_finished(HdTurns *turns, int number, double seconds, double now) {
    HdTurn *turn = &turns->list[number];
    pthread_mutex_lock(&turns->mutex);
    turn->seconds = turn->seconds > 0.0 ? 0.5 * (turn->seconds + seconds) : seconds;
    end_frame(turn, now);
    pthread_mutex_unlock(&turns->mutex);
}

void hd_turns_given_back(HdTurns *turns, int number, double now) {
    pthread_mutex_lock(&turns->mutex);
    end_frame(&turns->list[number], now);
    pthread_mutex_unlock(&turns->mutex);
}

/* ---- flights ---- */

/* A frame that the renderer works on. */
typedef struct Flight {
    int place; /* in the list */
    HdFlight frame;
    HdSpan prepare;
    double begun; /* seconds since the start of the run */
} Flight;

typedef struct Tracer {
    const HdTracerJob *job;
    int number;
    HdFrameMaker maker;
    int begun, ended; /* frames so far */
    Flight flights[HD_FRAMES_IN_FLIGHT];
    double traced;   /* when the last frame's tracing was over */
    double finished; /* when the last frame was */
} Tracer;

static double seconds_since_start(const Tracer *tracer) {
    return hd_monotonic_seconds() - tracer->job->start;
}

static Flight *flight_of(Tracer *tracer, int count) {
    return &tracer->flights[count % HD_FRAMES_IN_FLIGHT];
}

static int in_flight(const Tracer *tracer) {
    return tracer->begun - tracer->ended;
}

/* On failure the frame is not begun; the earlier ones are still under way. */
static HdStatus begin(Tracer *tracer, int place, HdError *error) {
    const HdTracerJob *job = tracer->job;
    Flight *flight = flight_of(tracer, tracer->begun);
    double now = seconds_since_start(tracer);
    HdCamera camera;
    *flight = (Flight){.place = place, .prepare = {.began = now}, .begun = now};
    HdStatus status = hd_camera_at(&camera, job->scene, job->frames->frames[place], error);
    if (status == HD_OK)
        status = hd_frame_prepare(&tracer->maker, &camera, &flight->frame, error);
    flight->prepare.seconds = seconds_since_start(tracer) - now;
    if (status == HD_OK)
        status = hd_frame_begin(&tracer->maker, &flight->frame, error);
    if (status == HD_OK)
        tracer->begun++;
    return status;
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
        hd_frame_store_frame(tracer->job->store, flight->place, tracer->number, &times);
    double waited_from = seconds_since_start(tracer);
    HdStatus status = hd_frame_end(&tracer->maker, &flight->frame, frame, error);
    if (status != HD_OK)
        return status;
    note_times(tracer, flight, waited_from, frame->trace_seconds, times);
    times->longest_launch = hd_renderer_take_longest_launch(tracer->maker.renderer);
    if (hd_interrupt_signal() != 0)
        return hd_fail(error, HD_INTERRUPTED, "interrupted between two frames");
    return status;
}

static void give_oldest(Tracer *tracer) {
    const Flight *flight = flight_of(tracer, tracer->ended++);
    double now = seconds_since_start(tracer);
    double taken = now - fmax(flight->begun, tracer->finished);
    tracer->finished = now;
    hd_turns_finished(tracer->job->turns, tracer->number, taken, hd_monotonic_seconds());
    hd_stages_give(tracer->job->stages, flight->place);
}

static void give_all_back(Tracer *tracer) {
    hd_renderer_drop(tracer->maker.renderer);
    for (; tracer->ended < tracer->begun; tracer->ended++) {
        Flight *flight = flight_of(tracer, tracer->ended);
        hd_flight_drop(&flight->frame);
        hd_turns_given_back(tracer->job->turns, tracer->number, hd_monotonic_seconds());
        hd_stages_give_back(tracer->job->stages, flight->place);
    }
}

/* Whether the store is told of what failed, for no device would do better. */
static bool is_told(Tracer *tracer, int place, HdStatus status, const HdError *error) {
    if (status == HD_INTERRUPTED || hd_renderer_has_failed(tracer->maker.renderer))
        return false;
    hd_stages_fail(tracer->job->stages, place, error);
    return true;
}

/* Once the store wants the oldest frame no more, another tracer may still fail at an earlier one,
   which is then to be taken. */
static HdStatus finish_oldest(Tracer *tracer, HdError *error) {
    int place = flight_of(tracer, tracer->ended)->place;
    HdStatus status = HD_OK;
    bool is_wanted = hd_stages_wait(tracer->job->stages, place);
    if (is_wanted)
        status = fill_oldest(tracer, error);
    if (is_wanted && status == HD_OK) {
        give_oldest(tracer);
        return HD_OK;
    }
    if (is_wanted && !is_told(tracer, place, status, error))
        return status;
    give_all_back(tracer);
    return HD_OK;
}

static bool wants(void *context, int left) {
    const Tracer *tracer = context;
    return hd_turns_want(tracer->job->turns, tracer->number, left, hd_monotonic_seconds());
}

/* Negative: none now. A tracer alone begins frames before there is room for them. One of several
   may be given an earlier frame than those it has begun, which others wait for: it begins what it
   can finish. */
static int take_frame(Tracer *tracer) {
    const HdTaker taker = {
        .wants = wants,
        .context = tracer,
        .ahead = tracer->job->turns->count == 1 ? HD_FRAMES_IN_FLIGHT : 0,
    };
    if (in_flight(tracer) >= hd_frame_most_flights(&tracer->maker))
        return -1;
    return hd_stages_take(tracer->job->stages, &taker, in_flight(tracer) == 0);
}

static HdStatus begin_taken(Tracer *tracer, int place, HdError *error) {
    HdStatus status = begin(tracer, place, error);
    if (status == HD_OK)
        hd_turns_begun(tracer->job->turns, tracer->number, hd_monotonic_seconds());
    if (status == HD_OK || is_told(tracer, place, status, error))
        return HD_OK;
    hd_stages_give_back(tracer->job->stages, place);
    return status;
}

/* Where the device takes no more, it may still finish what it has. */
static HdStatus trace(Tracer *tracer, HdError *error) {
    HdStatus status = HD_OK, beginning = HD_OK;
    HdError of_beginning;
    while (status == HD_OK) {
        int place = beginning == HD_OK ? take_frame(tracer) : -1;
        if (place >= 0)
            beginning = begin_taken(tracer, place, &of_beginning);
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

HdStatus hd_trace_frames(const HdTracerJob *job, HdRenderer *renderer, int number,
                         bool *is_fault_of_device, HdError *error) {
    const HdFrameMaker maker = {
        .renderer = renderer, .scene = job->scene, .wish = job->wish, .watch = job->watch};
    Tracer tracer = {.job = job, .maker = maker, .number = number};
    HdStatus status = hd_frame_maker_open(&tracer.maker, error);
    *is_fault_of_device = status != HD_INTERRUPTED;
    if (status != HD_OK)
        return status;
    status = trace(&tracer, error);
    *is_fault_of_device = status != HD_INTERRUPTED && hd_renderer_has_failed(renderer);
    hd_frame_maker_close(&tracer.maker);
    return status;
}
