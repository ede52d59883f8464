/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "choice/one_device.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "choice/fastest_device.h"
#include "choice/launch.h"

enum { MAX_CANDIDATES = 32 };

typedef struct Search {
    HdDeviceWish wish;
    HdRenderer **renderer; /* what is opened */
    HdDevice *device;
    HdDeviceReason *reason;
    HdDevice candidates[MAX_CANDIDATES]; /* the best first */
    int count;
    char reasons[4096]; /* why backends and devices were passed over */
} Search;

/* Each reason once, though several devices may have it. */
static void add_reason(Search *search, const char *name, const char *reason) {
    size_t used = strlen(search->reasons);
    if (strstr(search->reasons, reason) == NULL)
        snprintf(search->reasons + used, sizeof search->reasons - used, "%s%s: %s",
                 used > 0 ? "; " : "", name, reason);
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

static void add_candidate(Search *search, const HdDevice *device) {
    int place = search->count;
    while (place > 0 && is_better(device, &search->candidates[place - 1]))
        place--;
    if (place == MAX_CANDIDATES)
        return;
    if (search->count < MAX_CANDIDATES)
        search->count++;
    memmove(&search->candidates[place + 1], &search->candidates[place],
            (size_t)(search->count - 1 - place) * sizeof *search->candidates);
    search->candidates[place] = *device;
}

static void consider(Search *search, const HdDevice *device) {
    const char *reason = hd_device_obstacle(device, search->wish.options);
    if (search->wish.kind == HD_ONLY_CPU && !device->is_cpu)
        reason = "it is not a CPU";
    if (reason != NULL)
        add_reason(search, device->name, reason);
    else
        add_candidate(search, device);
}

static void search_backend(Search *search, const HdBackend *backend, HdError *error) {
    HdDevice devices[HD_MAX_DEVICES];
    int count = 0;
    bool any = false;
    if (hd_backend_enumerate(backend, devices, HD_MAX_DEVICES, &count, error) != HD_OK) {
        add_reason(search, backend->name, error->message);
        return;
    }
    for (int i = 0; i < count; i++) {
        if (!is_in_question(&devices[i], &search->wish))
            continue;
        any = true;
        consider(search, &devices[i]);
    }
    if (!any && search->wish.device != NULL)
        add_reason(search, backend->name, "no device of that number or name");
}

static void search_wanted(Search *search, HdError *error) {
    const HdDeviceWish *wish = &search->wish;
    if (wish->backend != NULL)
        search_backend(search, hd_backend_find(wish->backend), error);
    else if (wish->kind == HD_ONLY_CPU)
        search_backend(search, hd_backend_always_there(), error);
    else
        for (int i = 0; i < HD_BACKEND_COUNT; i++)
            search_backend(search, hd_backends[i], error);
}

static const char *choice_reason(const Search *search) {
    const HdDeviceWish *wish = &search->wish;
    if (wish->device != NULL)
        return "named by --device";
    if (wish->backend != NULL)
        return "the best device of the backend named by --backend";
    if (wish->kind == HD_ONLY_CPU)
        return "the C backend, since only a CPU will do";
    if (!search->device->is_cpu)
        return "the first GPU in the order of the backends";
    return "no GPU can do this";
}

/* `why` is "" where nothing better is known than the order of devices. */
static void explain(const Search *search, const char *why) {
    const HdDevice *chosen = search->device;
    HdDeviceReason *reason = search->reason;
    bool has_gpu = !search->candidates[0].is_cpu;
    size_t length = strlen(reason->note);
    if (search->wish.kind == HD_PREFER_GPU && search->wish.backend == NULL && chosen->is_cpu)
        snprintf(reason->note + length, sizeof reason->note - length,
                 "%sno suitable GPU was found; tracing with %s on %s", length > 0 ? "; " : "",
                 chosen->backend->name, chosen->name);
    else if (length > 0)
        snprintf(reason->note + length, sizeof reason->note - length, "; tracing with %s on %s",
                 chosen->backend->name, chosen->name);
    snprintf(reason->why, sizeof reason->why, "%s%s%s",
             why[0] != '\0' && has_gpu ? why : choice_reason(search),
             search->reasons[0] != '\0' ? "; passed over: " : "", search->reasons);
}

static HdStatus search_devices(Search *search, HdError *error) {
    const char *device = search->wish.device;
    search_wanted(search, error);
    if (search->count > 0)
        return HD_OK;
    return hd_fail(error, HD_UNAVAILABLE, "no device can do this%s%s%s: %s%s",
                   device != NULL ? " (asked for device '" : "", device != NULL ? device : "",
                   device != NULL ? "')" : "", search->reasons,
                   device != NULL ? "; see 'hedron devices'" : "");
}

static HdStatus open_found(const Search *search, HdError *error) {
    return hd_launch_open(search->renderer, search->device, search->wish.options,
                          search->wish.job->scene, error);
}

static HdStatus open_best(Search *search, HdError *error) {
    HdStatus status = search_devices(search, error);
    if (status != HD_OK)
        return status;
    *search->device = search->candidates[0];
    explain(search, "");
    return open_found(search, error);
}

/* ---- without a name ---- */

/* How many of the candidates are worth a comparison: the GPUs, and plain C where any will do. */
static int count_compared(const Search *search) {
    int count = 0;
    while (count < search->count &&
           (!search->candidates[count].is_cpu || search->wish.kind == HD_WANT_ANY))
        count++;
    return count;
}

static HdStatus open_fastest(const Search *search, double frame_seconds, HdError *error) {
    char why[1024], note[2048];
    HdAutoChoice choice = {
        .candidates = search->candidates,
        .count = search->count,
        .measured = count_compared(search),
        .options = search->wish.options,
        .job = search->wish.job,
        .frame_seconds = frame_seconds,
    };
    HdStatus status = hd_auto_open(search->renderer, search->device, &choice, why, note, error);
    if (status != HD_OK)
        return status;
    snprintf(search->reason->note, sizeof search->reason->note, "%s", note);
    explain(search, why);
    return HD_OK;
}

static HdStatus open_plain_c(const Search *search, double seconds, HdError *error) {
    int count;
    HdStatus status =
        hd_backend_enumerate(hd_backend_always_there(), search->device, 1, &count, error);
    if (status != HD_OK)
        return status;
    snprintf(search->reason->why, sizeof search->reason->why,
             "it needs about %.2g s, less than other devices take to start", seconds);
    return open_found(search, error);
}

/* Plain C is asked how long it takes before any driver is: drivers take their time to start. */
static HdStatus open_any(Search *search, HdError *error) {
    const HdJob *job = search->wish.job;
    double frame_seconds;
    HdStatus status =
        hd_trial_estimate(search->wish.options, job, HD_AUTO_SMALL_SECONDS, &frame_seconds, error);
    if (status != HD_OK)
        return status;
    double seconds = frame_seconds * job->frame_count;
    if (seconds <= HD_AUTO_SMALL_SECONDS)
        return open_plain_c(search, seconds, error);
    status = search_devices(search, error);
    return status == HD_OK ? open_fastest(search, frame_seconds, error) : status;
}

static HdStatus open_gpu(Search *search, HdError *error) {
    double frame_seconds = 0.0;
    HdStatus status = search_devices(search, error);
    if (status == HD_OK && count_compared(search) > 1)
        status =
            hd_trial_estimate(search->wish.options, search->wish.job, 0.0, &frame_seconds, error);
    return status == HD_OK ? open_fastest(search, frame_seconds, error) : status;
}

static HdStatus open_wanted(Search *search, HdError *error) {
    const HdDeviceWish *wish = &search->wish;
    if (wish->backend != NULL || wish->device != NULL || wish->kind == HD_ONLY_CPU)
        return open_best(search, error);
    return wish->kind == HD_PREFER_GPU ? open_gpu(search, error) : open_any(search, error);
}

bool hd_wish_is_for_several(const HdDeviceWish *wish) {
    return wish->device != NULL &&
           (strcmp(wish->device, "all") == 0 || strchr(wish->device, ',') != NULL);
}

HdStatus hd_open_device(HdRenderer **renderer, HdDevice *device, const HdDeviceWish *wish,
                        HdDeviceReason *reason, HdError *error) {
    *renderer = NULL;
    reason->note[0] = reason->why[0] = '\0';
    if (hd_wish_is_for_several(wish))
        return hd_fail(error, HD_BAD_INPUT, "--device is '%s', expected one device", wish->device);
    Search *search = calloc(1, sizeof *search);
    if (search == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room for a list of devices");
    search->wish = *wish;
    search->renderer = renderer;
    search->device = device;
    search->reason = reason;
    HdStatus status = split_name(&search->wish, error);
    if (status == HD_OK)
        status = open_wanted(search, error);
    free(search);
    return status;
}
