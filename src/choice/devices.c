/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "choice/devices.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "choice/launch.h"
#include "system/machine.h"

void hd_close_devices(HdDeviceTeam *team) {
    for (; team->count > 0; team->count--)
        hd_renderer_close(team->renderers[team->count - 1]);
}

static int gpu_count(const HdDeviceTeam *team) {
    int count = 0;
    for (int i = 0; i < team->count; i++)
        count += !team->devices[i].is_cpu;
    return count;
}

/* ---- a list ---- */

static HdStatus check_entry(const HdDeviceWish *wish, const char *entry, HdError *error) {
    if (entry[0] == '\0')
        return hd_fail(error, HD_BAD_INPUT,
                       "--device is '%s', which has an empty part, expected a list such as "
                       "cuda:0,cuda:1,c:0",
                       wish->device);
    if (strcmp(entry, "all") == 0)
        return hd_fail(error, HD_BAD_INPUT, "--device is '%s', but 'all' stands alone",
                       wish->device);
    return HD_OK;
}

static HdStatus check_new(const HdDeviceTeam *team, const HdDeviceWish *wish, HdError *error) {
    const HdDevice *last = &team->devices[team->count - 1];
    for (int i = 0; i + 1 < team->count; i++)
        if (team->devices[i].backend == last->backend && team->devices[i].index == last->index)
            return hd_fail(error, HD_BAD_INPUT, "--device is '%s', which names %s:%d (%s) twice",
                           wish->device, last->backend->name, last->index, last->name);
    return HD_OK;
}

static HdStatus open_entry(HdDeviceTeam *team, const HdDeviceWish *wish, const char *entry,
                           HdDeviceReason *reason, HdError *error) {
    HdDeviceWish one = *wish;
    one.device = entry;
    HdStatus status = check_entry(wish, entry, error);
    if (status == HD_OK && team->count == HD_MOST_TRACERS)
        status = hd_fail(error, HD_BAD_INPUT, "--device names more than %d devices",
                         (int)HD_MOST_TRACERS);
    if (status == HD_OK)
        status = hd_open_device(&team->renderers[team->count], &team->devices[team->count], &one,
                                reason, error);
    if (status != HD_OK)
        return status;
    team->count++;
    return check_new(team, wish, error);
}

static HdStatus open_list(HdDeviceTeam *team, const HdDeviceWish *wish, HdDeviceReason *reason,
                          HdError *error) {
    HdStatus status = HD_OK;
    char *copy = strdup(wish->device), *rest = copy;
    if (copy == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room for a list of devices");
    while (status == HD_OK && rest != NULL) {
        char *entry = rest, *comma = strchr(rest, ',');
        rest = comma != NULL ? comma + 1 : NULL;
        if (comma != NULL)
            *comma = '\0';
        status = open_entry(team, wish, entry, reason, error);
    }
    free(copy);
    return status;
}

/* ---- all ---- */

/* OpenCL has the GPUs that CUDA has. */
static bool is_there_already(const HdDeviceTeam *team, const HdDevice *device) {
    for (int i = 0; i < team->count; i++)
        if (device->nvidia_arch > 0 && team->devices[i].backend != device->backend &&
            strcmp(team->devices[i].name, device->name) == 0)
            return true;
    return false;
}

static bool is_wanted(const HdDeviceTeam *team, const HdDeviceWish *wish, const HdDevice *device) {
    if (team->count == HD_MOST_TRACERS || is_there_already(team, device))
        return false;
    if (!device->is_cpu)
        return wish->kind != HD_ONLY_CPU;
    return device->backend->needs_no_driver || wish->backend != NULL;
}

static void note_left_out(HdDeviceReason *reason, const HdDevice *device, const char *obstacle) {
    size_t length = strlen(reason->note);
    snprintf(reason->note + length, sizeof reason->note - length, "%s%s:%d (%s) is left out: %s",
             length > 0 ? "; " : "", device->backend->name, device->index, device->name, obstacle);
}

static HdRenderOptions options_of(const HdDeviceTeam *team, const HdDevice *device,
                                  const HdRenderOptions *options) {
    HdRenderOptions own = *options;
    int left = hd_processor_count() - gpu_count(team);
    if (device->backend->uses_host_threads && own.threads == 0 && gpu_count(team) > 0)
        own.threads = left > 1 ? left : 1;
    return own;
}

static HdStatus add_device(HdDeviceTeam *team, const HdDevice *device, const HdDeviceWish *wish,
                           HdDeviceReason *reason, HdError *error) {
    const char *obstacle = hd_device_obstacle(device, wish->options);
    HdRenderOptions own = options_of(team, device, wish->options);
    if (obstacle != NULL) {
        note_left_out(reason, device, obstacle);
        return HD_OK;
    }
    HdStatus status =
        hd_launch_open(&team->renderers[team->count], device, &own, wish->job->scene, error);
    if (status == HD_INTERRUPTED)
        return status;
    if (status == HD_OK)
        team->devices[team->count++] = *device;
    else
        note_left_out(reason, device, error->message);
    return HD_OK;
}

static HdStatus add_backend(HdDeviceTeam *team, const HdBackend *backend, const HdDeviceWish *wish,
                            HdDeviceReason *reason, HdError *error) {
    HdDevice *devices = calloc(HD_MAX_DEVICES, sizeof *devices);
    int count = 0;
    if (devices == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room for a list of devices");
    HdStatus status = HD_OK;
    /* Nobody need have every backend. */
    if (hd_backend_enumerate(backend, devices, HD_MAX_DEVICES, &count, error) != HD_OK &&
        wish->backend != NULL)
        snprintf(reason->note, sizeof reason->note, "%s: %.*s", backend->name,
                 (int)sizeof reason->note / 2, error->message);
    for (int i = 0; i < count && status == HD_OK; i++)
        if (is_wanted(team, wish, &devices[i]))
            status = add_device(team, &devices[i], wish, reason, error);
    free(devices);
    return status;
}

static HdStatus open_all(HdDeviceTeam *team, const HdDeviceWish *wish, HdDeviceReason *reason,
                         HdError *error) {
    HdStatus status = HD_OK;
    for (int i = 0; i < HD_BACKEND_COUNT && status == HD_OK; i++)
        if (wish->backend == NULL || strcmp(wish->backend, hd_backends[i]->name) == 0)
            status = add_backend(team, hd_backends[i], wish, reason, error);
    snprintf(reason->why, sizeof reason->why, "one of all, by --device");
    if (status == HD_OK && team->count == 0)
        return hd_fail(error, HD_UNAVAILABLE, "no device can do this: %s",
                       reason->note[0] != '\0' ? reason->note : "none is there");
    return status;
}

HdStatus hd_open_devices(HdDeviceTeam *team, const HdDeviceWish *wish, HdDeviceReason *reason,
                         HdError *error) {
    HdStatus status;
    memset(team, 0, sizeof *team);
    reason->note[0] = reason->why[0] = '\0';
    if (!hd_wish_is_for_several(wish)) {
        status = hd_open_device(&team->renderers[0], &team->devices[0], wish, reason, error);
        team->count = status == HD_OK ? 1 : 0;
    } else if (strcmp(wish->device, "all") == 0) {
        status = open_all(team, wish, reason, error);
    } else {
        status = open_list(team, wish, reason, error);
    }
    if (status != HD_OK)
        hd_close_devices(team);
    return status;
}
