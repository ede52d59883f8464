/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "choice/candidates.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* Each reason once, though several devices may have it. */
static void add_reason(HdCandidates *candidates, const char *name, const char *reason) {
    size_t used = strlen(candidates->reasons);
    if (strstr(candidates->reasons, reason) == NULL)
        snprintf(candidates->reasons + used, sizeof candidates->reasons - used, "%s%s: %s",
                 used > 0 ? "; " : "", name, reason);
}

/* A GPU that is there and not used is worth a word, unless the user's own wish rules out all. */
static void tell_passed(HdCandidates *candidates, const char *what, const char *reason,
                        const char *help) {
    const HdDeviceWish *wish = &candidates->wish;
    size_t used = strlen(candidates->passed);
    if (candidates->is_free && wish->kind != HD_ONLY_CPU && wish->options->lanes <= 1)
        snprintf(candidates->passed + used, sizeof candidates->passed - used,
                 "%s%s is passed over: %s%s", used > 0 ? "; " : "", what, reason, help);
}

static void tell_passed_device(HdCandidates *candidates, const HdDevice *device,
                               const char *reason) {
    char what[sizeof device->name + 32];
    bool is_strictness = reason == device->not_strict;
    snprintf(what, sizeof what, "%s:%d (%s)", device->backend->name, device->index, device->name);
    tell_passed(candidates, what, reason,
                is_strictness ? "; --math fast would take it, for other bytes" : "");
}

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
    if (is_number(wish))
        return strtol(wish, NULL, 10) == device->index;
    return contains(device->name, wish);
}

static bool is_in_question(const HdDevice *device, const HdDeviceWish *wish) {
    if (!is_named(device, wish->device))
        return false;
    return !device->is_cpu || device->backend->needs_no_driver || wish->backend != NULL ||
           wish->device != NULL || wish->kind == HD_PREFER_GPU;
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

/* How long plain C takes for a frame. */
static HdStatus estimate(HdCandidates *candidates, double enough, HdError *error) {
    const HdDeviceWish *wish = &candidates->wish;
    return hd_trial_estimate(wish->options, wish->job, enough, &candidates->frame_seconds, error);
}

/* Plain C is asked how long it takes before any driver is: drivers take their time to start. */
static HdStatus estimate_any(HdCandidates *candidates, HdError *error) {
    HdDeviceWish *wish = &candidates->wish;
    HdStatus status = estimate(candidates, HD_AUTO_SMALL_SECONDS, error);
    double seconds = candidates->frame_seconds * wish->job->frame_count;
    if (status != HD_OK || seconds > HD_AUTO_SMALL_SECONDS)
        return status;
    wish->kind = HD_ONLY_CPU;
    snprintf(candidates->why, sizeof candidates->why,
             "it needs about %.2g s, less than other devices take to start", seconds);
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
