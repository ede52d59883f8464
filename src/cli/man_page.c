/* SPDX-License-Identifier: MIT */
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "cli/commands.h"

/* Prints text in which nothing means anything to troff; an empty line begins a paragraph. */
static void print_text(const char *text) {
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

static void print_line(const char *text) {
    print_text(text);
    printf("\n");
}

/* A term in bold, and what it means. */
static void print_entry(const char *term, const char *meaning) {
    printf(".TP\n\\fB");
    print_text(term);
    printf("\\fR\n");
    print_line(meaning);
}

static void print_usage(const HdCommandSpec *spec) {
    printf("\\fBhedron%s%s\\fR [\\fIOPTIONS\\fR]", spec->name ? " " : "",
           spec->name ? spec->name : "");
    if (spec->operands[0] != '\0') {
        printf(" ");
        print_text(spec->operands);
    }
    printf("\n");
}

static void print_synopsis(void) {
    printf(".SH SYNOPSIS\n");
    for (int i = 0; i < HD_COMMAND_SPEC_COUNT; i++) {
        if (i > 0)
            printf(".br\n");
        print_usage(&hd_command_specs[i]);
    }
}

static void print_command(const HdCommandSpec *spec) {
    char heading[64];
    printf(".SS ");
    print_line(spec->name != NULL ? spec->name : "The classic mode");
    print_line(spec->description);
    printf(".PP\nOptions:\n");
    const HdOptionSpec *option = NULL;
    while ((option = hd_option_next(option, spec->command)) != NULL) {
        hd_option_heading(option, heading, sizeof heading);
        print_entry(heading, option->help);
    }
}

static void print_explained(const char *heading, const HdExplained *list, int count) {
    printf(".SH %s\n", heading);
    for (int i = 0; i < count; i++)
        print_entry(list[i].text, list[i].meaning);
}

void hd_print_man_page(void) {
    printf(".TH HEDRON 1 \"\" \"hedron " HD_VERSION "\" \"User Commands\"\n"
           ".nh\n"
           ".SH NAME\n"
           "hedron \\- ");
    print_line(hd_program_summary);
    print_synopsis();
    printf(".SH DESCRIPTION\n"
           "hedron is a ray tracer. It ");
    print_text(hd_program_summary);
    printf(", on CPUs and GPUs, to the same bytes on each.\n"
           ".SH COMMANDS\n");
    for (int i = 0; i < HD_COMMAND_SPEC_COUNT; i++)
        print_command(&hd_command_specs[i]);
    print_explained("EXIT STATUS", hd_exit_codes, HD_EXIT_CODE_COUNT);
    print_explained("ENVIRONMENT", hd_variables, HD_VARIABLE_COUNT);
    print_explained("EXAMPLES", hd_examples, HD_EXAMPLE_COUNT);
    printf(".SH SEE ALSO\n"
           ".BR ffmpeg (1)\n");
}
