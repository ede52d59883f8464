/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "device_choice.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

typedef struct Search {
    const HdDeviceWish *wish;
    const HdRenderOptions *options;
    HdDevice best;
    bool found;
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

static const HdBackend *plain_c(void) {
    return hd_backends[HD_BACKEND_COUNT - 1];
}

static bool is_in_question(const HdDevice *device, const HdDeviceWish *wish) {
    if (!is_named(device, wish->device))
        return false;
    return !device->is_cpu || device->backend == plain_c() || wish->backend != NULL ||
           wish->device != NULL || wish->kind == HD_PREFER_GPU;
}

static double speed(const HdDevice *device) {
    return (double)device->compute_units * (double)device->clock_mhz;
}

/* `best` was found earlier, in the same backend or in one that comes first. */
static bool is_better(const HdDevice *device, const HdDevice *best) {
    if (device->is_cpu != best->is_cpu)
        return best->is_cpu;
    return device->backend == best->backend && speed(device) > speed(best);
}

static void consider(Search *search, const HdDevice *device) {
    const char *reason = hd_device_obstacle(device, search->options);
    if (search->wish->kind == HD_ONLY_CPU && !device->is_cpu)
        reason = "it is not a CPU";
    if (reason != NULL) {
        add_reason(search, device->name, reason);
    } else if (!search->found || is_better(device, &search->best)) {
        search->best = *device;
        search->found = true;
    }
}

static void search_backend(Search *search, const HdBackend *backend, HdError *error) {
    HdDevice devices[HD_MAX_DEVICES];
    int count = 0;
    bool any = false;
    if (backend->enumerate(devices, HD_MAX_DEVICES, &count, error) != HD_OK) {
        add_reason(search, backend->name, error->message);
        return;
    }
    for (int i = 0; i < count; i++) {
        if (!is_in_question(&devices[i], search->wish))
            continue;
        any = true;
        consider(search, &devices[i]);
    }
    if (!any && search->wish->device != NULL)
        add_reason(search, backend->name, "no device of that number or name");
}

/* A later backend is not asked once there is a GPU: drivers take their time to start. */
static void search_all(Search *search, HdError *error) {
    for (int i = 0; i < HD_BACKEND_COUNT; i++) {
        search_backend(search, hd_backends[i], error);
        if (search->found && !search->best.is_cpu)
            return;
    }
}

static void search_wanted(Search *search, HdError *error) {
    const HdDeviceWish *wish = search->wish;
    if (wish->backend != NULL)
        search_backend(search, hd_backend_find(wish->backend), error);
    else if (wish->kind == HD_ONLY_CPU)
        search_backend(search, plain_c(), error);
    else
        search_all(search, error);
}

static const char *choice_reason(const Search *search) {
    const HdDeviceWish *wish = search->wish;
    if (wish->device != NULL)
        return "named by --device";
    if (wish->backend != NULL)
        return "the best device of the backend named by --backend";
    if (wish->kind == HD_ONLY_CPU)
        return "the C backend, since only a CPU will do";
    if (!search->best.is_cpu)
        return "the first GPU in the order of the backends";
    return "no GPU can do this";
}

static void explain(const Search *search, HdDeviceReason *reason) {
    const HdDevice *best = &search->best;
    reason->note[0] = '\0';
    if (search->wish->kind == HD_PREFER_GPU && search->wish->backend == NULL && best->is_cpu)
        snprintf(reason->note, sizeof reason->note,
                 "no suitable GPU was found; tracing with %s on %s", best->backend->name,
                 best->name);
    snprintf(reason->why, sizeof reason->why, "%s%s%s", choice_reason(search),
             search->reasons[0] != '\0' ? "; passed over: " : "", search->reasons);
}

HdStatus hd_choose_device(HdDevice *device, const HdDeviceWish *wish,
                          const HdRenderOptions *options, HdDeviceReason *reason, HdError *error) {
    HdDeviceWish split = *wish;
    Search search = {.wish = &split, .options = options};
    HdStatus status = split_name(&split, error);
    if (status != HD_OK)
        return status;
    search_wanted(&search, error);
    if (!search.found)
        return hd_fail(error, HD_UNAVAILABLE, "no device can do this%s%s%s: %s%s",
                       wish->device ? " (asked for device '" : "", wish->device ? wish->device : "",
                       wish->device ? "')" : "", search.reasons,
                       wish->device ? "; see 'hedron devices'" : "");
    *device = search.best;
    explain(&search, reason);
    return HD_OK;
}
