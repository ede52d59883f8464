/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "choice/fastest_device.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "choice/launch.h"
#include "system/cache_folder.h"

enum { MAX_COMPARED = 16, KEY_LENGTH = 1 << 14, WHY_LENGTH = 1024, NOTE_LENGTH = 2048 };

static const char record_kind[] = "choice";

typedef struct Choosing {
    const HdAutoChoice *choice;
    int compared;
    double seconds[MAX_COMPARED]; /* for the same picture; infinite: it failed */
    bool failed[MAX_COMPARED];
    int best;             /* -1: none yet */
    HdRenderer *renderer; /* of the best, where it was measured */
    char *why, *note;
} Choosing;

/* ---- the record of an earlier measurement ---- */

static void write_key(const Choosing *choosing, char key[KEY_LENGTH]) {
    const HdAutoChoice *choice = choosing->choice;
    hd_job_kind(choice->job->scene, choice->options, key, KEY_LENGTH);
    size_t length = strlen(key);
    for (int i = 0; i < choosing->compared && length < KEY_LENGTH; i++) {
        const HdDevice *device = &choice->candidates[i];
        length +=
            (size_t)snprintf(key + length, KEY_LENGTH - length, "%s %d %s (%s)\n",
                             device->backend->name, device->index, device->name, device->driver);
    }
}

static void write_record(const Choosing *choosing) {
    char key[KEY_LENGTH], text[MAX_COMPARED * 32] = "";
    size_t length = 0;
    HdError ignored; /* next time it is measured again */
    write_key(choosing, key);
    for (int i = 0; i < choosing->compared && length < sizeof text; i++)
        length += (size_t)snprintf(text + length, sizeof text - length, "%.9f\n",
                                   choosing->failed[i] ? -1.0 : choosing->seconds[i]);
    hd_cache_put_text(record_kind, key, text, &ignored);
}

static void find_best(Choosing *choosing) {
    choosing->best = -1;
    for (int i = 0; i < choosing->compared; i++)
        if (!choosing->failed[i] &&
            (choosing->best < 0 || choosing->seconds[i] < choosing->seconds[choosing->best]))
            choosing->best = i;
}

/* False where there is no record, or one that makes no sense. */
static bool read_record(Choosing *choosing) {
    char key[KEY_LENGTH], text[MAX_COMPARED * 32];
    HdError ignored;
    write_key(choosing, key);
    if (hd_cache_get_text(record_kind, key, text, sizeof text, &ignored) != HD_OK)
        return false;
    char *line = text, *end = text;
    for (int i = 0; i < choosing->compared; i++, line = end) {
        choosing->seconds[i] = strtod(line, &end);
        if (end == line || !isfinite(choosing->seconds[i]))
            return false;
        choosing->failed[i] = choosing->seconds[i] <= 0.0;
    }
    find_best(choosing);
    return choosing->best >= 0;
}

/* ---- reasons ---- */

static void explain_speed(const Choosing *choosing, const char *when) {
    const HdAutoChoice *choice = choosing->choice;
    int length = snprintf(choosing->why, WHY_LENGTH, "the fastest of %d on this kind of scene%s",
                          choosing->compared, when);
    for (int i = 0; i < choosing->compared && length < WHY_LENGTH; i++)
        if (i != choosing->best && !choosing->failed[i])
            length += snprintf(choosing->why + length, (size_t)(WHY_LENGTH - length),
                               ", %.3g ms against %.3g ms (%s %d)",
                               1e3 * choosing->seconds[choosing->best], 1e3 * choosing->seconds[i],
                               choice->candidates[i].backend->name, choice->candidates[i].index);
}

static void note_failure(const Choosing *choosing, const char *message) {
    size_t length = strlen(choosing->note);
    snprintf(choosing->note + length, NOTE_LENGTH - length, "%s%.600s", length > 0 ? "; " : "",
             message);
}

/* ---- measuring ---- */

/* So small a picture that plain C renders it in a tenth of a second. */
static double share_to_measure(const HdAutoChoice *choice) {
    const double seconds = 0.1;
    return choice->frame_seconds > seconds ? seconds / choice->frame_seconds : 1.0;
}

static HdStatus open_trial(HdRenderer **renderer, const HdAutoChoice *choice, int index,
                           HdError *error) {
    const HdDevice *device = &choice->candidates[index];
    HdRenderOptions options =
        hd_launch_remembered_options(device, choice->options, choice->job->scene);
    return hd_trial_open(renderer, device, &options, choice->job, error);
}

/* The first of two frames warms up. */
static HdStatus measure_one(Choosing *choosing, int index, HdError *error) {
    const HdAutoChoice *choice = choosing->choice;
    HdRenderer *renderer = NULL;
    HdTrialTime time;
    HdStatus status = open_trial(&renderer, choice, index, error);
    if (status == HD_OK)
        status = hd_trial_measure(renderer, choice->options->precision, choice->job,
                                  share_to_measure(choice), 2, &time, error);
    choosing->failed[index] = status != HD_OK;
    if (status == HD_OK)
        choosing->seconds[index] = time.seconds;
    int before = choosing->best;
    if (status == HD_OK && (before < 0 || choosing->seconds[index] < choosing->seconds[before])) {
        HdRenderer *slower = choosing->renderer;
        choosing->renderer = renderer;
        choosing->best = index;
        renderer = slower;
    }
    hd_renderer_close(renderer);
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
            note_failure(choosing, error->message);
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
        if (choosing->choice->candidates[i].backend->needs_no_driver)
            return i;
    return -1;
}

static HdStatus choose(Choosing *choosing, HdError *error) {
    const HdAutoChoice *choice = choosing->choice;
    double seconds = choice->frame_seconds * choice->job->frame_count;
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
        snprintf(choosing->why, WHY_LENGTH,
                 "it needs about %.2g s, too little to measure other devices for", seconds);
    return HD_OK;
}

/* Kernels that are compiled for the scene must prove themselves first; those compiled ahead get it
   when it is rendered. */
static HdStatus open_candidate(Choosing *choosing, int index, HdError *error) {
    const HdAutoChoice *choice = choosing->choice;
    const HdDevice *device = &choice->candidates[index];
    if (device->backend->functions->kernels == NULL)
        return hd_launch_open(&choosing->renderer, device, choice->options, choice->job->scene,
                              error);
    return open_trial(&choosing->renderer, choice, index, error);
}

/* The candidate, else those that follow it, else those before it. */
static HdStatus open_next(Choosing *choosing, HdError *error) {
    const HdAutoChoice *choice = choosing->choice;
    int first = choosing->best >= 0 ? choosing->best : 0;
    HdStatus status = HD_UNAVAILABLE;
    for (int i = 0; status == HD_UNAVAILABLE && i < choice->count; i++) {
        choosing->best = (first + i) % choice->count;
        status = open_candidate(choosing, choosing->best, error);
        if (status == HD_UNAVAILABLE)
            note_failure(choosing, error->message);
        if (status == HD_UNAVAILABLE || i > 0)
            snprintf(choosing->why, WHY_LENGTH, "the next after one that cannot be used");
    }
    return status;
}

HdStatus hd_auto_open(HdRenderer **renderer, HdDevice *device, const HdAutoChoice *choice,
                      char why[1024], char note[2048], HdError *error) {
    Choosing choosing = {
        .choice = choice,
        .compared = choice->measured < MAX_COMPARED ? choice->measured : MAX_COMPARED,
        .best = -1,
        .why = why,
        .note = note,
    };
    why[0] = note[0] = '\0';
    *renderer = NULL;
    HdStatus status = choose(&choosing, error);
    if (status == HD_OK && choosing.renderer == NULL)
        status = open_next(&choosing, error);
    if (status != HD_OK) {
        hd_renderer_close(choosing.renderer);
        return status;
    }
    *renderer = choosing.renderer;
    *device = choice->candidates[choosing.best];
    return HD_OK;
}
