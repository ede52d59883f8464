/* SPDX-License-Identifier: MIT */
#include "output/outputs.h"

#include <stdio.h>
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
        .is_numbered = hd_pattern_has_number(name),
    };
    if (output->is_film && output->is_numbered)
        return hd_fail(error, HD_BAD_INPUT,
                       "'%s' asks for numbered films: a film has no number (%%d or #) in its name, "
                       "and pictures end in " HD_PICTURE_ENDINGS,
                       name);
    const HdStatus status = hd_format_check_style(name, style, error);
    if (output->is_film || status != HD_OK)
        return status;
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
    HdStatus status = hd_output_name(output, number, expanded, error);
    return status == HD_OK ? hd_path_expand_home(expanded, out, error) : status;
}

/* Patterns are compared by the name of a late frame, for "#" and "##" differ only before that. */
static HdStatus check_different(const HdOutput *output, const HdOutput *other, int frame_count,
                                HdError *error) {
    char file[HD_MAX_PATH], other_file[HD_MAX_PATH];
    HdStatus status = hd_output_file(output, frame_count - 1, file, error);
    if (status == HD_OK)
        status = hd_output_file(other, frame_count - 1, other_file, error);
    if (status != HD_OK || !hd_path_is_same(file, other_file))
        return status;
    if (strcmp(output->name, other->name) == 0)
        return hd_fail(error, HD_BAD_INPUT, "the output '%s' is there twice", output->name);
    return hd_fail(error, HD_BAD_INPUT, "the outputs '%.4000s' and '%.4000s' are the same file",
                   other->name, output->name);
}

/* Pictures must be rendered anyway but numbered ones with fingerprints. */
static void sum_up(HdOutputPlan *plan) {
    const int bits = plan->style.picture.bits;
    int sequences = 0;
    for (int i = 0; i < plan->count; i++) {
        const HdOutput *output = &plan->list[i];
        plan->film_count += output->is_film;
        const bool bears_fingerprints = output->format->load != NULL;
        plan->bears_fingerprints |= bears_fingerprints;
        plan->wish.radiance |= !output->is_film && bits > output->format->most_encoded_bits;
        plan->wish.layers |= output->format->has_layers ? HD_LAYER_BIT(HD_LAYER_ALPHA) : 0;
        sequences += bears_fingerprints && output->is_numbered;
    }
    plan->can_resume = sequences + plan->film_count == plan->count;
}

HdStatus hd_outputs_settle(HdOutputPlan *plan, const char *const *names, int count,
                           const HdOutputStyle *style, int frame_count, HdError *error) {
    HdStatus status = HD_OK;
    *plan = (HdOutputPlan){
        .count = count,
        .style = *style,
        .wish = {.curve = style->picture.curve},
        .scene = "",
        .options = "",
    };
    for (int i = 0; i < count && status == HD_OK; i++) {
        status = settle_output(&plan->list[i], names[i], &style->picture, frame_count, error);
        for (int j = 0; j < i && status == HD_OK; j++)
            status = check_different(&plan->list[i], &plan->list[j], frame_count, error);
    }
    if (status == HD_OK)
        sum_up(plan);
    return status;
}

HdStatus hd_outputs_add_layers(HdOutputPlan *plan, unsigned layers, bool is_surveyed,
                               HdError *error) {
    if (layers == 0)
        return HD_OK;
    if (plan->wish.layers == 0)
        return hd_fail(error, HD_BAD_INPUT,
                       "--layers is for OpenEXR: expected an output that ends in .exr");
    if (!is_surveyed && (layers & HD_LAYER_BIT(HD_LAYER_BOUND)) != 0)
        return hd_fail(error, HD_BAD_INPUT,
                       "--layers has bound, which is known with --max-error, --aa adaptive or "
                       "--reference alone");
    plan->wish.layers |= layers;
    return HD_OK;
}

void hd_outputs_set_fingerprint(HdOutputPlan *plan, uint64_t fingerprint, bool resumes) {
    plan->has_fingerprint = plan->bears_fingerprints;
    plan->keeps_films = true;
    plan->fingerprint = fingerprint;
    plan->resumes = resumes && plan->can_resume;
}
