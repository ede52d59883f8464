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

/* Each reason once; a backend's own reason begins with its name already. */
static void add_reason(Search *search, const char *name, const char *reason) {
    size_t used = strlen(search->reasons), length = strlen(name);
    bool is_named = strncmp(reason, name, length) == 0 && reason[length] == ':';
    if (strstr(search->reasons, reason) != NULL)
        return;
    snprintf(search->reasons + used, sizeof search->reasons - used, "%s%s%s%s",
             used > 0 ? "; " : "", is_named ? "" : name, is_named ? "" : ": ", reason);
}

static bool contains(const char *text, const char *part) {
    size_t length = strlen(part);
    for (; *text != '\0'; text++)
        if (strncasecmp(text, part, length) == 0)
            return true;
    return length == 0;
}

static bool is_wanted(const HdDevice *device, const char *wish) {
    if (wish == NULL)
        return true;
    char *end;
    long number = strtol(wish, &end, 10);
    if (end != wish && *end == '\0')
        return number == device->index;
    return contains(device->name, wish);
}

static const char *why_unfit(const HdDevice *device, const HdRenderOptions *options) {
    if (options->math == HD_MATH_STRICT && device->not_strict[0] != '\0')
        return device->not_strict;
    if (options->precision == HD_DOUBLE_PRECISION && !device->has_double)
        return "the device has no double precision";
    if (options->lanes > 1 && !device->is_cpu)
        return "several lanes need a CPU";
    return NULL;
}

/* GPUs before CPUs, then the one that promises more. */
static double preference(const HdDevice *device) {
    double speed = (double)device->compute_units * (double)device->clock_mhz;
    return (device->is_cpu ? 0.0 : 1e9) + speed;
}

static void consider(Search *search, const HdDevice *device) {
    if (!is_wanted(device, search->wish->device))
        return;
    const char *reason = search->wish->cpu && !device->is_cpu ? "it is not a CPU"
                                                              : why_unfit(device, search->options);
    if (reason != NULL) {
        add_reason(search, device->name, reason);
        return;
    }
    if (!search->found || preference(device) > preference(&search->best)) {
        search->best = *device;
        search->found = true;
    }
}

static void search_backend(Search *search, const HdBackend *backend, bool gpus_only) {
    HdDevice devices[HD_MAX_DEVICES];
    static HdError error;
    int count = 0;
    if (backend->enumerate(devices, HD_MAX_DEVICES, &count, &error) != HD_OK) {
        add_reason(search, backend->name, error.message);
        return;
    }
    for (int i = 0; i < count; i++)
        if (!gpus_only || !devices[i].is_cpu)
            consider(search, &devices[i]);
    if (!search->found && search->wish->device != NULL && !gpus_only)
        add_reason(search, backend->name, "no device of that number or name");
}

static void search_any(Search *search, char note[512]) {
    search_backend(search, hd_backend_find("cuda"), true);
    if (!search->found)
        search_backend(search, hd_backend_find("opencl"), true);
    bool has_gpu = search->found;
    if (!search->found && (search->wish->gpu || search->wish->device != NULL))
        search_backend(search, hd_backend_find("opencl"), false);
    if (!search->found)
        search_backend(search, hd_backend_find("c"), false);
    if (search->found && !has_gpu && search->wish->gpu)
        snprintf(note, 512, "no suitable GPU was found; tracing with %s on %s",
                 search->best.backend->name, search->best.name);
}

HdStatus hd_choose_device(HdDevice *device, const HdDeviceWish *wish,
                          const HdRenderOptions *options, char note[512], HdError *error) {
    Search search = {.wish = wish, .options = options};
    note[0] = '\0';
    if (wish->backend != NULL)
        search_backend(&search, hd_backend_find(wish->backend), false);
    else
        search_any(&search, note);
    if (!search.found)
        return hd_fail(error, HD_UNAVAILABLE, "no device can do this%s%s%s: %s",
                       wish->device ? " (asked for device '" : "", wish->device ? wish->device : "",
                       wish->device ? "')" : "", search.reasons);
    *device = search.best;
    return HD_OK;
}
