/* SPDX-License-Identifier: MIT */
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "cli/options.h"
#include "input/fields.h"
#include "render/backends.h"

/* A command line up to the word that is being typed. */
typedef struct Line {
    const HdCommandSpec *command;
    const HdOptionSpec *option; /* option whose value is being typed, or NULL */
    const char *kept, *typed;   /* parts of the word: "--name=" or "", and the rest */
    int kept_length;
    bool is_first;      /* the word may be a command */
    bool only_operands; /* "--" came before */
} Line;

/* ---- the words before ---- */

/* Returns the option of the line's command that a word names, or NULL. */
static const HdOptionSpec *find_option(const Line *line, const char *word, const char **value) {
    const HdCommand command = line->command->command;
    const HdOptionSpec *spec = hd_option_find(word, command, value);
    return spec != NULL && (spec->commands & (unsigned)command) != 0 ? spec : NULL;
}

static void read_word(Line *line, const char *word) {
    const char *value;
    const bool is_value = line->option != NULL;
    line->option = NULL;
    if (is_value || line->only_operands || word[0] != '-' || word[1] == '\0')
        return;
    line->only_operands = strcmp(word, "--") == 0;
    const HdOptionSpec *spec = find_option(line, word, &value);
    if (spec != NULL && spec->value != NULL && value == NULL)
        line->option = spec;
}

static void read_typed(Line *line, const char *word) {
    const char *value, *equals = strchr(word, '=');
    line->kept = line->typed = word;
    if (line->option != NULL || line->only_operands || word[0] != '-' || equals == NULL)
        return;
    line->option = find_option(line, word, &value);
    line->typed = equals + 1;
    line->kept_length = (int)(line->typed - word);
}

static Line read_line(char *const *words, int count) {
    const HdCommandSpec *command = count > 1 ? hd_command_named(words[0]) : NULL;
    Line line = {.command = command != NULL ? command : hd_command_spec(HD_COMMAND_CLASSIC),
                 .is_first = count <= 1};
    for (int i = command != NULL; i < count - 1; i++)
        read_word(&line, words[i]);
    read_typed(&line, count > 0 ? words[count - 1] : "");
    return line;
}

/* ---- completions ---- */

/* Prints a completion, if it begins with the typed text. */
static void offer(const Line *line, const char *word, const char *about) {
    if (strncmp(word, line->typed, strlen(line->typed)) != 0)
        return;
    printf("%.*s%s", line->kept_length, line->kept, word);
    printf(about[0] != '\0' ? "\t%s\n" : "%s\n", about);
}

static void offer_options(const Line *line) {
    const HdOptionSpec *spec = NULL;
    while ((spec = hd_option_next(spec, line->command->command)) != NULL) {
        if (spec->short_name != NULL)
            offer(line, spec->short_name, spec->help);
        offer(line, spec->name, spec->help);
    }
}

static void offer_commands(const Line *line) {
    for (int i = 0; i < HD_COMMAND_SPEC_COUNT; i++)
        if (hd_command_specs[i].name != NULL && hd_command_specs[i].command != HD_COMMAND_COMPLETE)
            offer(line, hd_command_specs[i].name, hd_command_specs[i].summary);
}

static void offer_devices(const Line *line) {
    static HdDevice devices[HD_MAX_DEVICES];
    HdError error;
    char name[64];
    offer(line, "all", "all GPUs and the CPU share the frames");
    for (int i = 0; i < HD_BACKEND_COUNT; i++) {
        int count = 0;
        if (hd_backend_enumerate(hd_backends[i], devices, HD_MAX_DEVICES, &count, &error) != HD_OK)
            continue;
        for (int d = 0; d < count; d++) {
            snprintf(name, sizeof name, "%s:%d", hd_backends[i]->name, devices[d].index);
            offer(line, name, devices[d].name);
        }
    }
}

/* Offers the choices of an option; of a set, those after the last comma. */
static void offer_choices(const Line *line) {
    const char *comma = line->option->type == HD_OPTION_SET ? strrchr(line->typed, ',') : NULL;
    Line last = *line;
    if (comma != NULL) {
        last.typed = comma + 1;
        last.kept_length = (int)(last.typed - line->kept);
    }
    for (const char *const *choice = line->option->choices; *choice != NULL; choice++)
        offer(&last, *choice, "");
}

/* Offers "image.aa=", and after the sign the words of the value. */
static void offer_path(const Line *line, const char *object, const HdField *field) {
    char text[256];
    if (field->type == HD_FIELD_LIST || field->type == HD_FIELD_MATERIALS ||
        field->type == HD_FIELD_OBJECT || field->key[0] == '$')
        return;
    const int length = snprintf(text, sizeof text, "%s%s=", object, field->key);
    if (field->choices == NULL || strchr(line->typed, '=') == NULL) {
        offer(line, text, field->about);
        return;
    }
    for (const HdChoice *choice = field->choices; choice->word != NULL; choice++) {
        snprintf(text + length, sizeof text - (size_t)length, "%s", choice->word);
        offer(line, text, "");
    }
}

/* Offers the paths of all values that are not in lists. */
static void offer_paths(const Line *line) {
    for (int i = 0; i < hd_scene_fields.field_count; i++) {
        const HdField *field = &hd_scene_fields.fields[i];
        char object[64];
        snprintf(object, sizeof object, "%s.", field->key);
        offer_path(line, "", field);
        for (int k = 0; field->type == HD_FIELD_OBJECT && k < field->object->field_count; k++)
            offer_path(line, object, &field->object->fields[k]);
    }
}

static void offer_value(const Line *line) {
    const HdOptionSpec *spec = line->option;
    if (strcmp(spec->name, "--set") == 0)
        offer_paths(line);
    else if (spec->choices != NULL)
        offer_choices(line);
    else if (spec->takes_file)
        puts(":");
    else if (strcmp(spec->name, "--device") == 0)
        offer_devices(line);
}

static void offer_topics(const Line *line) {
    for (int i = 0; i < HD_HELP_TOPIC_COUNT; i++)
        if (hd_help_topics[i].about != NULL)
            offer(line, hd_help_topics[i].name, hd_help_topics[i].about);
}

static void offer_operands(const Line *line) {
    const HdCommandSpec *command = line->command;
    if (command->command == HD_COMMAND_HELP || (command->name == NULL && line->is_first))
        offer_commands(line);
    if (command->command == HD_COMMAND_HELP)
        offer_topics(line);
    else if (command->name != NULL && command->max_operands != 0)
        printf(":%s\n", command->ending != NULL ? command->ending : "");
}

HdStatus hd_command_complete(const HdOptions *options, HdError *error) {
    (void)error;
    const Line line = read_line(options->operands, options->operand_count);
    if (line.option != NULL)
        offer_value(&line);
    else if (line.typed[0] == '-' && !line.only_operands)
        offer_options(&line);
    else
        offer_operands(&line);
    return HD_OK;
}
