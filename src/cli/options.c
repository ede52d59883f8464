/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "cli/options.h"

#include <errno.h>
#include <math.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/text.h"
#include "image/picture.h"
#include "input/classic.h"
#include "output/outputs.h"
#include "system/interrupt.h"
#include "system/path.h"
#include "system/thread_pool.h"

#define ROW(...) {__VA_ARGS__},
const HdCommandSpec hd_command_specs[HD_COMMAND_SPEC_COUNT] = {
#include "cli/command_table.h"
};

const HdHelpTopic hd_help_topics[HD_HELP_TOPIC_COUNT] = {
    [HD_HELP_SCENE] = {"scene", "every key of a scene file"},
    [HD_HELP_CLASSIC] = {"classic", "the classic mode and its input"},
    [HD_HELP_MAN] = {"man", "the man page"},
    [HD_HELP_BASH] = {"completion", "completion for bash"},
    [HD_HELP_ZSH] = {"completion-zsh", "completion for zsh"},
    [HD_HELP_FISH] = {"completion-fish", "completion for fish"},
    [HD_HELP_REFERENCE_SCENE] = {"reference-scene", NULL},
    [HD_HELP_REFERENCE_COMMANDS] = {"reference-command-line", NULL},
    [HD_HELP_REFERENCE_STATISTICS] = {"reference-statistics", NULL}};

int hd_help_topic_named(const char *name) {
    int topic = HD_HELP_TOPIC_COUNT - 1;
    while (topic >= 0 && strcmp(hd_help_topics[topic].name, name) != 0)
        topic--;
    return topic;
}

const HdCommandSpec *hd_command_named(const char *name) {
    for (int i = 0; i < HD_COMMAND_SPEC_COUNT; i++)
        if (hd_command_specs[i].name != NULL && strcmp(hd_command_specs[i].name, name) == 0)
            return &hd_command_specs[i];
    return NULL;
}

const HdCommandSpec *hd_command_spec(HdCommand command) {
    for (int i = 0; i < HD_COMMAND_SPEC_COUNT; i++)
        if (hd_command_specs[i].command == command)
            return &hd_command_specs[i];
    return NULL;
}

enum {
    RENDERING = HD_COMMAND_CLASSIC | HD_COMMAND_RENDER,
    MEASURING = RENDERING | HD_COMMAND_TUNE,
    SHOWING = HD_USUAL_COMMANDS,
    EVERYTHING = SHOWING | HD_COMMAND_CHECK | HD_COMMAND_CONVERT | HD_COMMAND_DEVICES |
                 HD_COMMAND_COMPARE | HD_COMMAND_NEW | HD_COMMAND_COMPLETE | HD_COMMAND_HELP |
                 HD_COMMAND_SELFTEST
};

#define QUOTED(number) #number,
static const char *const lane_counts[] = {HD_LANE_COUNTS(QUOTED) NULL};

const char *const hd_curve_names[] = {"linear", "srgb", NULL};

/* Words that several rows of the table share. */
#define OF_SCENE  "the scene's"
#define OF_DEVICE "depends on the device"

static const char modes[] = "--gpu, --cpu and --default";
static const char loudness[] = "--verbose and --quiet";

static HdStatus check_diff(const char *text, const char *option, HdError *error) {
    if (hd_format_of(text) == &hd_format_png)
        return HD_OK;
    return hd_fail(error, HD_BAD_INPUT, "%s is '%s', expected a name that ends in .png", option,
                   text);
}

static HdStatus check_change(const char *text, const char *option, HdError *error) {
    if (strchr(text, '=') != NULL && text[0] != '=')
        return HD_OK;
    return hd_fail(error, HD_BAD_INPUT,
                   "%s is '%s', expected PATH=VALUE such as camera.field_of_view=40", option, text);
}

/* Columns of the table that a type needs. */
#define AT(member)   .offset = offsetof(HdOptions, member)
#define FLAG(member) .type = HD_OPTION_FLAG, AT(member)
#define INTEGER(member, least, most)                                                               \
    .type = HD_OPTION_INTEGER, AT(member), .low = (least), .high = (most)
#define REAL(member, least, most) .type = HD_OPTION_REAL, AT(member), .low = (least), .high = (most)
#define ONE_OF(kind, member, ...)                                                                  \
    .type = (kind), AT(member), .choices = (const char *const[]) {                                 \
        __VA_ARGS__, NULL                                                                          \
    }
#define CHOICE(member, ...)  ONE_OF(HD_OPTION_CHOICE, member, __VA_ARGS__)
#define TEXT(member, wanted) .type = HD_OPTION_TEXT, AT(member), .expected = (wanted)
#define TEXTS(member, count, most)                                                                 \
    .type = HD_OPTION_TEXTS, AT(member), .count_offset = offsetof(HdOptions, count), .high = (most)
#define COMMAND(taken) .type = HD_OPTION_COMMAND, .command = (taken)

#define OPTION(member, ...) {__VA_ARGS__},
const HdOptionSpec hd_option_specs[] = {
#include "cli/option_table.h"
    {.name = NULL},
};
_Static_assert(HD_CLASSIC_VARIANTS == 10 && HD_CLASSIC_DEFAULT_VARIANT == 4 &&
                   HD_MAX_OUTPUTS == 8 && HD_MAX_CHANGES == 64 && HD_BLOCK_STEP == 32 &&
                   HD_MAX_IMAGE_SIDE == 65535,
               "the texts say so");

const HdOptionSpec *hd_option_next(const HdOptionSpec *spec, HdCommand command) {
    spec = spec == NULL ? hd_option_specs : spec + 1;
    while (spec->name != NULL && (spec->commands & (unsigned)command) == 0)
        spec++;
    return spec->name != NULL ? spec : NULL;
}

/* Returns whether the argument is "-n", or "-nVALUE" if the option has a value. */
static bool is_short(const HdOptionSpec *spec, const char *argument) {
    if (spec->short_name == NULL || strncmp(argument, spec->short_name, 2) != 0)
        return false;
    return argument[2] == '\0' || (spec->value != NULL && argument[2] != '=');
}

const HdOptionSpec *hd_option_find(const char *argument, HdCommand command, const char **value) {
    const HdOptionSpec *found = NULL;
    size_t length = strcspn(argument, "=");
    *value = argument[length] == '=' ? argument + length + 1 : NULL;
    for (const HdOptionSpec *spec = hd_option_specs; spec->name != NULL; spec++) {
        bool is_long = strlen(spec->name) == length && strncmp(spec->name, argument, length) == 0;
        if (!is_long && !is_short(spec, argument))
            continue;
        if (!is_long)
            *value = argument[2] != '\0' ? argument + 2 : NULL;
        if (found == NULL || (spec->commands & (unsigned)command) != 0)
            found = spec;
    }
    return found;
}

void hd_option_heading(const HdOptionSpec *spec, char text[64]) {
    snprintf(text, 64, "%s%s%s%s%s", spec->short_name ? spec->short_name : "",
             spec->short_name ? ", " : "", spec->name, spec->value ? " " : "",
             spec->value ? spec->value : "");
}

/* Writes "auto, c, opencl or cuda" */
static void list_choices(const char *const *choices, char text[256]) {
    text[0] = '\0';
    for (int i = 0; choices[i] != NULL; i++)
        hd_add_text(text, 256, choices[i + 1] == NULL ? " or " : ", ", "%s", choices[i]);
}

void hd_option_values(const HdOptionSpec *spec, char text[256]) {
    text[0] = '\0';
    if (spec->type == HD_OPTION_INTEGER || spec->type == HD_OPTION_REAL) {
        char low[HD_NUMBER_SIZE], high[HD_NUMBER_SIZE];
        hd_short_number(spec->low, low);
        hd_short_number(spec->high, high);
        hd_add_text(text, 256, "", "%s to %s%s", low, spec->below_high ? "below " : "", high);
        if (spec->step != 0)
            hd_add_text(text, 256, ", ", "a multiple of %d", spec->step);
    } else if (spec->type == HD_OPTION_SIZE) {
        hd_add_text(text, 256, "", "each 1 to %d", HD_MAX_IMAGE_SIDE);
    } else if (spec->type == HD_OPTION_SET) {
        for (int i = 0; spec->choices[i] != NULL; i++)
            hd_add_text(text, 256, ",", "%s", spec->choices[i]);
        hd_add_text(text, 256, "", " or some of them");
    } else if (spec->choices != NULL) {
        list_choices(spec->choices, text);
    }
}

/* ---- parsing of values ---- */

/* Option on the command line. */
typedef struct Given {
    HdOptions *options;
    const HdOptionSpec *spec;
    const char *text; /* its value */
    void *member;     /* member of the options that it sets */
} Given;

static void *at(HdOptions *options, size_t offset) {
    return (char *)options + offset;
}

static HdStatus fail_expecting(const Given *given, const char *expected, HdError *error) {
    return hd_fail(error, HD_BAD_INPUT, "%s is '%s', expected %s", given->spec->name, given->text,
                   expected);
}

static HdStatus apply_flag(const Given *given, HdError *error) {
    const char *only_one_of = given->spec->only_one_of;
    *(bool *)given->member = true;
    for (const HdOptionSpec *other = hd_option_specs; other->name != NULL; other++)
        if (only_one_of != NULL && other->only_one_of == only_one_of && other != given->spec &&
            *(const bool *)at(given->options, other->offset))
            return hd_fail(error, HD_BAD_INPUT, "only one of %s may be given", only_one_of);
    return HD_OK;
}

static HdStatus apply_command(const Given *given, HdError *error) {
    (void)error;
    given->options->topic = hd_command_spec(given->options->command)->name;
    given->options->command = given->spec->command;
    return HD_OK;
}

/* Moves `*text` past a whole number in the range and one of the characters `ends`; "" stands for
   the end of the text. */
static bool take_number(const char **text, const char *ends, double low, double high, int *out) {
    char *rest;
    errno = 0;
    if (**text < '0' || **text > '9')
        return false;
    const long value = strtol(*text, &rest, 10);
    const bool has_end = *rest == '\0' ? *ends == '\0' : strchr(ends, *rest) != NULL;
    if (!has_end || errno != 0 || (double)value < low || (double)value > high)
        return false;
    *out = (int)value;
    *text = rest + (*rest != '\0');
    return true;
}

static HdStatus apply_integer(const Given *given, HdError *error) {
    const HdOptionSpec *spec = given->spec;
    const char *rest = given->text;
    char expected[64];
    int *out = given->member;
    if (!take_number(&rest, "", spec->low, spec->high, out))
        snprintf(expected, sizeof expected, "a whole number from %.0f to %.0f", spec->low,
                 spec->high);
    else if (spec->step != 0 && *out % spec->step != 0)
        snprintf(expected, sizeof expected, "a multiple of %d", spec->step);
    else
        return HD_OK;
    return fail_expecting(given, expected, error);
}

/* Accepts "1", "0.5", ".5" and "1e-3", but not strtod's other formats. */
static HdStatus apply_real(const Given *given, HdError *error) {
    const HdOptionSpec *spec = given->spec;
    const char *text = given->text;
    char expected[64], *rest;
    const double value = strtod(text, &rest);
    const bool is_decimal = strchr("+-", text[0]) == NULL && *rest == '\0' &&
                            text[strspn(text, "0123456789.eE+-")] == '\0';
    *(double *)given->member = value;
    if (is_decimal && value >= spec->low &&
        (spec->below_high ? value < spec->high : value <= spec->high))
        return HD_OK;
    snprintf(expected, sizeof expected, "a number from %g to %s%g", spec->low,
             spec->below_high ? "below " : "", spec->high);
    return fail_expecting(given, expected, error);
}

static HdStatus apply_area(const Given *given, HdError *error) {
    HdPlannedArea *area = given->member;
    const bool is_size = given->spec->type == HD_OPTION_SIZE;
    const char *rest = given->text;
    if (take_number(&rest, is_size ? "xX" : "x", 1, HD_MAX_IMAGE_SIDE, &area->width) &&
        take_number(&rest, is_size ? "" : "+", 1, HD_MAX_IMAGE_SIDE, &area->height) &&
        (is_size || (take_number(&rest, "+", 0, HD_MAX_IMAGE_SIDE, &area->left) &&
                     take_number(&rest, "", 0, HD_MAX_IMAGE_SIDE, &area->top))))
        return HD_OK;
    return fail_expecting(given, given->spec->expected, error);
}

/* Returns the index of the choice that matches the first `length` characters; -1: none. */
static int choice_of(const char *const *choices, const char *word, size_t length) {
    for (int i = 0; choices[i] != NULL; i++)
        if (strncmp(choices[i], word, length) == 0 && choices[i][length] == '\0')
            return i;
    return -1;
}

/* Suggests the first choice that begins with the text, if that is not empty. */
static HdStatus fail_choosing(const Given *given, HdError *error) {
    const size_t length = strlen(given->text);
    char list[256];
    list_choices(given->spec->choices, list);
    for (const char *const *choice = given->spec->choices; *choice != NULL && length > 0; choice++)
        if (strncmp(given->text, *choice, length) == 0)
            return hd_fail(error, HD_BAD_INPUT, "%s is '%s', expected %s; did you mean '%s'?",
                           given->spec->name, given->text, list, *choice);
    return fail_expecting(given, list, error);
}

static HdStatus apply_choice(const Given *given, HdError *error) {
    const int number = choice_of(given->spec->choices, given->text, strlen(given->text));
    if (number < 0)
        return fail_choosing(given, error);
    if (given->spec->type == HD_OPTION_WORD)
        *(const char **)given->member = number > 0 ? given->text : NULL;
    else
        *(int *)given->member = given->spec->type == HD_OPTION_NUMERAL ? atoi(given->text) : number;
    return HD_OK;
}

static HdStatus apply_set(const Given *given, HdError *error) {
    const HdOptionSpec *spec = given->spec;
    unsigned *set = given->member;
    *set = 0;
    for (const char *word = given->text;;) {
        const size_t length = strcspn(word, ",");
        const int number = choice_of(spec->choices, word, length);
        if (number < 0) {
            char list[256];
            list_choices(spec->choices, list);
            return hd_fail(error, HD_BAD_INPUT,
                           "%s has '%.*s', expected some of %s, separated by commas", spec->name,
                           (int)length, word, list);
        }
        if ((*set >> number & 1) != 0)
            return hd_fail(error, HD_BAD_INPUT, "%s has %s twice", spec->name,
                           spec->choices[number]);
        *set |= 1u << number;
        if (word[length] == '\0')
            return HD_OK;
        word += length + 1;
    }
}

static HdStatus apply_text(const Given *given, HdError *error) {
    const HdOptionSpec *spec = given->spec;
    const char **out = given->member;
    if (spec->type == HD_OPTION_TEXTS) {
        int *count = at(given->options, spec->count_offset);
        if (*count == (int)spec->high)
            return hd_fail(error, HD_BAD_INPUT, "%s '%.4000s' is one too many, expected at most %d",
                           spec->name, given->text, *count);
        out += (*count)++;
    }
    *out = given->text;
    if (spec->check != NULL)
        HD_TRY(spec->check(given->text, spec->name, error));
    if (given->text[0] == '\0' && spec->expected != NULL)
        return hd_fail(error, HD_BAD_INPUT, "%s is empty, expected %s", spec->name, spec->expected);
    return HD_OK;
}

/* Values of options that are not given. */
static const HdOptions defaults = {
    .scene = {.variant = HD_CLASSIC_DEFAULT_VARIANT, .depth = -1, .cutoff = -1, .sampling = -1},
    .fail_above = -1,
    .curve = -1,
};

/* Applies one option over earlier ones; `value` is "" for an option without one. */
static HdStatus apply_option(HdOptions *options, const HdOptionSpec *spec, const char *value,
                             HdError *error) {
    static HdStatus (*const apply[])(const Given *, HdError *) = {
        [HD_OPTION_FLAG] = apply_flag,       [HD_OPTION_COMMAND] = apply_command,
        [HD_OPTION_INTEGER] = apply_integer, [HD_OPTION_REAL] = apply_real,
        [HD_OPTION_CHOICE] = apply_choice,   [HD_OPTION_NUMERAL] = apply_choice,
        [HD_OPTION_WORD] = apply_choice,     [HD_OPTION_SET] = apply_set,
        [HD_OPTION_SIZE] = apply_area,       [HD_OPTION_CROP] = apply_area,
        [HD_OPTION_TEXT] = apply_text,       [HD_OPTION_TEXTS] = apply_text,
    };
    const Given given = {options, spec, value, at(options, spec->offset)};
    return apply[spec->type](&given, error);
}

/* ---- spelling of values ---- */

/* Writes the value of an option that was given; returns false if it was not, or has its default. */
static bool spell_value(const HdOptions *options, const HdOptionSpec *spec, char value[64]) {
    const void *member = (const char *)options + spec->offset;
    const void *unset = (const char *)&defaults + spec->offset;
    const HdPlannedArea *area = member;
    const int *number = member;
    const double *real = member;
    switch (spec->type) {
    case HD_OPTION_FLAG:
        value[0] = '\0';
        return *(const bool *)member;
    case HD_OPTION_INTEGER:
        snprintf(value, 64, "%d", *number);
        return *number != *(const int *)unset;
    case HD_OPTION_REAL:
        hd_short_number(*real, value);
        return *real != *(const double *)unset;
    case HD_OPTION_CHOICE:
        snprintf(value, 64, "%s", spec->choices[*number > 0 ? *number : 0]);
        return *number != *(const int *)unset;
    case HD_OPTION_SIZE:
    case HD_OPTION_CROP:
        snprintf(value, 64, "%dx%d", area->width, area->height);
        if (spec->type == HD_OPTION_CROP)
            hd_add_text(value, 64, "", "+%d+%d", area->left, area->top);
        return area->width > 0;
    default:
        return false;
    }
}

static void append(char *text, size_t size, const char *name, const char *value) {
    const char *const parts[] = {text[0] != '\0' ? " " : "", name, value[0] != '\0' ? " " : "",
                                 value};
    size_t length = strlen(text);
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        hd_escape(parts[i], text + length, size - length);
        length += strlen(text + length);
    }
}

/* Writes the options that were given to the command and are not at their defaults, in the table's
   order, as on a command line. Includes those of HD_DECIDES_NUMBERS, and with `all` those of
   HD_DECIDES_PIXELS, among them --set alone with texts. Escaped (text.h), and cut to `size` bytes
   with the zero byte. */
static void spell(const HdOptions *options, bool all, char *text, size_t size) {
    const HdOptionSpec *spec = NULL;
    char value[64];
    text[0] = '\0';
    while ((spec = hd_option_next(spec, options->command)) != NULL) {
        if (spec->role == HD_DECIDES_NO_PIXEL || (spec->role == HD_DECIDES_PIXELS && !all))
            continue;
        for (int i = 0; spec->type == HD_OPTION_TEXTS && i < options->scene.change_count; i++)
            append(text, size, spec->name, options->scene.changes[i]);
        if (spell_value(options, spec, value))
            append(text, size, spec->name, value);
    }
}

/* ---- the command line ---- */

/* Defaults of a reference. */
enum { REFERENCE_SAMPLES = 32 };
#define REFERENCE_ERROR (1.0 / 64.0)

typedef struct Parser {
    HdOptions *options;
    const HdCommandSpec *command;
    int count, next; /* arguments, and the index of the next one */
    char **arguments;
    bool only_operands; /* after "--" */
} Parser;

/* Adds "did you mean '--size'?", or the place to look. */
static void suggest(const HdNearest *nearest, const char *prefix, const HdCommandSpec *command,
                    char text[128]) {
    if (nearest->name != NULL)
        snprintf(text, 128, "did you mean '%s%s'?", prefix, nearest->name);
    else if (command->name != NULL)
        snprintf(text, 128, "see 'hedron help %s'", command->name);
    else
        snprintf(text, 128, "see 'hedron help'");
}

static HdStatus fail_unknown_option(const Parser *parser, const char *argument, HdError *error) {
    char word[32], suggestion[128];
    snprintf(word, sizeof word, "%.*s", (int)strcspn(argument, "="), argument);
    HdNearest nearest = {.word = word};
    const HdOptionSpec *spec = NULL;
    while ((spec = hd_option_next(spec, parser->options->command)) != NULL)
        hd_nearest_offer(&nearest, spec->name);
    suggest(&nearest, "", parser->command, suggestion);
    return hd_fail(error, HD_BAD_INPUT, "unknown option '%s'; %s", argument, suggestion);
}

static void offer_commands(HdNearest *nearest) {
    for (int i = 0; i < HD_COMMAND_SPEC_COUNT; i++)
        if (hd_command_specs[i].name != NULL)
            hd_nearest_offer(nearest, hd_command_specs[i].name);
}

static HdStatus fail_unknown_command(const Parser *parser, const char *argument, HdError *error) {
    char suggestion[sizeof error->message];
    const size_t size = sizeof suggestion;
    if (hd_path_has_ending(argument, ".json"))
        snprintf(suggestion, size, "did you mean 'hedron render %s'?", argument);
    else if (hd_help_topic_named(argument) >= 0)
        snprintf(suggestion, size, "did you mean 'hedron help %s'?", argument);
    else if (strcmp(argument, "version") == 0)
        snprintf(suggestion, size, "did you mean 'hedron --version'?");
    else if (strpbrk(argument, "./") != NULL)
        snprintf(suggestion, size, "the classic mode reads standard input: hedron --cpu < %s",
                 argument);
    else {
        HdNearest nearest = {.word = argument};
        offer_commands(&nearest);
        suggest(&nearest, "hedron ", parser->command, suggestion);
    }
    return hd_fail(error, HD_BAD_INPUT, "'%s' is neither a command nor an option; %s", argument,
                   suggestion);
}

static HdStatus add_operand(Parser *parser, char *argument, HdError *error) {
    HdOptions *options = parser->options;
    const char *name = parser->command->name;
    const int most = parser->command->max_operands;
    if (name == NULL)
        return fail_unknown_command(parser, argument, error);
    if (argument[0] == '\0' && options->command != HD_COMMAND_COMPLETE)
        return hd_fail(error, HD_BAD_INPUT, "'hedron %s' was given an empty name", name);
    if (most == 0)
        return hd_fail(error, HD_BAD_INPUT, "'hedron %s' takes options only, but '%s' was given",
                       name, argument);
    if (most > 0 && options->operand_count == most)
        return hd_fail(error, HD_BAD_INPUT, "'hedron %s' takes %s only, but '%s' came after '%s'",
                       name, most == 1 ? "one name" : "two names", argument,
                       options->operands[most - 1]);
    options->operands[options->operand_count++] = argument;
    return HD_OK;
}

static HdStatus fail_foreign_option(const Parser *parser, const HdOptionSpec *spec,
                                    HdError *error) {
    const char *name = parser->command->name;
    if (name == NULL)
        return hd_fail(error, HD_BAD_INPUT,
                       "%s does not belong to the classic mode; see 'hedron help'", spec->name);
    return hd_fail(error, HD_BAD_INPUT, "%s does not belong to 'hedron %s'; see 'hedron help %s'",
                   spec->name, name, name);
}

static HdStatus parse_argument(Parser *parser, HdError *error) {
    char *argument = parser->arguments[parser->next++];
    const char *value;
    if (!parser->only_operands && strcmp(argument, "--") == 0) {
        parser->only_operands = true;
        return HD_OK;
    }
    if (parser->only_operands || argument[0] != '-' || argument[1] == '\0')
        return add_operand(parser, argument, error);
    const HdOptionSpec *spec = hd_option_find(argument, parser->options->command, &value);
    if (spec == NULL)
        return fail_unknown_option(parser, argument, error);
    if (!(spec->commands & (unsigned)parser->options->command))
        return fail_foreign_option(parser, spec, error);
    if (spec->value == NULL && value != NULL)
        return hd_fail(error, HD_BAD_INPUT, "%s takes no value, but '%s' was given", spec->name,
                       value);
    if (spec->value != NULL && value == NULL) {
        if (parser->next >= parser->count)
            return hd_fail(error, HD_BAD_INPUT, "%s needs a value (%s)", spec->name, spec->value);
        value = parser->arguments[parser->next++];
    }
    if (value == NULL) /* the option has no value */
        value = "";
    return apply_option(parser->options, spec, value, error);
}

/* Offers the topics of help, and lists them: "render, view or scene". */
static void offer_topics(HdNearest *nearest, char list[256]) {
    const char *names[HD_COMMAND_SPEC_COUNT + HD_HELP_TOPIC_COUNT + 1] = {NULL};
    int count = 0;
    for (int i = 0; i < HD_COMMAND_SPEC_COUNT; i++)
        if (hd_command_specs[i].name != NULL)
            names[count++] = hd_command_specs[i].name;
    for (int i = 0; i < HD_HELP_TOPIC_COUNT; i++)
        if (hd_help_topics[i].about != NULL)
            names[count++] = hd_help_topics[i].name;
    for (int i = 0; i < count; i++)
        hd_nearest_offer(nearest, names[i]);
    list_choices(names, list);
}

static HdStatus check_topic(const char *name, HdError *error) {
    HdNearest nearest = {.word = name};
    char list[256];
    if (hd_command_named(name) != NULL || hd_help_topic_named(name) >= 0)
        return HD_OK;
    offer_topics(&nearest, list);
    if (nearest.name != NULL)
        return hd_fail(error, HD_BAD_INPUT,
                       "there is no help on '%s', expected %s; did you mean 'hedron help %s'?",
                       name, list, nearest.name);
    return hd_fail(error, HD_BAD_INPUT, "there is no help on '%s', expected %s", name, list);
}

/* Checks conditions that need all arguments. */
static HdStatus check_together(HdOptions *options, HdError *error) {
    if (options->command == HD_COMMAND_HELP && options->operand_count > 0) {
        options->topic = options->operands[0];
        return check_topic(options->topic, error);
    }
    if (options->command == HD_COMMAND_CHECK && options->schema && options->operand_count > 0)
        return hd_fail(error, HD_BAD_INPUT, "--schema reads no scene, but '%s' was given",
                       options->operands[0]);
    if (options->command == HD_COMMAND_CHECK && !options->schema && options->operand_count == 0)
        return hd_fail(error, HD_BAD_INPUT,
                       "'hedron check' needs the name of a scene; see 'hedron help check'");
    if (options->command == HD_COMMAND_COMPARE && options->operand_count < 2)
        return hd_fail(error, HD_BAD_INPUT,
                       "'hedron compare' needs the names of two pictures; see 'hedron help "
                       "compare'");
    if (options->command == HD_COMMAND_CLASSIC && options->store.statistics != NULL &&
        strcmp(options->store.statistics, "-") == 0)
        return hd_fail(error, HD_BAD_INPUT,
                       "--stats is '-', but standard output has the lines of the classic mode; "
                       "expected a file");
    if (options->reference && options->scene.sampling >= 0)
        return hd_fail(error, HD_BAD_INPUT, "--reference has samples of its own: leave out --aa");
    return HD_OK;
}

/* Completes the plan from the command and several options together. */
static void complete_plan(HdOptions *options) {
    HdScenePlan *scene = &options->scene;
    if (options->reference)
        options->devices.render.precision = HD_PRECISION_DOUBLE;
    spell(options, false, scene->given, sizeof scene->given);
    spell(options, true, options->store.given, sizeof options->store.given);
    if (options->reference) {
        scene->sampling = HD_SAMPLING_REFERENCE;
        scene->samples = scene->samples > 0 ? scene->samples : REFERENCE_SAMPLES;
        scene->max_error = scene->max_error > 0.0 ? scene->max_error : REFERENCE_ERROR;
    }
    scene->path = options->operand_count > 0 ? options->operands[0] : NULL;
    if (options->command == HD_COMMAND_CLASSIC) {
        scene->is_classic = options->store.again = true;
        scene->path = "-";
        options->devices.kind = options->cpu ? HD_ONLY_CPU : HD_PREFER_GPU;
    }
    options->reporting.wants_lines = options->command == HD_COMMAND_RENDER;
}

HdStatus hd_options_parse(HdOptions *options, int count, char **arguments, HdError *error) {
    *options = defaults;
    const HdCommandSpec *command = count > 1 ? hd_command_named(arguments[1]) : NULL;
    Parser parser = {
        .options = options,
        .command = command != NULL ? command : hd_command_spec(HD_COMMAND_CLASSIC),
        .count = count,
        .next = command != NULL ? 2 : 1,
        .arguments = arguments,
    };
    options->command = parser.command->command;
    options->operands = arguments + parser.next;
    while (parser.next < count && options->command == parser.command->command)
        HD_TRY(parse_argument(&parser, error));
    if (options->command != parser.command->command)
        return HD_OK;
    HD_TRY(check_together(options, error));
    complete_plan(options);
    return HD_OK;
}

/* ---- the program ---- */

/* Returns whether the reader of standard output has closed its end of a pipe. */
static bool is_output_closed(void) {
    struct pollfd output = {.fd = STDOUT_FILENO, .events = POLLOUT};
    return poll(&output, 1, 0) == 1 && (output.revents & POLLERR) != 0;
}

/* Ends the program by SIGPIPE, silently, as if it were not ignored. */
static void end_by_closed_pipe(void) {
    sigset_t set;
    signal(SIGPIPE, SIG_DFL);
    sigemptyset(&set);
    sigaddset(&set, SIGPIPE);
    pthread_sigmask(SIG_UNBLOCK, &set, NULL);
    raise(SIGPIPE);
}

/* Returns whether a command does nothing but print. */
static bool only_prints(const HdOptions *options) {
    return options->prints_default ||
           (options->command & (HD_COMMAND_RENDER | HD_COMMAND_VIEW | HD_COMMAND_CLASSIC)) == 0;
}

int hd_program_run(int count, char **arguments, HdCommandFunction *run) {
    static HdError error;
    HdOptions options = defaults;
    options.command = HD_COMMAND_CLASSIC;
    hd_interrupt_install();
    HdStatus status = hd_check_stack(&error);
    if (status == HD_OK)
        status = hd_interrupt_read_timeout(&error);
    if (status == HD_OK)
        status = hd_options_parse(&options, count, arguments, &error);
    if (status == HD_OK && count == 1 && isatty(STDIN_FILENO))
        options.command = HD_COMMAND_HELP;
    if (status == HD_OK)
        status = run(&options, &error);
    if (status == HD_OK && (fflush(stdout) != 0 || ferror(stdout)))
        status = hd_fail(&error, HD_FAILED, "cannot write to standard output");
    if (status == HD_OK)
        return 0;
    if (status == HD_FAILED && only_prints(&options) && is_output_closed())
        end_by_closed_pipe();
    fprintf(stderr, "hedron: %s\n", error.message);
    if (status == HD_INTERRUPTED)
        return 128 + hd_interrupt_signal();
    return (int)status;
}
