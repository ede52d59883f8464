/* SPDX-License-Identifier: MIT */
#include "cli/option_values.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "image/file_kind.h"
#include "scene/scene.h"

static size_t digits(const char *text) {
    return strspn(text, "0123456789");
}

/* "1", "0.5", ".5" and "1e-3": what strtod takes beyond it is no number on a command line. */
static bool is_decimal(const char *text) {
    size_t whole = digits(text), fraction = 0;
    text += whole;
    if (*text == '.') {
        fraction = digits(text + 1);
        text += 1 + fraction;
    }
    if (*text == 'e' || *text == 'E') {
        text += 1 + (text[1] == '-' || text[1] == '+');
        if (digits(text) == 0)
            return false;
        text += digits(text);
    }
    return whole + fraction > 0 && *text == '\0';
}

static HdStatus parse_integer(const HdOptionSpec *spec, const char *text, int *out,
                              HdError *error) {
    char *end;
    errno = 0;
    long value = strtol(text, &end, 10);
    if (digits(text) == 0 || *end != '\0' || errno != 0 || value < spec->least ||
        value > spec->most)
        return hd_fail(error, HD_BAD_INPUT, "%s is '%s', expected a whole number from %d to %d",
                       spec->name, text, spec->least, spec->most);
    *out = (int)value;
    return HD_OK;
}

static HdStatus parse_block(const HdOptionSpec *spec, const char *text, int *out, HdError *error) {
    HdStatus status = parse_integer(spec, text, out, error);
    if (status == HD_OK && *out % HD_BLOCK_STEP != 0)
        return hd_fail(error, HD_BAD_INPUT, "%s is '%s', expected a multiple of %d", spec->name,
                       text, (int)HD_BLOCK_STEP);
    return status;
}

static HdStatus parse_size(const HdOptionSpec *spec, const char *text, HdOptions *options,
                           HdError *error) {
    char *end;
    errno = 0;
    long width = strtol(text, &end, 10), height = 0;
    bool good = digits(text) > 0 && (*end == 'x' || *end == 'X') && end[1] >= '0' && end[1] <= '9';
    if (good) {
        height = strtol(end + 1, &end, 10);
        good = *end == '\0' && errno == 0 && width >= 1 && width <= HD_MAX_IMAGE_SIDE &&
               height >= 1 && height <= HD_MAX_IMAGE_SIDE;
    }
    if (!good)
        return hd_fail(error, HD_BAD_INPUT,
                       "%s is '%s', expected WIDTHxHEIGHT such as 640x480, each 1 to %d",
                       spec->name, text, (int)HD_MAX_IMAGE_SIDE);
    options->width = (int)width;
    options->height = (int)height;
    return HD_OK;
}

static HdStatus parse_fraction(const HdOptionSpec *spec, const char *text, double *out,
                               HdError *error) {
    double value = is_decimal(text) ? strtod(text, NULL) : -1.0;
    if (!(value >= 0.0 && value < 1.0))
        return hd_fail(error, HD_BAD_INPUT, "%s is '%s', expected a number from 0 to below 1",
                       spec->name, text);
    *out = value;
    return HD_OK;
}

/* Of errors, from `least` to all that a picture can be off by. */
static HdStatus parse_steps(const HdOptionSpec *spec, const char *text, double least, double *out,
                            HdError *error) {
    double value = is_decimal(text) ? strtod(text, NULL) : -1.0;
    if (!(value >= least && value <= HD_MAX_ERROR))
        return hd_fail(error, HD_BAD_INPUT, "%s is '%s', expected a number from %g to %g",
                       spec->name, text, least, HD_MAX_ERROR);
    *out = value;
    return HD_OK;
}

/* The next number of a crop, which ends with the character `end`. */
static bool take_number(const char **text, char end, int least, int *out) {
    char *rest;
    errno = 0;
    if (digits(*text) == 0)
        return false;
    long value = strtol(*text, &rest, 10);
    if (*rest != end || errno != 0 || value < least || value > HD_MAX_IMAGE_SIDE)
        return false;
    *out = (int)value;
    *text = end != '\0' ? rest + 1 : rest;
    return true;
}

static HdStatus parse_crop(const HdOptionSpec *spec, const char *text, HdOptions *options,
                           HdError *error) {
    const char *rest = text;
    if (take_number(&rest, 'x', 1, &options->crop.width) &&
        take_number(&rest, '+', 1, &options->crop.height) &&
        take_number(&rest, '+', 0, &options->crop.left) &&
        take_number(&rest, '\0', 0, &options->crop.top))
        return HD_OK;
    return hd_fail(error, HD_BAD_INPUT,
                   "%s is '%s', expected WIDTHxHEIGHT+X+Y such as 64x64+320+200", spec->name, text);
}

static HdStatus parse_choice(const HdOptionSpec *spec, const char *text, int *number,
                             HdError *error) {
    char list[256];
    const char *meant = NULL;
    *number = hd_option_choice(spec->choices, text);
    if (*number >= 0)
        return HD_OK;
    hd_option_list_choices(spec->choices, list, sizeof list);
    size_t length = hd_option_completed(spec->choices, text, &meant);
    if (length > 0)
        return hd_fail(error, HD_BAD_INPUT, "%s is '%s', expected %s; did you mean '%.*s'?",
                       spec->name, text, list, (int)length, meant);
    return hd_fail(error, HD_BAD_INPUT, "%s is '%s', expected %s", spec->name, text, list);
}

static HdStatus parse_text(const HdOptionSpec *spec, const char *text, const char *expected,
                           const char **out, HdError *error) {
    if (text[0] == '\0')
        return hd_fail(error, HD_BAD_INPUT, "%s is empty, expected %s", spec->name, expected);
    *out = text;
    return HD_OK;
}

static HdStatus add_output(const HdOptionSpec *spec, const char *text, HdOptions *options,
                           HdError *error) {
    int most = options->command == HD_COMMAND_RENDER ? (int)HD_MAX_OUTPUTS : 1;
    if (options->output_count == most)
        return hd_fail(error, HD_BAD_INPUT, "%s '%.4000s' is one too many, expected at most %d",
                       spec->name, text, most);
    HdStatus status = options->command == HD_COMMAND_RENDER
                          ? hd_output_check_name(text, spec->name, error)
                          : HD_OK;
    if (status == HD_OK)
        status = parse_text(spec, text, "the name of a file",
                            &options->outputs[options->output_count], error);
    if (status == HD_OK)
        options->output_count++;
    return status;
}

static HdStatus set_diff(const HdOptionSpec *spec, const char *text, HdOptions *options,
                         HdError *error) {
    if (hd_output_kind(text) != HD_OUTPUT_PNG)
        return hd_fail(error, HD_BAD_INPUT, "%s is '%s', expected a name that ends in .png",
                       spec->name, text);
    options->diff = text;
    return HD_OK;
}

static HdStatus add_change(const HdOptionSpec *spec, const char *text, HdOptions *options,
                           HdError *error) {
    const char *equals = strchr(text, '=');
    if (equals == NULL || equals == text)
        return hd_fail(error, HD_BAD_INPUT,
                       "%s is '%s', expected PATH=VALUE such as camera.field_of_view=40",
                       spec->name, text);
    if (options->change_count == HD_MAX_CHANGES)
        return hd_fail(error, HD_BAD_INPUT, "%s '%s' is one too many, expected at most %d",
                       spec->name, text, (int)HD_MAX_CHANGES);
    options->changes[options->change_count++] = text;
    return HD_OK;
}

static HdStatus set_mode(HdOptions *options, HdClassicMode mode, HdError *error) {
    if (options->mode != HD_CLASSIC_UNSAID && options->mode != mode)
        return hd_fail(error, HD_BAD_INPUT, "only one of --gpu, --cpu and --default may be given");
    options->mode = mode;
    return HD_OK;
}

static HdStatus set_flag(bool *flag, const bool *opposite, HdError *error) {
    *flag = true;
    if (opposite != NULL && *opposite)
        return hd_fail(error, HD_BAD_INPUT, "only one of --verbose and --quiet may be given");
    return HD_OK;
}

static void set_curve(HdOptions *options, HdCurve curve) {
    options->has_curve = true;
    options->curve = curve;
}

static HdStatus apply_choice(HdOptions *options, const HdOptionSpec *spec, const char *value,
                             HdError *error) {
    static const int lanes[] = {1, 4, 8, 16};
    int number = 0;
    HdStatus status = parse_choice(spec, value, &number, error);
    if (status != HD_OK)
        return status;
    if (spec->id == HD_OPTION_BACKEND)
        options->backend = number == 0 ? NULL : value;
    else if (spec->id == HD_OPTION_LANES)
        options->render.lanes = lanes[number];
    else if (spec->id == HD_OPTION_PIPELINE)
        options->render.pipeline = (HdPipeline)number;
    else if (spec->id == HD_OPTION_AA)
        options->sampling = number == 0 ? HD_SAMPLING_GRID : HD_SAMPLING_ADAPTIVE;
    else if (spec->id == HD_OPTION_GEOMETRY)
        options->geometry = number == 0 ? HD_GEOMETRY_SOLIDS : HD_GEOMETRY_TRIANGLES;
    else if (spec->id == HD_OPTION_ACCEL)
        options->accel = (HdAccel)number;
    else if (spec->id == HD_OPTION_CURVE)
        set_curve(options, (HdCurve)number);
    else if (spec->id == HD_OPTION_PRECISION)
        options->render.precision = number == 0 ? HD_PRECISION_FLOAT : HD_PRECISION_DOUBLE;
    else
        options->render.math = number == 0 ? HD_MATH_STRICT : HD_MATH_FAST;
    return HD_OK;
}

static HdStatus ask_for_help(HdOptions *options) {
    options->help_topic.command = options->command;
    options->command = HD_COMMAND_HELP;
    return HD_OK;
}

HdStatus hd_option_apply(HdOptions *options, const HdOptionSpec *spec, const char *value,
                         HdError *error) {
    switch (spec->id) {
    case HD_OPTION_GPU:
        return set_mode(options, HD_CLASSIC_GPU, error);
    case HD_OPTION_CPU:
        return set_mode(options, HD_CLASSIC_CPU, error);
    case HD_OPTION_DEFAULT:
        return set_mode(options, HD_CLASSIC_PRINT, error);
    case HD_OPTION_VARIANT:
        return parse_integer(spec, value, &options->variant, error);
    case HD_OPTION_OUTPUT:
        return add_output(spec, value, options, error);
    case HD_OPTION_SET:
        return add_change(spec, value, options, error);
    case HD_OPTION_FRAMES:
        options->frames = value;
        return HD_OK;
    case HD_OPTION_SIZE:
        return parse_size(spec, value, options, error);
    case HD_OPTION_SAMPLES:
        return parse_integer(spec, value, &options->samples, error);
    case HD_OPTION_DEPTH:
        return parse_integer(spec, value, &options->depth, error);
    case HD_OPTION_CUTOFF:
        return parse_fraction(spec, value, &options->cutoff, error);
    case HD_OPTION_CROP:
        return parse_crop(spec, value, options, error);
    case HD_OPTION_MAX_ERROR:
        return parse_steps(spec, value, HD_LEAST_ERROR, &options->max_error, error);
    case HD_OPTION_REFERENCE:
        return set_flag(&options->reference, NULL, error);
    case HD_OPTION_DIVISIONS:
        return parse_integer(spec, value, &options->divisions, error);
    case HD_OPTION_DEVICE:
        return parse_text(spec, value, "a number, BACKEND:NUMBER or part of a name",
                          &options->device, error);
    case HD_OPTION_THREADS:
        return parse_integer(spec, value, &options->render.threads, error);
    case HD_OPTION_BLOCK:
        return parse_block(spec, value, &options->render.block, error);
    case HD_OPTION_GRID:
        return parse_integer(spec, value, &options->render.grid, error);
    case HD_OPTION_BACKEND:
    case HD_OPTION_PIPELINE:
    case HD_OPTION_LANES:
    case HD_OPTION_AA:
    case HD_OPTION_GEOMETRY:
    case HD_OPTION_ACCEL:
    case HD_OPTION_PRECISION:
    case HD_OPTION_MATH:
    case HD_OPTION_CURVE:
        return apply_choice(options, spec, value, error);
    case HD_OPTION_STATS:
        return parse_text(spec, value, "a file or -", &options->statistics, error);
    case HD_OPTION_AGAIN:
        return set_flag(&options->again, NULL, error);
    case HD_OPTION_VERBOSE:
        return set_flag(&options->verbose, &options->quiet, error);
    case HD_OPTION_QUIET:
        return set_flag(&options->quiet, &options->verbose, error);
    case HD_OPTION_FRAME_LINES:
        return set_flag(&options->tells_frames, NULL, error);
    case HD_OPTION_SCHEMA:
        return set_flag(&options->schema, NULL, error);
    case HD_OPTION_JSON:
        return set_flag(&options->json, NULL, error);
    case HD_OPTION_DIFF:
        return set_diff(spec, value, options, error);
    case HD_OPTION_FAIL_ABOVE:
        return parse_steps(spec, value, 0.0, &options->fail_above, error);
    case HD_OPTION_HELP:
        return ask_for_help(options);
    case HD_OPTION_VERSION:
        options->command = HD_COMMAND_VERSION;
        return HD_OK;
    }
    return HD_OK;
}
