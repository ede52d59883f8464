/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "output/outputs.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "image/file_kind.h"
#include "system/atomic_file.h"

struct HdOutputs {
    const HdOutputPlan *plan;
    HdVideo *films[HD_MAX_OUTPUTS]; /* NULL: pictures */
};

HdStatus hd_output_check_name(const char *name, const char *option, HdError *error) {
    if (hd_output_kind(name) == HD_OUTPUT_UNKNOWN)
        return hd_fail(error, HD_BAD_INPUT,
                       "%s is '%.4000s', expected the name of a film (" HD_FILM_ENDINGS
                       ") or of a picture (" HD_PICTURE_ENDINGS ")",
                       option, name);
    return HD_OK;
}

static HdStatus check_output(const char *name, int frame_count, HdError *error) {
    if (hd_name_is_film(name) && hd_pattern_has_number(name))
        return hd_fail(error, HD_BAD_INPUT,
                       "'%s' asks for numbered films: a film has no number (%%d or #) in its name, "
                       "and pictures end in " HD_PICTURE_ENDINGS,
                       name);
    if (hd_name_is_film(name))
        return HD_OK;
    char file[HD_MAX_PATH];
    if (hd_pattern_has_number(name))
        return hd_pattern_check(name, error);
    if (frame_count == 1)
        return hd_pattern_format_single(name, file, error);
    return hd_fail(error, HD_BAD_INPUT,
                   "'%s' names one picture, but %d frames are to be rendered: put #### into the "
                   "name, choose a film such as film.mp4, or choose one frame with --frames",
                   name, frame_count);
}

HdStatus hd_output_name(const char *name, int number, char out[HD_MAX_PATH], HdError *error) {
    if (!hd_name_is_film(name) && hd_pattern_has_number(name))
        return hd_pattern_format(name, number, out, error);
    if (!hd_name_is_film(name))
        return hd_pattern_format_single(name, out, error);
    if (snprintf(out, HD_MAX_PATH, "%s", name) >= HD_MAX_PATH)
        return hd_fail(error, HD_BAD_INPUT,
                       "the name of the output has %zu bytes, expected fewer than %d", strlen(name),
                       (int)HD_MAX_PATH);
    return HD_OK;
}

HdStatus hd_output_file(const char *name, int number, char out[HD_MAX_PATH], HdError *error) {
    char expanded[HD_MAX_PATH];
    HdStatus status = hd_output_name(name, number, expanded, error);
    return status == HD_OK ? hd_path_expand_home(expanded, out, error) : status;
}

/* Patterns are compared by the name of a late frame, for "#" and "##" differ only before that. */
static HdStatus check_different(const char *name, const char *other, int frame_count,
                                HdError *error) {
    char file[HD_MAX_PATH], other_file[HD_MAX_PATH];
    HdStatus status = hd_output_file(name, frame_count - 1, file, error);
    if (status == HD_OK)
        status = hd_output_file(other, frame_count - 1, other_file, error);
    if (status != HD_OK || !hd_path_is_same(file, other_file))
        return status;
    if (strcmp(name, other) == 0)
        return hd_fail(error, HD_BAD_INPUT, "the output '%s' is there twice", name);
    return hd_fail(error, HD_BAD_INPUT, "the outputs '%.4000s' and '%.4000s' are the same file",
                   other, name);
}

HdStatus hd_outputs_check(const HdOutputPlan *plan, int frame_count, HdError *error) {
    HdStatus status = HD_OK;
    for (int i = 0; i < plan->count && status == HD_OK; i++) {
        status = check_output(plan->names[i], frame_count, error);
        for (int j = 0; j < i && status == HD_OK; j++)
            status = check_different(plan->names[i], plan->names[j], frame_count, error);
    }
    return status;
}

static HdStatus open_film(HdOutputs *outputs, int index, int width, int height, HdError *error) {
    char path[HD_MAX_PATH];
    HdStatus status = hd_path_expand_home(outputs->plan->names[index], path, error);
    if (status == HD_OK)
        status = hd_video_open(&outputs->films[index], path, width, height,
                               outputs->plan->style.frames_per_second, error);
    return status;
}

static HdStatus probe_picture(const char *name, int number, HdError *error) {
    char path[HD_MAX_PATH], temporary[HD_MAX_PATH];
    int descriptor;
    HdStatus status = hd_output_file(name, number, path, error);
    if (status == HD_OK)
        status = hd_temporary_create(path, temporary, &descriptor, error);
    if (status != HD_OK)
        return status;
    close(descriptor);
    hd_temporary_remove(temporary);
    return HD_OK;
}

bool hd_outputs_have_png(const HdOutputPlan *plan) {
    for (int i = 0; i < plan->count; i++)
        if (hd_output_kind(plan->names[i]) == HD_OUTPUT_PNG)
            return true;
    return false;
}

static bool needs_radiance(const char *name, int bits) {
    HdOutputKind kind = hd_output_kind(name);
    return kind == HD_OUTPUT_PFM || (kind == HD_OUTPUT_PNG && bits > 8);
}

HdFrameWish hd_outputs_wish(const HdOutputPlan *plan) {
    HdFrameWish wish = {.curve = plan->style.picture.curve};
    for (int i = 0; i < plan->count; i++)
        if (needs_radiance(plan->names[i], plan->style.picture.bits))
            wish.radiance = true;
    return wish;
}

HdStatus hd_outputs_probe(const HdOutputPlan *plan, int first_number, HdError *error) {
    HdStatus status = HD_OK;
    for (int i = 0; i < plan->count && status == HD_OK; i++)
        if (!hd_name_is_film(plan->names[i]))
            status = probe_picture(plan->names[i], first_number, error);
    return status;
}

HdStatus hd_outputs_open(HdOutputs **outputs, const HdOutputPlan *plan, int width, int height,
                         HdError *error) {
    HdStatus status = HD_OK;
    *outputs = calloc(1, sizeof **outputs);
    if (*outputs == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room for the outputs");
    (*outputs)->plan = plan;
    for (int i = 0; i < plan->count && status == HD_OK; i++)
        if (hd_name_is_film(plan->names[i]))
            status = open_film(*outputs, i, width, height, error);
    if (status != HD_OK) {
        hd_outputs_abort(*outputs);
        *outputs = NULL;
    }
    return status;
}

const HdOutputPlan *hd_outputs_plan(const HdOutputs *outputs) {
    return outputs->plan;
}

HdVideo *hd_outputs_film(const HdOutputs *outputs, int index) {
    return outputs->films[index];
}

int hd_outputs_film_count(const HdOutputs *outputs) {
    int count = 0;
    for (int i = 0; i < outputs->plan->count; i++)
        count += outputs->films[i] != NULL;
    return count;
}

HdStatus hd_outputs_close(HdOutputs *outputs, HdError *error) {
    HdStatus status = HD_OK;
    for (int i = 0; i < HD_MAX_OUTPUTS && status == HD_OK; i++) {
        if (outputs->films[i] == NULL)
            continue;
        status = hd_video_close(outputs->films[i], error);
        outputs->films[i] = NULL;
    }
    hd_outputs_abort(outputs);
    return status;
}

void hd_outputs_abort(HdOutputs *outputs) {
    if (outputs == NULL)
        return;
    for (int i = 0; i < HD_MAX_OUTPUTS; i++)
        if (outputs->films[i] != NULL)
            hd_video_abort(outputs->films[i]);
    free(outputs);
}
