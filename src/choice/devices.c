/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "choice/devices.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/minmax.h"
#include "base/text.h"
#include "system/machine.h"

void hd_close_devices(HdDeviceTeam *team) {
    for (; team->count > 0; team->count--)
        hd_team_device_close(&team->list[team->count - 1]);
}

/* ---- one ---- */

static const char *choice_reason(const HdDeviceWish *wish, const HdDevice *chosen) {
    if (wish->device != NULL)
        return "named by --device";
    if (wish->backend != NULL)
        return "the best device of the backend named by --backend";
    if (wish->kind == HD_ONLY_CPU)
        return "the C backend, since only a CPU will do";
    if (!chosen->is_cpu)
        return "the first GPU in the order of the backends";
    return "no GPU can do this";
}

static void explain(HdDeviceTeam *team, const HdCandidates *candidates) {
    const HdDeviceWish *wish = &candidates->wish;
    const HdDevice *chosen = &team->list[team->count - 1].device;
    const char *note = candidates->note, *why = candidates->why;
    /* Another backend may have the same card. */
    if (note[0] == '\0' && strstr(candidates->passed, chosen->name) == NULL)
        note = candidates->passed;
    const bool is_wrong = strstr(candidates->reasons, "computes wrongly") != NULL &&
                          strstr(note, "computes wrongly") == NULL;
    if (wish->kind == HD_PREFER_GPU && wish->backend == NULL && chosen->is_cpu)
        snprintf(team->note, sizeof team->note,
                 "%s%sno suitable GPU was found%s%.1500s; tracing with %s on %s", note,
                 note[0] != '\0' ? "; " : "", is_wrong ? ": " : "",
                 is_wrong ? candidates->reasons : "", chosen->backend->name, chosen->name);
    else if (note[0] != '\0')
        snprintf(team->note, sizeof team->note, "%s; tracing with %s on %s", note,
                 chosen->backend->name, chosen->name);
    snprintf(team->why, sizeof team->why, "%s%s%s",
             why[0] != '\0' ? why : choice_reason(wish, chosen),
             candidates->reasons[0] != '\0' ? "; passed over: " : "", candidates->reasons);
}

static HdStatus open_one(HdDeviceTeam *team, const HdDeviceWish *wish, HdError *error) {
    HdCandidates candidates;
    team->note[0] = team->why[0] = '\0';
    HdStatus status = hd_candidates_find(&candidates, wish, error);
    if (status == HD_OK)
        status = hd_candidates_open(&candidates, &team->list[team->count], error);
    if (status != HD_OK)
        return status;
    team->count++;
    explain(team, &candidates);
    return HD_OK;
}

/* ---- a list ---- */

static HdStatus check_entry(const HdDeviceTeam *team, const HdDeviceWish *wish, const char *entry,
                            HdError *error) {
    if (entry[0] == '\0')
        return hd_fail(error, HD_BAD_INPUT,
                       "--device is '%s', which has an empty part, expected a list such as "
                       "cuda:0,cuda:1,c:0",
                       wish->device);
    if (strcmp(entry, "all") == 0)
        return hd_fail(error, HD_BAD_INPUT, "--device is '%s', but 'all' stands alone",
                       wish->device);
    if (team->count == HD_MOST_TRACERS)
        return hd_fail(error, HD_BAD_INPUT, "--device names more than %d devices",
                       (int)HD_MOST_TRACERS);
    return HD_OK;
}

static HdStatus check_new(const HdDeviceTeam *team, const HdDeviceWish *wish, HdError *error) {
    const HdDevice *last = &team->list[team->count - 1].device;
    for (const HdTeamDevice *other = team->list; &other->device < last; other++)
        if (other->device.backend == last->backend && other->device.index == last->index)
            return hd_fail(error, HD_BAD_INPUT, "--device is '%s', which names %s:%d (%s) twice",
                           wish->device, last->backend->name, last->index, last->name);
    return HD_OK;
}

static HdStatus open_entry(HdDeviceTeam *team, const HdDeviceWish *wish, const char *entry,
                           HdError *error) {
    HdDeviceWish one = *wish;
    one.device = entry;
    HdStatus status = check_entry(team, wish, entry, error);
    if (status == HD_OK)
        status = open_one(team, &one, error);
    return status == HD_OK ? check_new(team, wish, error) : status;
}

static HdStatus open_list(HdDeviceTeam *team, const HdDeviceWish *wish, HdError *error) {
    HdStatus status = HD_OK;
    char *copy = strdup(wish->device), *rest = copy;
    if (copy == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room for a list of devices");
    while (status == HD_OK && rest != NULL) {
        char *entry = rest, *comma = strchr(rest, ',');
        rest = comma != NULL ? comma + 1 : NULL;
        if (comma != NULL)
            *comma = '\0';
        status = open_entry(team, wish, entry, error);
    }
    free(copy);
    return status;
}

/* ---- all ---- */

/* OpenCL has the GPUs that CUDA has. */
static bool is_there_already(const HdDeviceTeam *team, const HdDevice *device) {
    for (int i = 0; i < team->count; i++)
        if (device->nvidia_arch > 0 && team->list[i].device.backend != device->backend &&
            strcmp(team->list[i].device.name, device->name) == 0)
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

static HdRenderOptions options_of(const HdDeviceTeam *team, const HdDevice *device,
                                  const HdRenderOptions *options) {
    HdRenderOptions own = *options;
    int gpus = 0;
    for (int i = 0; i < team->count; i++)
        gpus += !team->list[i].device.is_cpu;
    if (device->backend->uses_host_threads && own.threads == 0 && gpus > 0)
        own.threads = hd_max(hd_processor_count() - gpus, 1);
    return own;
}

/* Fails with HD_INTERRUPTED alone: what else cannot be opened is left out. */
static HdStatus add_device(HdDeviceTeam *team, const HdDevice *device, const HdDeviceWish *wish,
                           HdError *error) {
    const HdRenderOptions own = options_of(team, device, wish->options);
    const char *obstacle = hd_device_obstacle(device, &own);
    if (obstacle == NULL) {
        HdTeamDevice *member = &team->list[team->count];
        *member = (HdTeamDevice){.device = *device};
        HdStatus status = hd_team_device_open(member, &own, wish->job, false, error);
        team->count += status == HD_OK;
        if (status == HD_OK || status == HD_INTERRUPTED)
            return status;
        obstacle = error->message;
    }
    hd_add_text(team->note, sizeof team->note, "; ", "%s:%d (%s) is left out: %s",
                device->backend->name, device->index, device->name, obstacle);
    return HD_OK;
}

static HdStatus add_backend(HdDeviceTeam *team, const HdBackend *backend, const HdDeviceWish *wish,
                            HdError *error) {
    HdDevice devices[HD_MAX_DEVICES];
    int count = 0;
    HdStatus status = HD_OK;
    /* Nobody need have every backend. */
    if (hd_backend_enumerate(backend, devices, HD_MAX_DEVICES, &count, error) != HD_OK &&
        wish->backend != NULL)
        snprintf(team->note, sizeof team->note, "%s: %.*s", backend->name,
                 (int)sizeof team->note / 2, error->message);
    for (int i = 0; i < count && status == HD_OK; i++)
        if (is_wanted(team, wish, &devices[i]))
            status = add_device(team, &devices[i], wish, error);
    return status;
}

static HdStatus open_all(HdDeviceTeam *team, const HdDeviceWish *wish, HdError *error) {
    HdStatus status = HD_OK;
    for (int i = 0; i < HD_BACKEND_COUNT && status == HD_OK; i++)
        if (wish->backend == NULL || strcmp(wish->backend, hd_backends[i]->name) == 0)
            status = add_backend(team, hd_backends[i], wish, error);
    snprintf(team->why, sizeof team->why, "one of all, by --device");
    if (status == HD_OK && team->count == 0)
        return hd_fail(error, HD_UNAVAILABLE, "no device can do this: %s",
                       team->note[0] != '\0' ? team->note : "none is there");
    return status;
}

/* ---- any of these ---- */

static HdStatus open_wanted(HdDeviceTeam *team, const HdDeviceWish *wish, HdError *error) {
    bool is_all = wish->device != NULL && strcmp(wish->device, "all") == 0;
    bool is_list = wish->device != NULL && strchr(wish->device, ',') != NULL;
    if (!is_all && !is_list)
        return open_one(team, wish, error);
    if (wish->is_for_one)
        return hd_fail(error, HD_BAD_INPUT, "--device is '%s', expected one device", wish->device);
    return is_all ? open_all(team, wish, error) : open_list(team, wish, error);
}

HdStatus hd_open_devices(HdDeviceTeam *team, const HdDeviceWish *wish, HdError *error) {
    memset(team, 0, sizeof *team);
    team->precision = wish->options->precision;
    HdStatus status = open_wanted(team, wish, error);
    if (status != HD_OK)
        hd_close_devices(team);
    return status;
}
