/* SPDX-License-Identifier: MIT */
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "cli/commands.h"

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

void hd_command_help(const HdHelpTopic *topic) {
    if (topic->form == HD_HELP_MAN)
        hd_print_man_page();
    else if (topic->form == HD_HELP_COMPLETION)
        hd_print_completion();
    else if (topic->command == HD_COMMAND_CLASSIC)
        print_program();
    else
        print_command(hd_command_spec(topic->command));
}
