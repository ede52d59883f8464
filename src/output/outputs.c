/* SPDX-License-Identifier: MIT */
#include "output/outputs.h"

#include <limits.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

HdStatus hd_output_check_name(const char *name, const char *option, HdError *error) {
    if (hd_format_of(name) == NULL)
        return hd_fail(error, HD_BAD_INPUT,
                       "%s is '%.4000s', expected the name of a film (" HD_FILM_ENDINGS
                       ") or of a picture (" HD_PICTURE_ENDINGS ")",
                       option, name);
    return HD_OK;
}

static HdStatus settle_output(HdOutput *output, const char *name, const HdPictureStyle *style,
                              int frame_count, HdError *error) {
    const HdFormat *format = hd_format_of(name);
    char file[HD_MAX_PATH];
    *output = (HdOutput){
        .name = name,
        .format = format != NULL ? format : &hd_format_data,
        .is_film = hd_format_is_film(format),
        .is_numbered = !hd_format_is_film(format) && hd_pattern_has_number(name),
    };
    if (output->is_film && hd_pattern_has_directive(name))
        return hd_fail(error, HD_BAD_INPUT,
                       "'%s' asks for numbered films: a film has no number (%%d) in its name, and "
                       " pictures end in " HD_PICTURE_ENDINGS,
                       name);
    HD_TRY(hd_format_check_style(name, style, error));
    if (output->is_film)
        return HD_OK;
    if (output->is_numbered)
        return hd_pattern_check(name, error);
    if (frame_count == 1)
        return hd_pattern_format_single(name, file, error);
    return hd_fail(error, HD_BAD_INPUT,
                   "'%s' names one picture, but %d frames are to be rendered: put #### into the "
                   "name, choose a film such as film.mp4, or choose one frame with --frames",
                   name, frame_count);
}

HdStatus hd_output_name(const HdOutput *output, int number, char out[HD_MAX_PATH], HdError *error) {
    if (output->is_numbered)
        return hd_pattern_format(output->name, number, out, error);
    if (!output->is_film)
        return hd_pattern_format_single(output->name, out, error);
    if (snprintf(out, HD_MAX_PATH, "%s", output->name) >= HD_MAX_PATH)
        return hd_fail(error, HD_BAD_INPUT,
                       "the name of the output has %zu bytes, expected fewer than %d",
                       strlen(output->name), (int)HD_MAX_PATH);
    return HD_OK;
}

HdStatus hd_output_file(const HdOutput *output, int number, char out[HD_MAX_PATH], HdError *error) {
    char expanded[HD_MAX_PATH];
    HD_TRY(hd_output_name(output, number, expanded, error));
    return hd_path_expand_home(expanded, out, error);
}

/* Compares patterns by a high frame number, for "#" and "##" differ only before that. */
static HdStatus check_different(const HdOutput *output, const HdOutput *other, int frame_count,
                                HdError *error) {
    char file[HD_MAX_PATH], other_file[HD_MAX_PATH];
    HD_TRY(hd_output_file(output, frame_count - 1, file, error));
    HD_TRY(hd_output_file(other, frame_count - 1, other_file, error));
    if (!hd_path_is_same(file, other_file))
        return HD_OK;
    if (strcmp(output->name, other->name) == 0)
        return hd_fail(error, HD_BAD_INPUT, "the output '%s' is given twice", output->name);
    return hd_fail(error, HD_BAD_INPUT, "the outputs '%.4000s' and '%.4000s' are the same file",
                   other->name, output->name);
}

static void sum_up(HdOutputPlan *plan) {
    plan->can_resume = true;
    for (int i = 0; i < plan->count; i++) {
        const HdOutput *output = &plan->list[i];
        const HdFormat *format = output->format;
        const bool bears_fingerprints = format->load != NULL;
        plan->film_count += output->is_film;
        plan->bears_fingerprints |= bears_fingerprints;
        const bool has_alpha =
            format->has_layers || (format->has_alpha && plan->style.picture.has_alpha);
        plan->request.radiance |=
            !output->is_film && (has_alpha || plan->style.picture.bits > format->max_encoded_bits);
        plan->request.layers |= has_alpha ? HD_LAYER_BIT(HD_LAYER_ALPHA) : 0;
        plan->has_layers |= format->has_layers;
        /* Only numbered pictures with fingerprints, and films, can save rendering. */
        plan->can_resume &= output->is_film || (bears_fingerprints && output->is_numbered);
    }
}

HdStatus hd_outputs_settle(HdOutputPlan *plan, const char *const *names, int count,
                           const HdOutputStyle *style, int frame_count, HdError *error) {
    *plan = (HdOutputPlan){
        .count = count,
        .style = *style,
        .request = {.curve = style->picture.curve},
        .scene = "",
        .options = "",
        .durability = HD_DURABLE,
    };
    for (int i = 0; i < count; i++) {
        HD_TRY(settle_output(&plan->list[i], names[i], &style->picture, frame_count, error));
        for (int j = 0; j < i; j++)
            HD_TRY(check_different(&plan->list[i], &plan->list[j], frame_count, error));
    }
    sum_up(plan);
    return HD_OK;
}

HdStatus hd_outputs_add_layers(HdOutputPlan *plan, unsigned layers, bool is_bounded,
                               HdError *error) {
    if (layers == 0)
        return HD_OK;
    if (!plan->has_layers)
        return hd_fail(error, HD_BAD_INPUT,
                       "--layers is for OpenEXR: expected an output that ends in .exr");
    if (!is_bounded && (layers & HD_LAYER_BIT(HD_LAYER_BOUND)) != 0)
        return hd_fail(error, HD_BAD_INPUT,
                       "--layers has bound, expected --max-error or --reference with it");
    plan->request.layers |= layers;
    return HD_OK;
}

void hd_outputs_set_fingerprint(HdOutputPlan *plan, uint64_t fingerprint, bool resumes) {
    plan->has_fingerprint = true;
    plan->fingerprint = fingerprint;
    plan->resumes = resumes && plan->can_resume;
}

/* ---- recognising names of frames ---- */

/* A number that differs from 0 in its first digit, however many digits 0 has. */
enum { ALL_ONES = 1111111111, MAX_DIGITS = 10 };

HdStatus hd_frame_names_find(HdFrameNames *names, const HdOutput *output, const HdFrameList *frames,
                             HdError *error) {
    char zero[HD_MAX_PATH], ones[HD_MAX_PATH];
    size_t number = 0;
    names->frames = frames;
    HD_TRY(hd_output_file(output, 0, zero, error));
    HD_TRY(hd_output_file(output, ALL_ONES, ones, error));
    while (zero[number] != '\0' && zero[number] == ones[number])
        number++;
    const char *behind = output->is_numbered ? ones + number + MAX_DIGITS : ones + number;
    names->digits = (int)(strlen(zero) - number - strlen(behind));
    zero[number] = '\0';
    const size_t folder = hd_folder_length(zero), suffix = strcspn(behind, "/");
    snprintf(names->folder, HD_MAX_PATH, "%.*s", (int)folder, zero);
    snprintf(names->prefix, HD_MAX_PATH, "%s", zero + folder);
    snprintf(names->suffix, HD_MAX_PATH, "%.*s", (int)suffix, behind);
    snprintf(names->rest, HD_MAX_PATH, "%s", behind + suffix);
    return HD_OK;
}

static int compare_numbers(const void *a, const void *b) {
    const int left = *(const int *)a, right = *(const int *)b;
    return (left > right) - (left < right);
}

static int find_frame(const HdFrameList *frames, int number) {
    const int *found =
        bsearch(&number, frames->frames, (size_t)frames->count, sizeof number, compare_numbers);
    return found != NULL ? (int)(found - frames->frames) : -1;
}

/* Returns a negative number if these are not the digits as names have them. */
static int read_number(const HdFrameNames *names, const char *text, int digits) {
    int64_t number = 0;
    if (digits > names->digits && text[0] == '0')
        return -1;
    for (int i = 0; i < digits; i++) {
        if (text[i] < '0' || text[i] > '9')
            return -1;
        number = 10 * number + (text[i] - '0');
    }
    return number <= INT_MAX ? (int)number : -1;
}

static bool is_suffix(const HdFrameNames *names, const char *text, size_t length, bool is_cut) {
    const size_t whole = strlen(names->suffix);
    return (is_cut ? length <= whole : length == whole) && memcmp(text, names->suffix, length) == 0;
}

int hd_frame_names_place(const HdFrameNames *names, const char *entry, size_t length, bool is_cut) {
    const size_t before = strlen(names->prefix);
    if (is_cut && length <= before)
        return memcmp(entry, names->prefix, length) == 0 ? 0 : -1;
    if (length < before || memcmp(entry, names->prefix, before) != 0)
        return -1;
    if (names->digits == 0)
        return is_suffix(names, entry + before, length - before, is_cut) ? 0 : -1;
    for (int digits = names->digits; digits <= MAX_DIGITS; digits++) {
        const size_t end = before + (size_t)digits;
        if (end > length)
            return is_cut && read_number(names, entry + before, (int)(length - before)) >= 0 ? 0
                                                                                             : -1;
        const int number = read_number(names, entry + before, digits);
        const int place = number >= 0 ? find_frame(names->frames, number) : -1;
        if (place >= 0 && is_suffix(names, entry + end, length - end, is_cut))
            return place;
    }
    return -1;
}
