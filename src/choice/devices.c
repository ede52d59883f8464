/* SPDX-License-Identifier: MIT */
#define _GNU_SOURCE
#include "choice/devices.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/minmax.h"
#include "base/text.h"
#include "system/machine.h"

/* ---- reasons ---- */

/* Adds each reason once, though several devices may have it. */
static void add_reason(HdCandidates *candidates, const char *name, const char *reason) {
    if (strstr(candidates->reasons, reason) == NULL)
        hd_add_text(candidates->reasons, sizeof candidates->reasons, "; ", "%s: %s", name, reason);
}

/* Reports an available but unused GPU, unless the user's selection excludes all. */
static void report_unused_gpu(HdCandidates *candidates, const char *what, const char *reason,
                              const char *help) {
    const HdDeviceSelection *selection = &candidates->selection;
    if (candidates->is_free && selection->kind != HD_ONLY_CPU && selection->options->lanes <= 1)
        hd_add_text(candidates->unused_gpus, sizeof candidates->unused_gpus, "; ",
                    "%s is not used: %s%s", what, reason, help);
}

/* ---- names ---- */

static bool is_number(const char *text) {
    return *text != '\0' && text[strspn(text, "0123456789")] == '\0';
}

/* "c:0" names the backend too. */
static HdStatus split_name(HdDeviceSelection *selection, HdError *error) {
    for (int i = 0; i < HD_BACKEND_COUNT && selection->device != NULL; i++) {
        const char *name = hd_backends[i]->name;
        size_t length = strlen(name);
        if (strncmp(selection->device, name, length) != 0 || selection->device[length] != ':' ||
            !is_number(selection->device + length + 1))
            continue;
        if (selection->backend != NULL && strcmp(selection->backend, name) != 0)
            return hd_fail(error, HD_BAD_INPUT, "--device is '%s', but --backend is '%s'",
                           selection->device, selection->backend);
        selection->backend = name;
        selection->device += length + 1;
    }
    return HD_OK;
}

static bool is_named(const HdDevice *device, const char *selection) {
    if (selection == NULL)
        return true;
    return is_number(selection) ? strtol(selection, NULL, 10) == device->index
                                : strcasestr(device->name, selection) != NULL;
}

HdStatus hd_devices_named(const char *backend, const char *device, HdDevice *devices, int *count,
                          HdError *error) {
    bool is_any = device == NULL || strcmp(device, "all") == 0;
    HdCandidates none = {.selection = {.backend = backend, .device = is_any ? NULL : device}};
    *count = 0;
    HD_TRY(split_name(&none.selection, error));
    for (int i = 0; i < HD_BACKEND_COUNT; i++) {
        int found = 0, kept = *count;
        if (none.selection.backend != NULL &&
            strcmp(none.selection.backend, hd_backends[i]->name) != 0)
            continue;
        if (hd_backend_enumerate(hd_backends[i], devices + kept, HD_MAX_DEVICES, &found, error) !=
            HD_OK)
            add_reason(&none, hd_backends[i]->name, error->message);
        for (int d = kept; d < kept + found; d++)
            if (is_named(&devices[d], none.selection.device))
                devices[(*count)++] = devices[d];
        if (found > 0 && *count == kept)
            add_reason(&none, hd_backends[i]->name, "no device of that number or name");
    }
    if (*count == 0)
        return hd_fail(error, HD_UNAVAILABLE, "there is no such device%s%s%s: %s",
                       device != NULL ? " ('" : "", device != NULL ? device : "",
                       device != NULL ? "')" : "", none.reasons);
    return HD_OK;
}

/* ---- finding ---- */

static bool is_eligible(const HdDevice *device, const HdDeviceSelection *selection) {
    return is_named(device, selection->device) &&
           (!device->is_cpu || device->backend->needs_no_driver || selection->backend != NULL ||
            selection->device != NULL || selection->kind == HD_PREFER_GPU);
}

/* Ranks devices; `other` was found earlier, in the same or an earlier backend. */
static bool is_better(const HdDevice *device, const HdDevice *other) {
    if (device->is_cpu != other->is_cpu)
        return other->is_cpu;
    return device->backend == other->backend &&
           (double)device->compute_units * (double)device->clock_mhz >
               (double)other->compute_units * (double)other->clock_mhz;
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
    const char *reason = hd_device_unsupported_reason(device, candidates->selection.options);
    char what[sizeof device->name + 32];
    if (candidates->selection.kind == HD_ONLY_CPU && !device->is_cpu)
        reason = "it is not a CPU";
    if (reason == NULL) {
        add_candidate(candidates, device);
        return;
    }
    snprintf(what, sizeof what, "%s:%d (%s)", device->backend->name, device->index, device->name);
    if (!device->is_cpu)
        report_unused_gpu(
            candidates, what, reason,
            reason == device->not_strict ? "; --math fast would take it, for other bytes" : "");
    add_reason(candidates, device->name, reason);
}

static void search_backend(HdCandidates *candidates, const HdBackend *backend, HdError *error) {
    HdDevice devices[HD_MAX_DEVICES];
    int count = 0;
    bool any = false;
    HdStatus status = hd_backend_enumerate(backend, devices, HD_MAX_DEVICES, &count, error);
    if (status == HD_FAILED)
        report_unused_gpu(candidates, backend->name, error->message, "");
    if (status != HD_OK) {
        add_reason(candidates, backend->name, error->message);
        return;
    }
    for (int i = 0; i < count; i++) {
        if (!is_eligible(&devices[i], &candidates->selection))
            continue;
        any = true;
        consider(candidates, &devices[i]);
    }
    if (!any && candidates->selection.device != NULL)
        add_reason(candidates, backend->name, "no device of that number or name");
}

static void search(HdCandidates *candidates, HdError *error) {
    const HdDeviceSelection *selection = &candidates->selection;
    if (selection->backend != NULL)
        search_backend(candidates, hd_backend_find(selection->backend), error);
    else if (selection->kind == HD_ONLY_CPU)
        search_backend(candidates, hd_backend_always_there(), error);
    else
        for (int i = 0; i < HD_BACKEND_COUNT; i++)
            search_backend(candidates, hd_backends[i], error);
}

/* Counts the candidates to compare: the GPUs, and plain C if any device will do. */
static int count_compared(const HdCandidates *candidates) {
    int count = 0;
    while (count < candidates->count &&
           (!candidates->list[count].device.is_cpu || candidates->selection.kind == HD_WANT_ANY))
        count++;
    return count;
}

/* Estimates the seconds per frame of plain C, without the texture: uploading it takes longer than
   rendering a small picture and affects that little. */
static HdStatus estimate(HdCandidates *candidates, double enough, HdError *error) {
    const HdTrialRequest selection = hd_trial_request(enough);
    HdScene plain = *candidates->selection.job->scene;
    HdJob job = *candidates->selection.job;
    HdDevice device;
    HdRenderer *renderer;
    HdTrial trial;
    plain.floor.texture = (HdTexture){0};
    job.scene = &plain;
    HD_TRY(hd_find_plain_device(&device, error));
    HD_TRY(hd_trial_open(&renderer, &device, candidates->selection.options, &job, error));
    HdStatus status = hd_trial(renderer, &job, &selection, &trial, error);
    candidates->frame_seconds = trial.frame_seconds;
    hd_renderer_close(renderer);
    return status;
}

static double job_seconds(const HdCandidates *candidates) {
    return candidates->frame_seconds * candidates->selection.job->frame_count;
}

/* Estimates plain C before any driver starts, which takes a while. */
static HdStatus estimate_any(HdCandidates *candidates, HdError *error) {
    HD_TRY(estimate(candidates, HD_AUTO_SMALL_SECONDS, error));
    if (job_seconds(candidates) > HD_AUTO_SMALL_SECONDS)
        return HD_OK;
    candidates->selection.kind = HD_ONLY_CPU;
    snprintf(candidates->why, sizeof candidates->why,
             "it needs about %.2g s, less than other devices take to start",
             job_seconds(candidates));
    return HD_OK;
}

HdStatus hd_candidates_find(HdCandidates *candidates, const HdDeviceSelection *selection,
                            HdError *error) {
    memset(candidates, 0, sizeof *candidates);
    candidates->selection = *selection;
    candidates->is_free =
        selection->backend == NULL && selection->device == NULL && selection->kind != HD_ONLY_CPU;
    HD_TRY(split_name(&candidates->selection, error));
    if (candidates->is_free && selection->kind == HD_WANT_ANY)
        HD_TRY(estimate_any(candidates, error));
    search(candidates, error);
    const char *device = candidates->selection.device;
    if (candidates->count == 0)
        return hd_fail(error, HD_UNAVAILABLE, "no device can do this%s%s%s: %s%s",
                       device != NULL ? " (asked for device '" : "", device != NULL ? device : "",
                       device != NULL ? "')" : "", candidates->reasons,
                       device != NULL ? "; see 'hedron devices'" : "");
    if (candidates->is_free)
        candidates->compared = count_compared(candidates);
    return candidates->compared > 1 && selection->kind == HD_PREFER_GPU
               ? estimate(candidates, 0.0, error)
               : HD_OK;
}

/* ---- comparing ---- */

enum { MAX_COMPARED = 16 };

static bool is_faster(const HdCandidates *candidates, int index) {
    const HdTeamDevice *list = candidates->list;
    return isfinite(list[index].seconds) &&
           (candidates->best < 0 || list[index].seconds < list[candidates->best].seconds);
}

/* Returns false if nothing was measured earlier, or no device works. */
static bool load_measured(HdCandidates *candidates) {
    const HdDeviceSelection *selection = &candidates->selection;
    if (!hd_measured_get(candidates->list, candidates->compared, selection->options,
                         selection->job->scene))
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

/* Measures a picture so small that plain C renders it in a tenth of a second; the first of two
   frames warms up. Keeps the fastest device so far open. */
static HdStatus measure_one(HdCandidates *candidates, int index, HdError *error) {
    const double seconds = 0.1;
    const HdDeviceSelection *selection = &candidates->selection;
    const HdTrialRequest how = {.share = fmin(1.0, seconds / candidates->frame_seconds),
                                .times = 2};
    HdTeamDevice *member = &candidates->list[index];
    HdTrial trial;
    HdStatus status = hd_team_device_open(member, selection->options, selection->job, true, error);
    if (status == HD_OK)
        status = hd_trial(member->renderer, selection->job, &how, &trial, error);
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

/* Remembers nothing if a device failed at work, for it may succeed another time. */
static HdStatus measure_all(HdCandidates *candidates, HdError *error) {
    const HdDeviceSelection *selection = &candidates->selection;
    bool is_lasting = true;
    HdError ignored; /* the next run measures again */
    for (int i = 0; i < candidates->compared; i++) {
        HdStatus status = measure_one(candidates, i, error);
        if (status == HD_INTERRUPTED || status == HD_BAD_INPUT)
            return status;
        if (status != HD_OK)
            hd_add_text(candidates->note, sizeof candidates->note, "; ", "%.600s", error->message);
        bool is_temporary = status == HD_FAILED || (status != HD_OK && hd_is_loss(error));
        is_lasting = is_lasting && !is_temporary;
    }
    if (candidates->best < 0)
        return HD_OK;
    if (is_lasting)
        hd_measured_put(candidates->list, candidates->compared, selection->options,
                        selection->job->scene, &ignored);
    explain_speed(candidates, "");
    return HD_OK;
}

/* ---- opening ---- */

static HdStatus choose(HdCandidates *candidates, HdError *error) {
    candidates->best = -1;
    candidates->compared = hd_min(candidates->compared, MAX_COMPARED);
    if (candidates->compared < 2)
        return HD_OK;
    if (load_measured(candidates)) {
        explain_speed(candidates, ", measured earlier");
        return HD_OK;
    }
    if (job_seconds(candidates) >= HD_AUTO_MEASURE_SECONDS)
        return measure_all(candidates, error);
    for (int i = 0; candidates->best < 0 && i < candidates->compared; i++)
        if (candidates->list[i].device.backend->needs_no_driver)
            candidates->best = i;
    if (candidates->best >= 0)
        snprintf(candidates->why, sizeof candidates->why,
                 "it needs about %.2g s, too little to measure other devices for",
                 job_seconds(candidates));
    return HD_OK;
}

/* Tries the best, then those after it, then those before it. Kernels compiled for the scene must
   first pass their self-test; others get the scene when it is rendered. */
static HdStatus open_next(HdCandidates *candidates, HdError *error) {
    const HdDeviceSelection *selection = &candidates->selection;
    const int first = hd_max(candidates->best, 0);
    const int tries = candidates->is_free ? candidates->count : 1;
    HdStatus status = HD_UNAVAILABLE;
    for (int i = 0; status == HD_UNAVAILABLE && i < tries; i++) {
        candidates->best = (first + i) % candidates->count;
        HdTeamDevice *member = &candidates->list[candidates->best];
        bool is_proven = candidates->is_free && member->device.backend->functions->kernels != NULL;
        status = hd_team_device_open(member, selection->options, selection->job, is_proven, error);
        if (status == HD_UNAVAILABLE)
            hd_add_text(candidates->note, sizeof candidates->note, "; ", "%.600s", error->message);
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

void hd_close_devices(HdDeviceTeam *team) {
    for (; team->count > 0; team->count--)
        hd_team_device_close(&team->list[team->count - 1]);
}

/* ---- a team of one ---- */

static const char *choice_reason(const HdDeviceSelection *selection, const HdDevice *chosen) {
    if (selection->device != NULL)
        return "named by --device";
    if (selection->backend != NULL)
        return "the best device of the backend named by --backend";
    if (selection->kind == HD_ONLY_CPU)
        return "the C backend, since only a CPU will do";
    if (!chosen->is_cpu)
        return "the first GPU in the order of the backends";
    return "no GPU can do this";
}

static void explain(HdDeviceTeam *team, const HdCandidates *candidates) {
    const HdDeviceSelection *selection = &candidates->selection;
    const HdDevice *chosen = &team->list[team->count - 1].device;
    const char *note = candidates->note, *why = candidates->why;
    /* Another backend may have the same card. */
    if (note[0] == '\0' && strstr(candidates->unused_gpus, chosen->name) == NULL)
        note = candidates->unused_gpus;
    const bool is_wrong = strstr(candidates->reasons, "computes wrongly") != NULL &&
                          strstr(note, "computes wrongly") == NULL;
    if (selection->kind == HD_PREFER_GPU && selection->backend == NULL && chosen->is_cpu)
        snprintf(team->note, sizeof team->note,
                 "%s%sno suitable GPU was found%s%.1500s; tracing with %s on %s", note,
                 note[0] != '\0' ? "; " : "", is_wrong ? ": " : "",
                 is_wrong ? candidates->reasons : "", chosen->backend->name, chosen->name);
    else if (note[0] != '\0')
        snprintf(team->note, sizeof team->note, "%s; tracing with %s on %s", note,
                 chosen->backend->name, chosen->name);
    snprintf(team->why, sizeof team->why, "%s%s%s",
             why[0] != '\0' ? why : choice_reason(selection, chosen),
             candidates->reasons[0] != '\0' ? "; not used: " : "", candidates->reasons);
}

static HdStatus open_one(HdDeviceTeam *team, const HdDeviceSelection *selection, HdError *error) {
    HdCandidates candidates;
    team->note[0] = team->why[0] = '\0';
    HD_TRY(hd_candidates_find(&candidates, selection, error));
    HD_TRY(hd_candidates_open(&candidates, &team->list[team->count], error));
    team->count++;
    explain(team, &candidates);
    return HD_OK;
}

/* ---- a team by a list ---- */

static HdStatus check_entry(const HdDeviceTeam *team, const HdDeviceSelection *selection,
                            const char *entry, HdError *error) {
    if (entry[0] == '\0')
        return hd_fail(error, HD_BAD_INPUT,
                       "--device is '%s', which has an empty part, expected a list such as "
                       "cuda:0,cuda:1,c:0",
                       selection->device);
    if (strcmp(entry, "all") == 0)
        return hd_fail(error, HD_BAD_INPUT, "--device is '%s', expected 'all' without others",
                       selection->device);
    if (team->count == HD_MAX_WORKERS)
        return hd_fail(error, HD_BAD_INPUT, "--device names more than %d devices",
                       (int)HD_MAX_WORKERS);
    return HD_OK;
}

static HdStatus check_new(const HdDeviceTeam *team, const HdDeviceSelection *selection,
                          HdError *error) {
    const HdDevice *last = &team->list[team->count - 1].device;
    for (const HdTeamDevice *other = team->list; &other->device < last; other++)
        if (other->device.backend == last->backend && other->device.index == last->index)
            return hd_fail(error, HD_BAD_INPUT, "--device is '%s', which names %s:%d (%s) twice",
                           selection->device, last->backend->name, last->index, last->name);
    return HD_OK;
}

static HdStatus open_entry(HdDeviceTeam *team, const HdDeviceSelection *selection,
                           const char *entry, HdError *error) {
    HdDeviceSelection one = *selection;
    one.device = entry;
    HD_TRY(check_entry(team, selection, entry, error));
    HD_TRY(open_one(team, &one, error));
    return check_new(team, selection, error);
}

static HdStatus open_list(HdDeviceTeam *team, const HdDeviceSelection *selection, HdError *error) {
    HdStatus status = HD_OK;
    char *copy = strdup(selection->device), *rest = copy;
    if (copy == NULL)
        return HD_NO_ROOM(error, "a list of devices");
    while (status == HD_OK && rest != NULL) {
        char *entry = rest, *comma = strchr(rest, ',');
        rest = comma != NULL ? comma + 1 : NULL;
        if (comma != NULL)
            *comma = '\0';
        status = open_entry(team, selection, entry, error);
    }
    free(copy);
    return status;
}

/* ---- a team of all ---- */

/* Returns whether the team has the device's GPU by CUDA. */
static bool is_there_already(const HdDeviceTeam *team, const HdDevice *device) {
    for (int i = 0; i < team->count; i++)
        if (device->nvidia_arch > 0 && team->list[i].device.backend != device->backend &&
            strcmp(team->list[i].device.name, device->name) == 0)
            return true;
    return false;
}

static bool is_wanted(const HdDeviceTeam *team, const HdDeviceSelection *selection,
                      const HdDevice *device) {
    if (team->count == HD_MAX_WORKERS || is_there_already(team, device))
        return false;
    if (!device->is_cpu)
        return selection->kind != HD_ONLY_CPU;
    return device->backend->needs_no_driver || selection->backend != NULL;
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

/* Fails only with HD_INTERRUPTED; omits a device that cannot be opened. */
static HdStatus add_device(HdDeviceTeam *team, const HdDevice *device,
                           const HdDeviceSelection *selection, HdError *error) {
    const HdRenderOptions own = options_of(team, device, selection->options);
    const char *unsupported_reason = hd_device_unsupported_reason(device, &own);
    if (unsupported_reason == NULL) {
        HdTeamDevice *member = &team->list[team->count];
        *member = (HdTeamDevice){.device = *device};
        HdStatus status = hd_team_device_open(member, &own, selection->job, false, error);
        team->count += status == HD_OK;
        if (status == HD_OK || status == HD_INTERRUPTED)
            return status;
        unsupported_reason = error->message;
    }
    hd_add_text(team->note, sizeof team->note, "; ", "%s:%d (%s) is left out: %s",
                device->backend->name, device->index, device->name, unsupported_reason);
    return HD_OK;
}

static HdStatus add_backend(HdDeviceTeam *team, const HdBackend *backend,
                            const HdDeviceSelection *selection, HdError *error) {
    HdDevice devices[HD_MAX_DEVICES];
    int count = 0;
    /* Missing backends are normal. */
    if (hd_backend_enumerate(backend, devices, HD_MAX_DEVICES, &count, error) != HD_OK &&
        selection->backend != NULL)
        snprintf(team->note, sizeof team->note, "%s: %.*s", backend->name,
                 (int)sizeof team->note / 2, error->message);
    for (int i = 0; i < count; i++)
        if (is_wanted(team, selection, &devices[i]))
            HD_TRY(add_device(team, &devices[i], selection, error));
    return HD_OK;
}

static HdStatus open_all(HdDeviceTeam *team, const HdDeviceSelection *selection, HdError *error) {
    for (int i = 0; i < HD_BACKEND_COUNT; i++)
        if (selection->backend == NULL || strcmp(selection->backend, hd_backends[i]->name) == 0)
            HD_TRY(add_backend(team, hd_backends[i], selection, error));
    snprintf(team->why, sizeof team->why, "one of all, by --device");
    if (team->count == 0)
        return hd_fail(error, HD_UNAVAILABLE, "no device can do this: %s",
                       team->note[0] != '\0' ? team->note : "none is there");
    return HD_OK;
}

/* ---- any team ---- */

static HdStatus open_wanted(HdDeviceTeam *team, const HdDeviceSelection *selection,
                            HdError *error) {
    bool is_all = selection->device != NULL && strcmp(selection->device, "all") == 0;
    bool is_list = selection->device != NULL && strchr(selection->device, ',') != NULL;
    if (!is_all && !is_list)
        return open_one(team, selection, error);
    if (selection->is_for_one)
        return hd_fail(error, HD_BAD_INPUT, "--device is '%s', expected one device",
                       selection->device);
    return is_all ? open_all(team, selection, error) : open_list(team, selection, error);
}

HdStatus hd_open_devices(HdDeviceTeam *team, const HdDeviceSelection *selection, HdError *error) {
    memset(team, 0, sizeof *team);
    HdStatus status = open_wanted(team, selection, error);
    if (status != HD_OK)
        hd_close_devices(team);
    return status;
}
