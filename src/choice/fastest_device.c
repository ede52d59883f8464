/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "choice/fastest_device.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "choice/record.h"

enum { MAX_COMPARED = 16, DEVICES_LENGTH = 1 << 14 };

static const char record_kind[] = "choice";

typedef struct Choosing {
    HdCandidates *candidates;
    int compared;
    double seconds[MAX_COMPARED]; /* for the same picture; infinite: it failed */
    int best;                     /* -1: none yet; open where it was measured */
} Choosing;

static bool is_faster(const Choosing *choosing, int index) {
    return isfinite(choosing->seconds[index]) &&
           (choosing->best < 0 || choosing->seconds[index] < choosing->seconds[choosing->best]);
}

/* ---- the record of an earlier measurement ---- */

static void write_devices(const Choosing *choosing, char text[DEVICES_LENGTH]) {
    int length = 0;
    for (int i = 0; i < choosing->compared && length < DEVICES_LENGTH; i++) {
        const HdDevice *device = &choosing->candidates->list[i].device;
        length += snprintf(text + length, (size_t)(DEVICES_LENGTH - length), "%s %d %s (%s)\n",
                           device->backend->name, device->index, device->name, device->driver);
    }
}

static void write_record(const Choosing *choosing) {
    const HdDeviceWish *wish = &choosing->candidates->wish;
    char devices[DEVICES_LENGTH], text[MAX_COMPARED * 32] = "";
    size_t length = 0;
    HdError ignored; /* next time it is measured again */
    for (int i = 0; i < choosing->compared && length < sizeof text; i++)
        length += (size_t)snprintf(text + length, sizeof text - length, "%.9f\n",
                                   isfinite(choosing->seconds[i]) ? choosing->seconds[i] : -1.0);
    write_devices(choosing, devices);
    hd_record_put(record_kind, wish->job->scene, wish->options, devices, text, &ignored);
}

/* False where there is no record, or one that makes no sense. */
static bool read_record(Choosing *choosing) {
    const HdDeviceWish *wish = &choosing->candidates->wish;
    char devices[DEVICES_LENGTH], text[MAX_COMPARED * 32];
    write_devices(choosing, devices);
    if (!hd_record_get(record_kind, wish->job->scene, wish->options, devices, text, sizeof text))
        return false;
    char *line = text, *end = text;
    for (int i = 0; i < choosing->compared; i++, line = end) {
        double seconds = strtod(line, &end);
        if (end == line || !isfinite(seconds))
            return false;
        choosing->seconds[i] = seconds > 0.0 ? seconds : (double)INFINITY;
        if (is_faster(choosing, i))
            choosing->best = i;
    }
    return choosing->best >= 0;
}

/* ---- reasons ---- */

static void explain_speed(const Choosing *choosing, const char *when) {
    const HdTeamDevice *list = choosing->candidates->list;
    char *why = choosing->candidates->why;
    const int room = sizeof choosing->candidates->why;
    int length = snprintf(why, (size_t)room, "the fastest of %d on this kind of scene%s",
                          choosing->compared, when);
    for (int i = 0; i < choosing->compared && length < room; i++)
        if (i != choosing->best && isfinite(choosing->seconds[i]))
            length +=
                snprintf(why + length, (size_t)(room - length), ", %.3g ms against %.3g ms (%s %d)",
                         1e3 * choosing->seconds[choosing->best], 1e3 * choosing->seconds[i],
                         list[i].device.backend->name, list[i].device.index);
}

static void note_failure(HdCandidates *candidates, const char *message) {
    size_t length = strlen(candidates->note);
    snprintf(candidates->note + length, sizeof candidates->note - length, "%s%.600s",
             length > 0 ? "; " : "", message);
}

/* ---- measuring ---- */

/* So small a picture that plain C renders it in a tenth of a second. */
static double share_to_measure(const HdCandidates *candidates) {
    const double seconds = 0.1;
    return candidates->frame_seconds > seconds ? seconds / candidates->frame_seconds : 1.0;
}

/* The first of two frames warms up. The fastest so far stays open. */
static HdStatus measure_one(Choosing *choosing, int index, HdError *error) {
    HdCandidates *candidates = choosing->candidates;
    const HdDeviceWish *wish = &candidates->wish;
    HdTeamDevice *member = &candidates->list[index];
    HdTrialTime time;
    HdStatus status = hd_launch_open(member, wish->options, wish->job, true, error);
    if (status == HD_OK)
        status = hd_trial_measure(member->renderer, wish->job, share_to_measure(candidates), 2,
                                  &time, error);
    choosing->seconds[index] = status == HD_OK ? time.seconds : (double)INFINITY;
    int slower = index;
    if (is_faster(choosing, index)) {
        slower = choosing->best;
        choosing->best = index;
    }
    if (slower >= 0)
        hd_launch_close(&candidates->list[slower]);
    return status;
}

/* What failed at work may do better another time, so that nothing is remembered then. */
static HdStatus measure_all(Choosing *choosing, HdError *error) {
    bool is_lasting = true;
    for (int i = 0; i < choosing->compared; i++) {
        HdStatus status = measure_one(choosing, i, error);
        if (status == HD_INTERRUPTED || status == HD_BAD_INPUT)
            return status;
        if (status != HD_OK)
            note_failure(choosing->candidates, error->message);
        bool is_passing = status == HD_FAILED || (status != HD_OK && hd_is_loss(error));
        is_lasting = is_lasting && !is_passing;
    }
    if (choosing->best < 0)
        return HD_OK;
    if (is_lasting)
        write_record(choosing);
    explain_speed(choosing, "");
    return HD_OK;
}

/* ---- choosing ---- */

static int find_plain_c(const Choosing *choosing) {
    for (int i = 0; i < choosing->compared; i++)
        if (choosing->candidates->list[i].device.backend->needs_no_driver)
            return i;
    return -1;
}

static HdStatus choose(Choosing *choosing, HdError *error) {
    HdCandidates *candidates = choosing->candidates;
    double seconds = candidates->frame_seconds * candidates->wish.job->frame_count;
    if (choosing->compared < 2)
        return HD_OK;
    if (read_record(choosing)) {
        explain_speed(choosing, ", measured earlier");
        return HD_OK;
    }
    choosing->best = -1;
    if (seconds >= HD_AUTO_MEASURE_SECONDS)
        return measure_all(choosing, error);
    choosing->best = find_plain_c(choosing);
    if (choosing->best >= 0)
        snprintf(candidates->why, sizeof candidates->why,
                 "it needs about %.2g s, too little to measure other devices for", seconds);
    return HD_OK;
}

/* The best, else those that follow it, else those before it. Kernels that are compiled for the
   scene must prove themselves first; those compiled ahead get it when it is rendered. */
static HdStatus open_next(Choosing *choosing, HdError *error) {
    HdCandidates *candidates = choosing->candidates;
    const HdDeviceWish *wish = &candidates->wish;
    const int first = choosing->best >= 0 ? choosing->best : 0;
    const int tries = candidates->is_free ? candidates->count : 1;
    HdStatus status = HD_UNAVAILABLE;
    for (int i = 0; status == HD_UNAVAILABLE && i < tries; i++) {
        choosing->best = (first + i) % candidates->count;
        HdTeamDevice *member = &candidates->list[choosing->best];
        bool is_proven = candidates->is_free && member->device.backend->functions->kernels != NULL;
        status = hd_launch_open(member, wish->options, wish->job, is_proven, error);
        if (status == HD_UNAVAILABLE)
            note_failure(candidates, error->message);
        if (i > 0 && candidates->compared > 0)
            snprintf(candidates->why, sizeof candidates->why,
                     "the next after one that cannot be used");
    }
    return status;
}

HdStatus hd_fastest_open(HdCandidates *candidates, HdTeamDevice *opened, HdError *error) {
    Choosing choosing = {
        .candidates = candidates,
        .compared = candidates->compared < MAX_COMPARED ? candidates->compared : MAX_COMPARED,
        .best = -1,
    };
    HdStatus status = choose(&choosing, error);
    if (status == HD_OK && (choosing.best < 0 || candidates->list[choosing.best].renderer == NULL))
        status = open_next(&choosing, error);
    if (status == HD_OK)
        *opened = candidates->list[choosing.best];
    else if (choosing.best >= 0)
        hd_launch_close(&candidates->list[choosing.best]);
    return status;
}
