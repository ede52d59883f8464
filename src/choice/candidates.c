/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "choice/candidates.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/minmax.h"
#include "base/text.h"

/* ---- reasons ---- */

/* Each reason once, though several devices may have it. */
static void add_reason(HdCandidates *candidates, const char *name, const char *reason) {
    if (strstr(candidates->reasons, reason) == NULL)
        hd_add_text(candidates->reasons, sizeof candidates->reasons, "; ", "%s: %s", name, reason);
}

static void note_failure(HdCandidates *candidates, const char *message) {
    hd_add_text(candidates->note, sizeof candidates->note, "; ", "%.600s", message);
}

/* A GPU that is there and not used is worth a word, unless the user's own wish rules out all. */
static void tell_passed(HdCandidates *candidates, const char *what, const char *reason,
                        const char *help) {
    const HdDeviceWish *wish = &candidates->wish;
    if (candidates->is_free && wish->kind != HD_ONLY_CPU && wish->options->lanes <= 1)
        hd_add_text(candidates->passed, sizeof candidates->passed, "; ", "%s is passed over: %s%s",
                    what, reason, help);
}

static void tell_passed_device(HdCandidates *candidates, const HdDevice *device,
                               const char *reason) {
    char what[sizeof device->name + 32];
    bool is_strictness = reason == device->not_strict;
    snprintf(what, sizeof what, "%s:%d (%s)", device->backend->name, device->index, device->name);
    tell_passed(candidates, what, reason,
                is_strictness ? "; --math fast would take it, for other bytes" : "");
}

/* ---- names ---- */

static bool contains(const char *text, const char *part) {
    size_t length = strlen(part);
    for (; *text != '\0'; text++)
        if (strncasecmp(text, part, length) == 0)
            return true;
    return length == 0;
}

static bool is_number(const char *text) {
    return *text != '\0' && text[strspn(text, "0123456789")] == '\0';
}

/* "c:0" names the backend as well. */
static HdStatus split_name(HdDeviceWish *wish, HdError *error) {
    for (int i = 0; i < HD_BACKEND_COUNT && wish->device != NULL; i++) {
        const char *name = hd_backends[i]->name;
        size_t length = strlen(name);
        if (strncmp(wish->device, name, length) != 0 || wish->device[length] != ':' ||
            !is_number(wish->device + length + 1))
            continue;
        if (wish->backend != NULL && strcmp(wish->backend, name) != 0)
            return hd_fail(error, HD_BAD_INPUT, "--device is '%s', but --backend is '%s'",
                           wish->device, wish->backend);
        wish->backend = name;
        wish->device += length + 1;
    }
    return HD_OK;
}

static bool is_named(const HdDevice *device, const char *wish) {
    if (wish == NULL)
        return true;
    return is_number(wish) ? strtol(wish, NULL, 10) == device->index : contains(device->name, wish);
}

HdStatus hd_devices_named(const char *backend, const char *device, HdDevice *devices, int *count,
                          HdError *error) {
    bool is_any = device == NULL || strcmp(device, "all") == 0;
    HdCandidates none = {.wish = {.backend = backend, .device = is_any ? NULL : device}};
    HdStatus status = split_name(&none.wish, error);
    *count = 0;
    for (int i = 0; status == HD_OK && i < HD_BACKEND_COUNT; i++) {
        int found = 0, kept = *count;
        if (none.wish.backend != NULL && strcmp(none.wish.backend, hd_backends[i]->name) != 0)
            continue;
        if (hd_backend_enumerate(hd_backends[i], devices + kept, HD_MAX_DEVICES, &found, error) !=
            HD_OK)
            add_reason(&none, hd_backends[i]->name, error->message);
        for (int d = kept; d < kept + found; d++)
            if (is_named(&devices[d], none.wish.device))
                devices[(*count)++] = devices[d];
        if (found > 0 && *count == kept)
            add_reason(&none, hd_backends[i]->name, "no device of that number or name");
    }
    if (status == HD_OK && *count == 0)
        status = hd_fail(error, HD_UNAVAILABLE, "there is no such device%s%s%s: %s",
                         device != NULL ? " ('" : "", device != NULL ? device : "",
                         device != NULL ? "')" : "", none.reasons);
    return status;
}

/* ---- finding ---- */

static bool is_in_question(const HdDevice *device, const HdDeviceWish *wish) {
    return is_named(device, wish->device) &&
           (!device->is_cpu || device->backend->needs_no_driver || wish->backend != NULL ||
            wish->device != NULL || wish->kind == HD_PREFER_GPU);
}

static double speed(const HdDevice *device) {
    return (double)device->compute_units * (double)device->clock_mhz;
}

/* `other` was found earlier, in the same backend or in one that comes first. */
static bool is_better(const HdDevice *device, const HdDevice *other) {
    if (device->is_cpu != other->is_cpu)
        return other->is_cpu;
    return device->backend == other->backend && speed(device) > speed(other);
}

static void add_candidate(HdCandidates *candidates, const HdDevice *device) {
    int place = candidates->count;
    while (place > 0 && is_better(device, &candidates->list[place - 1].device))
        place--;
    if (place == HD_MAX_CANDIDATES)
        return;
    if (candidates->count < HD_MAX_CANDIDATES)
        candidates->count++;
    memmove(&candidates->list[place + 1], &candidates->list[place],
            (size_t)(candidates->count - 1 - place) * sizeof *candidates->list);
    candidates->list[place] = (HdTeamDevice){.device = *device};
}

static void consider(HdCandidates *candidates, const HdDevice *device) {
    const char *reason = hd_device_obstacle(device, candidates->wish.options);
    if (candidates->wish.kind == HD_ONLY_CPU && !device->is_cpu)
        reason = "it is not a CPU";
    if (reason != NULL && !device->is_cpu)
        tell_passed_device(candidates, device, reason);
    if (reason != NULL)
        add_reason(candidates, device->name, reason);
    else
        add_candidate(candidates, device);
}

static void search_backend(HdCandidates *candidates, const HdBackend *backend, HdError *error) {
    HdDevice devices[HD_MAX_DEVICES];
    int count = 0;
    bool any = false;
    HdStatus status = hd_backend_enumerate(backend, devices, HD_MAX_DEVICES, &count, error);
    if (status == HD_FAILED)
        tell_passed(candidates, backend->name, error->message, "");
    if (status != HD_OK) {
        add_reason(candidates, backend->name, error->message);
        return;
    }
    for (int i = 0; i < count; i++) {
        if (!is_in_question(&devices[i], &candidates->wish))
            continue;
        any = true;
        consider(candidates, &devices[i]);
    }
    if (!any && candidates->wish.device != NULL)
        add_reason(candidates, backend->name, "no device of that number or name");
}

static void search(HdCandidates *candidates, HdError *error) {
    const HdDeviceWish *wish = &candidates->wish;
    if (wish->backend != NULL)
        search_backend(candidates, hd_backend_find(wish->backend), error);
    else if (wish->kind == HD_ONLY_CPU)
        search_backend(candidates, hd_backend_always_there(), error);
    else
        for (int i = 0; i < HD_BACKEND_COUNT; i++)
            search_backend(candidates, hd_backends[i], error);
}

/* How many of the candidates are worth a comparison: the GPUs, and plain C where any will do. */
static int count_compared(const HdCandidates *candidates) {
    int count = 0;
    while (count < candidates->count &&
           (!candidates->list[count].device.is_cpu || candidates->wish.kind == HD_WANT_ANY))
        count++;
    return count;
}

/* How long plain C takes for a frame. A texture takes longer to upload than a small picture to
   render, and little of its time. */
static HdStatus estimate(HdCandidates *candidates, double enough, HdError *error) {
    const HdRenderOptions *options = candidates->wish.options;
    const HdTrialWish wish = hd_trial_estimates(enough);
    HdScene plain = *candidates->wish.job->scene;
    HdJob job = *candidates->wish.job;
    HdDevice device;
    HdRenderer *renderer;
    HdTrial trial;
    int count;
    plain.floor.texture = (HdTexture){0};
    job.scene = &plain;
    HdStatus status = hd_backend_enumerate(hd_backend_always_there(), &device, 1, &count, error);
    if (status == HD_OK)
        status = hd_trial_open(&renderer, &device, options, &job, error);
    if (status != HD_OK)
        return status;
    status = hd_trial(renderer, &job, &wish, &trial, error);
    candidates->frame_seconds = trial.frame_seconds;
    hd_renderer_close(renderer);
    return status;
}

static double job_seconds(const HdCandidates *candidates) {
    return candidates->frame_seconds * candidates->wish.job->frame_count;
}

/* Plain C is asked how long it takes before any driver is: drivers take their time to start. */
static HdStatus estimate_any(HdCandidates *candidates, HdError *error) {
    HdStatus status = estimate(candidates, HD_AUTO_SMALL_SECONDS, error);
    if (status != HD_OK || job_seconds(candidates) > HD_AUTO_SMALL_SECONDS)
        return status;
    candidates->wish.kind = HD_ONLY_CPU;
    snprintf(candidates->why, sizeof candidates->why,
             "it needs about %.2g s, less than other devices take to start",
             job_seconds(candidates));
    return HD_OK;
}

static HdStatus fail_to_find(const HdCandidates *candidates, HdError *error) {
    const char *device = candidates->wish.device;
    return hd_fail(error, HD_UNAVAILABLE, "no device can do this%s%s%s: %s%s",
                   device != NULL ? " (asked for device '" : "", device != NULL ? device : "",
                   device != NULL ? "')" : "", candidates->reasons,
                   device != NULL ? "; see 'hedron devices'" : "");
}

HdStatus hd_candidates_find(HdCandidates *candidates, const HdDeviceWish *wish, HdError *error) {
    memset(candidates, 0, sizeof *candidates);
    candidates->wish = *wish;
    candidates->is_free =
        wish->backend == NULL && wish->device == NULL && wish->kind != HD_ONLY_CPU;
    HdStatus status = split_name(&candidates->wish, error);
    if (status == HD_OK && candidates->is_free && wish->kind == HD_WANT_ANY)
        status = estimate_any(candidates, error);
    if (status != HD_OK)
        return status;
    search(candidates, error);
    if (candidates->count == 0)
        return fail_to_find(candidates, error);
    if (candidates->is_free)
        candidates->compared = count_compared(candidates);
    if (candidates->compared > 1 && wish->kind == HD_PREFER_GPU)
        status = estimate(candidates, 0.0, error);
    return status;
}

/* ---- comparing ---- */

enum { MAX_COMPARED = 16 };

static bool is_faster(const HdCandidates *candidates, int index) {
    const HdTeamDevice *list = candidates->list;
    return isfinite(list[index].seconds) &&
           (candidates->best < 0 || list[index].seconds < list[candidates->best].seconds);
}

/* False where none was measured earlier, or none works. */
static bool recall(HdCandidates *candidates) {
    const HdDeviceWish *wish = &candidates->wish;
    if (!hd_measured_get(candidates->list, candidates->compared, wish->options, wish->job->scene))
        return false;
    for (int i = 0; i < candidates->compared; i++)
        if (is_faster(candidates, i))
            candidates->best = i;
    return candidates->best >= 0;
}

static void explain_speed(HdCandidates *candidates, const char *when) {
    const HdTeamDevice *list = candidates->list, *best = &list[candidates->best];
    snprintf(candidates->why, sizeof candidates->why, "the fastest of %d on this kind of scene%s",
             candidates->compared, when);
    for (int i = 0; i < candidates->compared; i++)
        if (&list[i] != best && isfinite(list[i].seconds))
            hd_add_text(candidates->why, sizeof candidates->why, ", ",
                        "%.3g ms against %.3g ms (%s %d)", 1e3 * best->seconds,
                        1e3 * list[i].seconds, list[i].device.backend->name, list[i].device.index);
}

/* So small a picture that plain C renders it in a tenth of a second. The first of two frames warms
   up. The fastest so far stays open. */
static HdStatus measure_one(HdCandidates *candidates, int index, HdError *error) {
    const double seconds = 0.1;
    const HdDeviceWish *wish = &candidates->wish;
    const HdTrialWish how = {.share = fmin(1.0, seconds / candidates->frame_seconds), .times = 2};
    HdTeamDevice *member = &candidates->list[index];
    HdTrial trial;
    HdStatus status = hd_team_device_open(member, wish->options, wish->job, true, error);
    if (status == HD_OK)
        status = hd_trial(member->renderer, wish->job, &how, &trial, error);
    member->seconds = status == HD_OK ? trial.seconds : (double)INFINITY;
    int slower = index;
    if (is_faster(candidates, index)) {
        slower = candidates->best;
        candidates->best = index;
    }
    if (slower >= 0)
        hd_team_device_close(&candidates->list[slower]);
    return status;
}

/* What failed at work may do better another time, so that nothing is remembered then. */
static HdStatus measure_all(HdCandidates *candidates, HdError *error) {
    const HdDeviceWish *wish = &candidates->wish;
    bool is_lasting = true;
    HdError ignored; /* next time it is measured again */
    for (int i = 0; i < candidates->compared; i++) {
        HdStatus status = measure_one(candidates, i, error);
        if (status == HD_INTERRUPTED || status == HD_BAD_INPUT)
            return status;
        if (status != HD_OK)
            note_failure(candidates, error->message);
        bool is_passing = status == HD_FAILED || (status != HD_OK && hd_is_loss(error));
        is_lasting = is_lasting && !is_passing;
    }
    if (candidates->best < 0)
        return HD_OK;
    if (is_lasting)
        hd_measured_put(candidates->list, candidates->compared, wish->options, wish->job->scene,
                        &ignored);
    explain_speed(candidates, "");
    return HD_OK;
}

/* ---- opening ---- */

static int find_plain_c(const HdCandidates *candidates) {
    for (int i = 0; i < candidates->compared; i++)
        if (candidates->list[i].device.backend->needs_no_driver)
            return i;
    return -1;
}

static HdStatus choose(HdCandidates *candidates, HdError *error) {
    candidates->best = -1;
    candidates->compared = hd_min(candidates->compared, MAX_COMPARED);
    if (candidates->compared < 2)
        return HD_OK;
    if (recall(candidates)) {
        explain_speed(candidates, ", measured earlier");
        return HD_OK;
    }
    if (job_seconds(candidates) >= HD_AUTO_MEASURE_SECONDS)
        return measure_all(candidates, error);
    candidates->best = find_plain_c(candidates);
    if (candidates->best >= 0)
        snprintf(candidates->why, sizeof candidates->why,
                 "it needs about %.2g s, too little to measure other devices for",
                 job_seconds(candidates));
    return HD_OK;
}

/* The best, else those that follow it, else those before it. Kernels that are compiled for the
   scene must prove themselves first; those compiled ahead get it when it is rendered. */
static HdStatus open_next(HdCandidates *candidates, HdError *error) {
    const HdDeviceWish *wish = &candidates->wish;
    const int first = hd_max(candidates->best, 0);
    const int tries = candidates->is_free ? candidates->count : 1;
    HdStatus status = HD_UNAVAILABLE;
    for (int i = 0; status == HD_UNAVAILABLE && i < tries; i++) {
        candidates->best = (first + i) % candidates->count;
        HdTeamDevice *member = &candidates->list[candidates->best];
        bool is_proven = candidates->is_free && member->device.backend->functions->kernels != NULL;
        status = hd_team_device_open(member, wish->options, wish->job, is_proven, error);
        if (status == HD_UNAVAILABLE)
            note_failure(candidates, error->message);
        if (i > 0 && candidates->compared > 0)
            snprintf(candidates->why, sizeof candidates->why,
                     "the next after one that cannot be used");
    }
    return status;
}

HdStatus hd_candidates_open(HdCandidates *candidates, HdTeamDevice *opened, HdError *error) {
    HdStatus status = choose(candidates, error);
    if (status == HD_OK &&
        (candidates->best < 0 || candidates->list[candidates->best].renderer == NULL))
        status = open_next(candidates, error);
    if (status == HD_OK)
        *opened = candidates->list[candidates->best];
    else if (candidates->best >= 0)
        hd_team_device_close(&candidates->list[candidates->best]);
    return status;
}
