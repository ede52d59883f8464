/* SPDX-License-Identifier: MIT */
#include "cli/options.h"

#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "system/path.h"

/* What a reference has where nothing else was asked for. */
enum { REFERENCE_SAMPLES = 32 };
#define REFERENCE_ERROR (1.0 / 64.0)

typedef struct Parser {
    HdOptions *options;
    const HdCommandSpec *command;
    int count, next; /* arguments, and the number of the one to be read next */
    char **arguments;
    bool only_operands; /* after "--" */
} Parser;

/* "did you mean '--size'?", or where to look. */
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
    else if (hd_help_form_named(argument) != HD_HELP_TEXT)
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
    const int most = parser->command->most_operands;
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
    if (value == NULL) /* and none is wanted */
        value = "";
    return hd_option_apply(parser->options, spec, value, error);
}

static HdStatus find_topic(HdOptions *options, HdError *error) {
    const char *name = options->operands[0];
    const HdCommandSpec *command = hd_command_named(name);
    HdNearest nearest = {.word = name};
    char suggestion[128];
    options->help_topic.form = hd_help_form_named(name);
    if (command != NULL)
        options->help_topic.command = command->command;
    if (command != NULL || options->help_topic.form != HD_HELP_TEXT)
        return HD_OK;
    for (int i = HD_HELP_TEXT + 1; i < HD_HELP_FORM_COUNT; i++)
        hd_nearest_offer(&nearest, hd_help_forms[i].text);
    offer_commands(&nearest);
    suggest(&nearest, "hedron help ", hd_command_spec(HD_COMMAND_HELP), suggestion);
    return hd_fail(error, HD_BAD_INPUT, "there is no help on '%s'; %s", name, suggestion);
}

/* What can only be told once all arguments are known. */
static HdStatus check_together(HdOptions *options, HdError *error) {
    if (options->command == HD_COMMAND_HELP && options->operand_count > 0)
        return find_topic(options, error);
    if (options->command == HD_COMMAND_CHECK && options->schema && options->operand_count > 0)
        return hd_fail(error, HD_BAD_INPUT, "--schema looks at no scene, but '%s' was given",
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

/* What the command and several options together decide. */
static void complete_plan(HdOptions *options) {
    HdScenePlan *scene = &options->scene;
    const bool is_classic = options->command == HD_COMMAND_CLASSIC;
    if (options->reference)
        options->devices.render.precision = HD_PRECISION_DOUBLE;
    hd_options_spell(options, false, scene->given, sizeof scene->given);
    hd_options_spell(options, true, options->store.given, sizeof options->store.given);
    if (options->reference) {
        scene->sampling = HD_SAMPLING_REFERENCE;
        scene->samples = scene->samples > 0 ? scene->samples : REFERENCE_SAMPLES;
        scene->max_error = scene->max_error > 0.0 ? scene->max_error : REFERENCE_ERROR;
    }
    scene->path = is_classic ? "-" : options->operand_count > 0 ? options->operands[0] : NULL;
    if (is_classic)
        options->devices.kind = options->cpu ? HD_ONLY_CPU : HD_PREFER_GPU;
    options->store.again |= is_classic;
    options->telling.wants_lines = options->command == HD_COMMAND_RENDER;
}

HdStatus hd_options_parse(HdOptions *options, int count, char **arguments, HdError *error) {
    hd_options_reset(options);
    options->help_topic.command = HD_COMMAND_CLASSIC;
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
    while (parser.next < count && options->command == parser.command->command) {
        HdStatus status = parse_argument(&parser, error);
        if (status != HD_OK)
            return status;
    }
    if (options->command != parser.command->command)
        return HD_OK;
    HdStatus status = check_together(options, error);
    if (status == HD_OK)
        complete_plan(options);
    return status;
}
