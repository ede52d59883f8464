/* SPDX-License-Identifier: MIT */
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "cli/options.h"
#include "input/fields.h"

/* Made by the build from completions/. */
extern const unsigned char hd_bash_completion[], hd_zsh_completion[], hd_fish_completion[];
extern const size_t hd_bash_completion_size, hd_zsh_completion_size, hd_fish_completion_size;

enum { LINE_WIDTH = 96, OPTION_COLUMN = 22, USAGE_COLUMN = 34, EXAMPLE_COLUMN = 6 };

/* Prints words until the line is full, then goes on in the next one, indented. `column` is where
   the line stands. An empty line in the text is one in the output. */
static void print_wrapped(const char *text, int indent, int column) {
    for (;;) {
        text += strspn(text, " ");
        int length = (int)strcspn(text, " \n");
        if (column > indent && column + 1 + length > LINE_WIDTH) {
            printf("\n%*s", indent, "");
            column = indent;
        }
        column += printf("%s%.*s", column > indent ? " " : "", length, text);
        text += length;
        if (*text == '\0')
            break;
        if (*text == '\n') {
            text += strspn(text, "\n");
            printf("\n\n%*s", indent, "");
            column = indent;
        }
    }
    printf("\n");
}

/* Two columns; a left one that is too long has a line of its own. */
static void print_entry(const char *left, int column, const char *right) {
    int used = printf("  %s", left);
    if (used + 2 > column)
        printf("\n%*s", column, "");
    else
        printf("%*s", column - used, "");
    print_wrapped(right, column, column);
}

static void print_options(HdCommand command) {
    char heading[64];
    const HdOptionSpec *spec = NULL;
    while ((spec = hd_option_next(spec, command)) != NULL) {
        hd_option_heading(spec, heading, sizeof heading);
        print_entry(heading, OPTION_COLUMN, spec->help);
    }
}

/* "hedron render [OPTIONS] [SCENE.json]"; `options` is "" or " [OPTIONS]". */
static void format_usage(const HdCommandSpec *spec, const char *options, char text[128]) {
    snprintf(text, 128, "hedron%s%s%s%s%s", spec->name ? " " : "", spec->name ? spec->name : "",
             options, spec->operands[0] != '\0' ? " " : "", spec->operands);
}

static void print_explained(const char *heading, const HdExplained *list, int count) {
    printf("\n%s:\n", heading);
    for (int i = 0; i < count; i++)
        print_entry(list[i].text, OPTION_COLUMN, list[i].meaning);
}

static void print_program(void) {
    char usage[128];
    printf("hedron %s.\n\nUsage:\n", hd_program_summary);
    for (int i = 0; i < HD_COMMAND_SPEC_COUNT; i++) {
        bool is_classic = hd_command_specs[i].command == HD_COMMAND_CLASSIC;
        format_usage(&hd_command_specs[i], is_classic ? " [OPTIONS]" : "", usage);
        print_entry(usage, USAGE_COLUMN, hd_command_specs[i].summary);
    }
    print_entry("hedron --default", USAGE_COLUMN, "print such a configuration");
    printf("\n'hedron help render' explains 'render' and its options, and so on.\n"
           "\nOptions of the classic mode:\n");
    print_options(HD_COMMAND_CLASSIC);
    printf("\n");
    print_wrapped(hd_command_spec(HD_COMMAND_CLASSIC)->description, 0, 0);
    printf("\nExamples:\n");
    for (int i = 0; i < HD_EXAMPLE_COUNT; i++) {
        printf("  %s\n%*s", hd_examples[i].text, EXAMPLE_COLUMN, "");
        print_wrapped(hd_examples[i].meaning, EXAMPLE_COLUMN, EXAMPLE_COLUMN);
    }
    print_explained("Exit codes", hd_exit_codes, HD_EXIT_CODE_COUNT);
    print_explained("Environment", hd_variables, HD_VARIABLE_COUNT);
}

static void print_command(const HdCommandSpec *spec) {
    char usage[128];
    format_usage(spec, " [OPTIONS]", usage);
    printf("hedron %s: %s.\n\nUsage: %s\n\n", spec->name, spec->summary, usage);
    print_wrapped(spec->description, 0, 0);
    printf("\nOptions:\n");
    print_options(spec->command);
}

/* ---- scenes ---- */

static const char least_scene[] =
    "  {\n"
    "    \"hedron\": 1,\n"
    "    \"camera\": {\"eye\": [4, -3, 2]},\n"
    "    \"materials\": {\"blue\": {\"colour\": [0.2, 0.5, 1], \"diffuse\": 0.8}},\n"
    "    \"solids\": [{\"kind\": \"cube\", \"material\": \"blue\"}],\n"
    "    \"lights\": [{\"position\": [3, -4, 5]}]\n"
    "  }\n";

/* "default 60"; "" where there is none that can be told. */
static void format_default(const HdField *field, char text[128]) {
    char numbers[3][HD_NUMBER_SIZE];
    for (int i = 0; i < 3; i++)
        hd_short_number(field->standard[i], numbers[i]);
    text[0] = '\0';
    if (field->required)
        snprintf(text, 128, "; required");
    else if (hd_field_may_be_absent(field) || field->object != NULL)
        return;
    else if (field->type == HD_FIELD_CHOICE)
        snprintf(text, 128, "; default %s", hd_field_choice(field, (int)field->standard[0]));
    else if (field->type == HD_FIELD_BOOLEAN)
        snprintf(text, 128, "; default %s", field->standard[0] != 0.0 ? "true" : "false");
    else if (hd_field_parts(field) == 3)
        snprintf(text, 128, "; default [%s, %s, %s]", numbers[0], numbers[1], numbers[2]);
    else
        snprintf(text, 128, "; default %s", numbers[0]);
}

static void print_keys(const HdObjectType *type) {
    char expected[HD_EXPECTED_SIZE], standard[128], text[1024];
    for (int i = 0; i < type->field_count; i++) {
        const HdField *field = &type->fields[i];
        hd_field_expected(field, 0, expected);
        format_default(field, standard);
        snprintf(text, sizeof text, "%s (%s%s)", field->about, expected, standard);
        print_entry(field->key, OPTION_COLUMN, text);
    }
}

/* An object's keys, then those of its parts. `path` is where it stands; "" is the scene. */
static void print_scene_object(const HdObjectType *type, const char *path) {
    const HdObjectType *before = NULL; /* eye and target are paths both */
    char part[128];
    if (path[0] != '\0')
        printf("\n%s:\n", path);
    print_keys(type);
    for (int i = 0; i < type->field_count; i++) {
        const HdField *field = &type->fields[i];
        if (field->object == NULL || field->object == before)
            continue;
        before = field->object;
        snprintf(part, sizeof part, "%s%s%s%s", path, path[0] != '\0' ? "." : "", field->key,
                 field->type == HD_FIELD_LIST        ? "[0]"
                 : field->type == HD_FIELD_MATERIALS ? ".NAME"
                                                     : "");
        print_scene_object(field->object, part);
    }
}

static void print_scene_format(void) {
    printf("A scene is a file in JSON. A small one:\n\n%s\n", least_scene);
    print_wrapped("'hedron new' writes a larger one with comments, 'hedron check' finds mistakes, "
                  "'hedron check --schema' prints the JSON Schema for editors. The z axis points "
                  "up. Colours are linear. Any object may have a comment, \"$comment\": \"...\". "
                  "--set reaches each value by its path: --set solids[0].kind=cube.",
                  0, 0);
    printf("\nKeys:\n");
    print_scene_object(&hd_scene_fields, "");
}

/* ---- the man page, in troff ---- */

/* Prints text in which nothing means anything to troff; an empty line begins a paragraph. */
static void man_text(const char *text) {
    bool at_line_start = true;
    for (; *text != '\0'; text++) {
        if (strncmp(text, "\n\n", 2) == 0) {
            printf("\n.PP\n");
            text++;
            at_line_start = true;
            continue;
        }
        if (at_line_start && (*text == '.' || *text == '\''))
            printf("\\&");
        if (*text == '\\')
            printf("\\e");
        else if (*text == '-')
            printf("\\-");
        else if (*text == '\'')
            printf("\\(aq");
        else
            putchar(*text);
        at_line_start = *text == '\n';
    }
}

static void man_line(const char *text) {
    man_text(text);
    printf("\n");
}

/* A term in bold, and what it means. */
static void man_entry(const char *term, const char *meaning) {
    printf(".TP\n\\fB");
    man_text(term);
    printf("\\fR\n");
    man_line(meaning);
}

static void man_synopsis(void) {
    printf(".SH SYNOPSIS\n");
    for (int i = 0; i < HD_COMMAND_SPEC_COUNT; i++) {
        const HdCommandSpec *spec = &hd_command_specs[i];
        printf("%s\\fBhedron%s%s\\fR [\\fIOPTIONS\\fR]%s", i > 0 ? ".br\n" : "",
               spec->name ? " " : "", spec->name ? spec->name : "",
               spec->operands[0] != '\0' ? " " : "");
        man_line(spec->operands);
    }
}

static void man_command(const HdCommandSpec *spec) {
    char heading[64];
    printf(".SS ");
    man_line(spec->name != NULL ? spec->name : "The classic mode");
    man_line(spec->description);
    printf(".PP\nOptions:\n");
    const HdOptionSpec *option = NULL;
    while ((option = hd_option_next(option, spec->command)) != NULL) {
        hd_option_heading(option, heading, sizeof heading);
        man_entry(heading, option->help);
    }
}

static void man_explained(const char *heading, const HdExplained *list, int count) {
    printf(".SH %s\n", heading);
    for (int i = 0; i < count; i++)
        man_entry(list[i].text, list[i].meaning);
}

static void print_man_page(void) {
    printf(".TH HEDRON 1 \"\" \"hedron " HD_VERSION "\" \"User Commands\"\n"
           ".nh\n"
           ".SH NAME\n"
           "hedron \\- ");
    man_line(hd_program_summary);
    man_synopsis();
    printf(".SH DESCRIPTION\n"
           "hedron is a ray tracer. It ");
    man_text(hd_program_summary);
    printf(", on CPUs and GPUs, to the same bytes on each.\n"
           ".SH COMMANDS\n");
    for (int i = 0; i < HD_COMMAND_SPEC_COUNT; i++)
        man_command(&hd_command_specs[i]);
    man_explained("EXIT STATUS", hd_exit_codes, HD_EXIT_CODE_COUNT);
    man_explained("ENVIRONMENT", hd_variables, HD_VARIABLE_COUNT);
    man_explained("EXAMPLES", hd_examples, HD_EXAMPLE_COUNT);
    printf(".SH SEE ALSO\n"
           ".BR ffmpeg (1)\n");
}

/* ---- topics ---- */

static void print_topic(int topic) {
    if (topic == HD_HELP_SCENE)
        print_scene_format();
    else if (topic == HD_HELP_MAN)
        print_man_page();
    else if (topic == HD_HELP_BASH)
        fwrite(hd_bash_completion, 1, hd_bash_completion_size, stdout);
    else if (topic == HD_HELP_ZSH)
        fwrite(hd_zsh_completion, 1, hd_zsh_completion_size, stdout);
    else if (topic == HD_HELP_FISH)
        fwrite(hd_fish_completion, 1, hd_fish_completion_size, stdout);
}

HdStatus hd_command_help(const HdOptions *options, HdError *error) {
    (void)error;
    if (options->topic == NULL)
        print_program();
    else if (hd_command_named(options->topic) != NULL)
        print_command(hd_command_named(options->topic));
    else
        print_topic(hd_help_topic_named(options->topic));
    return HD_OK;
}
