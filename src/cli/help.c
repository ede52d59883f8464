/* SPDX-License-Identifier: MIT */
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "cli/help_text.h"

/* Made by the build from completions/. */
extern const unsigned char hd_bash_completion[], hd_zsh_completion[], hd_fish_completion[];
extern const size_t hd_bash_completion_size, hd_zsh_completion_size, hd_fish_completion_size;

enum { OPTION_COLUMN = 22, USAGE_COLUMN = 34, EXAMPLE_COLUMN = 6 };

/* Prints two columns; a left one that is too long has a line of its own. */
static void print_entry(const char *left, int column, const char *right) {
    int used = printf("  %s", left);
    if (used + 2 > column)
        printf("\n%*s", column, "");
    else
        printf("%*s", column - used, "");
    hd_print_wrapped(right, column, column);
}

static void print_term(const char *term, const char *meaning) {
    print_entry(term, OPTION_COLUMN, meaning);
}

static void print_step(const char *line, const char *meaning) {
    print_entry(line, USAGE_COLUMN, meaning);
}

static void print_example(const char *line, const char *meaning) {
    printf("  %s\n%*s", line, EXAMPLE_COLUMN, "");
    hd_print_wrapped(meaning, EXAMPLE_COLUMN, EXAMPLE_COLUMN);
}

static void print_options(HdCommand command) {
    char heading[64], text[HD_EXPLANATION_SIZE];
    const HdOptionSpec *spec = NULL;
    while ((spec = hd_option_next(spec, command)) != NULL) {
        hd_option_heading(spec, heading);
        hd_option_explain(spec, text);
        print_term(heading, text);
    }
}

static void print_classic(void) {
    printf("Classic mode:\n");
    print_step("hedron [OPTIONS] < INPUT", "render a configuration from standard input");
    print_step("hedron --default", "print such a configuration");
    printf("\n");
    hd_print_wrapped(hd_command_spec(HD_COMMAND_CLASSIC)->description, 0, 0);
    printf("\nOptions of the classic mode:\n");
    print_options(HD_COMMAND_CLASSIC);
}

static void print_program(void) {
    char usage[128];
    printf("hedron %s.\n\nStart:\n", hd_program_summary);
    hd_list_explained(hd_first_steps, print_step);
    printf("\nUsage:\n");
    for (int i = 0; i < HD_COMMAND_SPEC_COUNT; i++) {
        const HdCommandSpec *spec = &hd_command_specs[i];
        if (spec->command == HD_COMMAND_CLASSIC)
            continue;
        snprintf(usage, sizeof usage, "hedron %s %s", spec->name, spec->operands);
        print_step(usage, spec->summary);
    }
    printf("\n'hedron help render' explains 'render' and its options, and so on; 'hedron help "
           "scene' every\nkey of a scene file.\n\nExamples:\n");
    hd_list_explained(hd_examples, print_example);
    printf("\nExit codes:\n");
    hd_list_explained(hd_exit_codes, print_term);
    printf("\nEnvironment:\n");
    hd_list_explained(hd_variables, print_term);
    printf("\n");
    print_classic();
}

static void print_command(const HdCommandSpec *spec) {
    char usage[128];
    hd_command_usage(spec, usage);
    printf("hedron %s: %s.\n\nUsage: %s\n\n", spec->name, spec->summary, usage);
    hd_print_wrapped(spec->description, 0, 0);
    printf("\nOptions:\n");
    print_options(spec->command);
}

/* ---- scenes ---- */

static const char small_scene[] =
    "  {\n"
    "    \"hedron\": 1,\n"
    "    \"camera\": {\"eye\": [4, -3, 2]},\n"
    "    \"materials\": {\"blue\": {\"colour\": [0.2, 0.5, 1], \"diffuse\": 0.8}},\n"
    "    \"solids\": [{\"kind\": \"cube\", \"material\": \"blue\"}],\n"
    "    \"lights\": [{\"position\": [3, -4, 5]}]\n"
    "  }\n";

static void print_object(const HdObjectType *type, const char *path) {
    char expected[HD_EXPECTED_SIZE], standard[128], text[HD_EXPLANATION_SIZE];
    printf("\n%s:\n", path[0] != '\0' ? path : "Keys");
    if (type->note != NULL) {
        printf("    ");
        hd_print_wrapped(type->note, 4, 4);
    }
    for (int i = 0; i < type->field_count; i++) {
        const HdField *field = &type->fields[i];
        const char *unit = field->measure, *kind = field->required ? "; " : "; default ";
        hd_field_expected(field, 0, expected);
        hd_field_default(field, standard);
        snprintf(text, sizeof text, "%s (%s%s%s%s%s)", field->about, expected, unit ? "; " : "",
                 unit ? unit : "", standard[0] != '\0' ? kind : "", standard);
        print_term(field->key, text);
    }
}

static void print_scene_format(void) {
    printf("A scene is a file in JSON. A small one:\n\n%s\n", small_scene);
    hd_print_wrapped(hd_scene_rules, 0, 0);
    hd_visit_scene(print_object);
}

/* ---- topics ---- */

static void print_topic(int topic) {
    if (topic == HD_HELP_SCENE)
        print_scene_format();
    else if (topic == HD_HELP_CLASSIC)
        print_classic();
    else if (topic == HD_HELP_MAN)
        hd_print_man_page();
    else if (topic == HD_HELP_BASH)
        fwrite(hd_bash_completion, 1, hd_bash_completion_size, stdout);
    else if (topic == HD_HELP_ZSH)
        fwrite(hd_zsh_completion, 1, hd_zsh_completion_size, stdout);
    else if (topic == HD_HELP_FISH)
        fwrite(hd_fish_completion, 1, hd_fish_completion_size, stdout);
    else if (topic == HD_HELP_REFERENCE_SCENE)
        hd_print_scene_reference();
    else if (topic == HD_HELP_REFERENCE_COMMANDS)
        hd_print_command_reference();
    else if (topic == HD_HELP_REFERENCE_STATISTICS)
        hd_print_statistics_reference();
}

HdStatus hd_command_help(const HdOptions *options, HdError *error) {
    (void)error;
    const HdCommandSpec *command = hd_command_named(options->topic != NULL ? options->topic : "");
    if (options->topic == NULL)
        print_program();
    else if (command != NULL)
        print_command(command);
    else
        print_topic(hd_help_topic_named(options->topic));
    return HD_OK;
}
