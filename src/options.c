/* SPDX-License-Identifier: MIT */
#include "options.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "classic_input.h"
#include "output_kind.h"
#include "scene.h"

typedef enum OptionId {
    OPTION_GPU,
    OPTION_CPU,
    OPTION_DEFAULT,
    OPTION_VARIANT,
    OPTION_OUTPUT,
    OPTION_BACKEND,
    OPTION_DEVICE,
    OPTION_LANES,
    OPTION_THREADS,
    OPTION_PRECISION,
    OPTION_MATH,
    OPTION_FRAMES,
    OPTION_SIZE,
    OPTION_SAMPLES,
    OPTION_DEPTH,
    OPTION_CUTOFF,
    OPTION_HELP,
    OPTION_VERSION
} OptionId;

typedef struct OptionSpec {
    OptionId id;
    const char *name;
    const char *short_name; /* NULL: none */
    const char *value;      /* what stands for the value in the help; NULL: takes none */
    unsigned commands;
    const char *help;
} OptionSpec;

enum { RENDERING = HD_COMMAND_CLASSIC | HD_COMMAND_RENDER };

static const OptionSpec specs[] = {
    {OPTION_GPU, "--gpu", NULL, NULL, HD_COMMAND_CLASSIC,
     "trace on the GPU (this is the default of the classic mode)"},
    {OPTION_CPU, "--cpu", NULL, NULL, HD_COMMAND_CLASSIC, "trace on the CPU only"},
    {OPTION_DEFAULT, "--default", NULL, NULL, HD_COMMAND_CLASSIC,
     "print the most colourful configuration in the input format, and exit"},
    {OPTION_VARIANT, "--variant", NULL, "1..10", HD_COMMAND_CLASSIC,
     "which three solids the input means (default 4: tetrahedron, octahedron, dodecahedron)"},
    {OPTION_OUTPUT, "--output", "-o", "OUT", HD_COMMAND_RENDER,
     "a film, a picture or a sequence such as out/####.png, by the name's ending"},
    {OPTION_BACKEND, "--backend", NULL, "NAME", RENDERING,
     "auto, c, opencl or cuda (default auto: the best one found)"},
    {OPTION_DEVICE, "--device", NULL, "DEVICE", RENDERING,
     "number of the device as listed by 'hedron devices', or part of its name"},
    {OPTION_LANES, "--lanes", NULL, "N", RENDERING,
     "rays traced together on a CPU: 1, 4, 8 or 16 (default: what suits it)"},
    {OPTION_THREADS, "--threads", NULL, "N", RENDERING,
     "threads of the C backend (default: one for each core)"},
    {OPTION_PRECISION, "--precision", NULL, "P", RENDERING, "float or double (default float)"},
    {OPTION_MATH, "--math", NULL, "M", RENDERING,
     "strict: the same bytes everywhere; fast: the device's own (default strict)"},
    {OPTION_FRAMES, "--frames", NULL, "LIST", RENDERING,
     "render these frames only, for example 0-9,20"},
    {OPTION_SIZE, "--size", NULL, "WxH", RENDERING, "size of the picture in pixels"},
    {OPTION_SAMPLES, "--samples", NULL, "N", RENDERING, "N x N samples for each pixel"},
    {OPTION_DEPTH, "--depth", NULL, "N", RENDERING,
     "how often a ray may be mirrored or pass a face"},
    {OPTION_CUTOFF, "--cutoff", NULL, "W", RENDERING,
     "end rays that weigh less than W, 0..1 (default 0: never)"},
    {OPTION_HELP, "--help", "-h", NULL, RENDERING | HD_COMMAND_DEVICES, "print this help"},
    {OPTION_VERSION, "--version", NULL, NULL, RENDERING, "print the version"},
};
_Static_assert(HD_CLASSIC_VARIANTS == 10 && HD_CLASSIC_DEFAULT_VARIANT == 4,
               "the help of --variant says so");
enum { SPEC_COUNT = sizeof specs / sizeof specs[0] };

typedef struct Parser {
    HdOptions *options;
    bool mode_given;
    int count, next; /* arguments, and the number of the one to be read next */
    char **arguments;
} Parser;

static HdStatus parse_integer(const char *name, const char *text, int least, int most, int *out,
                              HdError *error) {
    char *end;
    errno = 0;
    long value = strtol(text, &end, 10);
    if (end == text || *end != '\0' || errno != 0 || value < least || value > most)
        return hd_fail(error, HD_BAD_INPUT, "%s is '%s', expected a whole number from %d to %d",
                       name, text, least, most);
    *out = (int)value;
    return HD_OK;
}

static HdStatus parse_size(const char *name, const char *text, HdOptions *options, HdError *error) {
    char *end;
    errno = 0;
    long width = strtol(text, &end, 10), height = 0;
    bool good = end != text && (*end == 'x' || *end == 'X') && end[1] >= '0' && end[1] <= '9';
    if (good) {
        height = strtol(end + 1, &end, 10);
        good = *end == '\0' && errno == 0 && width >= 1 && width <= HD_MAX_IMAGE_SIDE &&
               height >= 1 && height <= HD_MAX_IMAGE_SIDE;
    }
    if (!good)
        return hd_fail(error, HD_BAD_INPUT,
                       "%s is '%s', expected WIDTHxHEIGHT such as 640x480, each 1 to %d", name,
                       text, (int)HD_MAX_IMAGE_SIDE);
    options->width = (int)width;
    options->height = (int)height;
    return HD_OK;
}

static HdStatus parse_fraction(const char *name, const char *text, double *out, HdError *error) {
    char *end;
    double value = strtod(text, &end);
    if (end == text || *end != '\0' || !(value >= 0.0 && value < 1.0))
        return hd_fail(error, HD_BAD_INPUT, "%s is '%s', expected a number from 0 to below 1", name,
                       text);
    *out = value;
    return HD_OK;
}

/* The number of `text` among the names, or -1. */
static int choice(const char *text, const char *const *names, int count) {
    for (int i = 0; i < count; i++)
        if (strcmp(text, names[i]) == 0)
            return i;
    return -1;
}

static HdStatus parse_backend(const char *text, HdOptions *options, HdError *error) {
    if (strcmp(text, "auto") != 0 && hd_backend_find(text) == NULL)
        return hd_fail(error, HD_BAD_INPUT, "--backend is '%s', expected auto, c, opencl or cuda",
                       text);
    options->backend = strcmp(text, "auto") == 0 ? NULL : text;
    return HD_OK;
}

static HdStatus parse_output(const char *text, HdOptions *options, HdError *error) {
    if (hd_output_kind(text) == HD_OUTPUT_UNKNOWN)
        return hd_fail(error, HD_BAD_INPUT, "--output is '%.4000s', expected a name such as %s",
                       text, hd_output_endings());
    options->output = text;
    return HD_OK;
}

static HdStatus parse_lanes(const char *text, HdOptions *options, HdError *error) {
    static const char *const names[] = {"1", "4", "8", "16"};
    static const int lanes[] = {1, 4, 8, 16};
    int number = choice(text, names, 4);
    if (number < 0)
        return hd_fail(error, HD_BAD_INPUT, "--lanes is '%s', expected 1, 4, 8 or 16", text);
    options->render.lanes = lanes[number];
    return HD_OK;
}

static HdStatus parse_precision(const char *text, HdOptions *options, HdError *error) {
    static const char *const names[] = {"float", "double"};
    int number = choice(text, names, 2);
    if (number < 0)
        return hd_fail(error, HD_BAD_INPUT, "--precision is '%s', expected float or double", text);
    options->render.precision = number == 0 ? HD_PRECISION_FLOAT : HD_PRECISION_DOUBLE;
    return HD_OK;
}

static HdStatus parse_math(const char *text, HdOptions *options, HdError *error) {
    static const char *const names[] = {"strict", "fast"};
    int number = choice(text, names, 2);
    if (number < 0)
        return hd_fail(error, HD_BAD_INPUT, "--math is '%s', expected strict or fast", text);
    options->render.math = number == 0 ? HD_MATH_STRICT : HD_MATH_FAST;
    return HD_OK;
}

static HdStatus set_mode(Parser *parser, HdClassicMode mode, HdError *error) {
    if (parser->mode_given && parser->options->mode != mode)
        return hd_fail(error, HD_BAD_INPUT, "only one of --gpu, --cpu and --default may be given");
    parser->options->mode = mode;
    parser->mode_given = true;
    return HD_OK;
}

static HdStatus apply_option(Parser *parser, const OptionSpec *spec, const char *value,
                             HdError *error) {
    HdOptions *options = parser->options;
    switch (spec->id) {
    case OPTION_GPU:
        return set_mode(parser, HD_CLASSIC_GPU, error);
    case OPTION_CPU:
        return set_mode(parser, HD_CLASSIC_CPU, error);
    case OPTION_DEFAULT:
        return set_mode(parser, HD_CLASSIC_PRINT, error);
    case OPTION_VARIANT:
        return parse_integer(spec->name, value, 1, HD_CLASSIC_VARIANTS, &options->variant, error);
    case OPTION_OUTPUT:
        return parse_output(value, options, error);
    case OPTION_BACKEND:
        return parse_backend(value, options, error);
    case OPTION_DEVICE:
        if (value[0] == '\0')
            return hd_fail(error, HD_BAD_INPUT,
                           "--device is empty, expected a number or part of a name");
        options->device = value;
        return HD_OK;
    case OPTION_LANES:
        return parse_lanes(value, options, error);
    case OPTION_THREADS:
        return parse_integer(spec->name, value, 1, HD_MAX_THREADS, &options->render.threads, error);
    case OPTION_PRECISION:
        return parse_precision(value, options, error);
    case OPTION_MATH:
        return parse_math(value, options, error);
    case OPTION_FRAMES:
        options->frames = value;
        return HD_OK;
    case OPTION_SIZE:
        return parse_size(spec->name, value, options, error);
    case OPTION_SAMPLES:
        return parse_integer(spec->name, value, 1, HD_MAX_SAMPLES_PER_SIDE, &options->samples,
                             error);
    case OPTION_DEPTH:
        return parse_integer(spec->name, value, 0, HD_MAX_DEPTH, &options->depth, error);
    case OPTION_CUTOFF:
        return parse_fraction(spec->name, value, &options->cutoff, error);
    case OPTION_HELP:
        options->help_topic = options->command == HD_COMMAND_CLASSIC ? 0 : options->command;
        options->command = HD_COMMAND_HELP;
        return HD_OK;
    case OPTION_VERSION:
        options->command = HD_COMMAND_VERSION;
        return HD_OK;
    }
    return HD_OK;
}

/* Matches "--name", "--name=value" and "-n"; `*value` is what follows the equals sign, or NULL. */
static const OptionSpec *find_spec(const char *argument, const char **value) {
    size_t length = strcspn(argument, "=");
    *value = argument[length] == '=' ? argument + length + 1 : NULL;
    for (int i = 0; i < SPEC_COUNT; i++) {
        if (strlen(specs[i].name) == length && strncmp(specs[i].name, argument, length) == 0)
            return &specs[i];
        if (specs[i].short_name != NULL && strcmp(specs[i].short_name, argument) == 0)
            return &specs[i];
    }
    return NULL;
}

static const char *command_label(HdCommand command) {
    return command == HD_COMMAND_RENDER    ? "'hedron render'"
           : command == HD_COMMAND_DEVICES ? "'hedron devices'"
                                           : "the classic mode";
}

static HdStatus parse_argument(Parser *parser, HdError *error) {
    HdCommand command = parser->options->command;
    const char *argument = parser->arguments[parser->next++];
    const char *value;
    const OptionSpec *spec = find_spec(argument, &value);
    if (argument[0] != '-' || argument[1] == '\0')
        return hd_fail(error, HD_BAD_INPUT,
                       "'%s' is neither a command nor an option; see 'hedron --help'", argument);
    if (spec == NULL)
        return hd_fail(error, HD_BAD_INPUT, "unknown option '%s'; see 'hedron --help'", argument);
    if (!(spec->commands & (unsigned)command))
        return hd_fail(error, HD_BAD_INPUT, "%s does not belong to %s; see 'hedron --help'",
                       spec->name, command_label(command));
    if (spec->value == NULL && value != NULL)
        return hd_fail(error, HD_BAD_INPUT, "%s takes no value, but '%s' was given", spec->name,
                       value);
    if (spec->value != NULL && value == NULL) {
        if (parser->next >= parser->count)
            return hd_fail(error, HD_BAD_INPUT, "%s needs a value (%s)", spec->name, spec->value);
        value = parser->arguments[parser->next++];
    }
    if (value == NULL) /* and none is wanted */
        value = "";
    return apply_option(parser, spec, value, error);
}

static HdCommand command_named(const char *name) {
    if (strcmp(name, "render") == 0)
        return HD_COMMAND_RENDER;
    if (strcmp(name, "devices") == 0)
        return HD_COMMAND_DEVICES;
    if (strcmp(name, "help") == 0)
        return HD_COMMAND_HELP;
    return HD_COMMAND_CLASSIC;
}

static HdStatus parse_help_topic(HdOptions *options, int count, char **arguments, HdError *error) {
    if (count <= 2)
        return HD_OK;
    options->help_topic = command_named(arguments[2]);
    if (count > 3 ||
        (options->help_topic != HD_COMMAND_RENDER && options->help_topic != HD_COMMAND_DEVICES))
        return hd_fail(error, HD_BAD_INPUT, "'help' is followed by 'render', 'devices' or nothing");
    return HD_OK;
}

HdStatus hd_options_parse(HdOptions *options, int count, char **arguments, HdError *error) {
    memset(options, 0, sizeof *options);
    options->variant = HD_CLASSIC_DEFAULT_VARIANT;
    options->depth = options->samples = options->width = options->height = -1;
    options->cutoff = -1.0;
    options->command = count > 1 ? command_named(arguments[1]) : HD_COMMAND_CLASSIC;
    if (options->command == HD_COMMAND_HELP)
        return parse_help_topic(options, count, arguments, error);
    Parser parser = {
        .options = options,
        .count = count,
        .next = options->command == HD_COMMAND_CLASSIC ? 1 : 2,
        .arguments = arguments,
    };
    while (parser.next < count && options->command != HD_COMMAND_HELP &&
           options->command != HD_COMMAND_VERSION) {
        HdStatus status = parse_argument(&parser, error);
        if (status != HD_OK)
            return status;
    }
    return HD_OK;
}

void hd_options_print(FILE *out, HdCommand command) {
    for (int i = 0; i < SPEC_COUNT; i++) {
        char left[64];
        if (!(specs[i].commands & (unsigned)command))
            continue;
        snprintf(left, sizeof left, "%s%s%s%s%s", specs[i].short_name ? specs[i].short_name : "",
                 specs[i].short_name ? ", " : "", specs[i].name, specs[i].value ? " " : "",
                 specs[i].value ? specs[i].value : "");
        fprintf(out, "  %-20s  %s\n", left, specs[i].help);
    }
}
