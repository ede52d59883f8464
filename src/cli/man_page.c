/* SPDX-License-Identifier: MIT */
/* The man page, in troff. */
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "cli/help_text.h"

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

/* Prints a term in bold, and its meaning. */
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
    printf(".SS ");
    man_line(spec->name != NULL ? spec->name : "The classic mode");
    man_line(spec->description);
}

static void man_object(const HdObjectType *type, const char *path) {
    char expected[HD_EXPECTED_SIZE], standard[128], text[HD_EXPLANATION_SIZE];
    printf(".SS ");
    man_line(path[0] != '\0' ? path : "Top level");
    if (type->note != NULL)
        man_line(type->note);
    for (int i = 0; i < type->field_count; i++) {
        const HdField *field = &type->fields[i];
        hd_field_describe(field, text);
        hd_field_expected(field, 0, expected);
        hd_field_default(field, standard);
        hd_add_text(text, sizeof text, ": ", "%s", expected);
        if (standard[0] != '\0')
            hd_add_text(text, sizeof text, field->required ? "; " : "; default ", "%s", standard);
        man_entry(field->key, text);
    }
}

void hd_print_man_page(void) {
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
    printf(".SH OPTIONS\n");
    man_line(hd_option_rules);
    hd_list_options(man_entry);
    printf(".SH SCENE FILES\n");
    man_line(hd_scene_rules);
    hd_visit_scene(man_object);
    printf(".SH EXIT STATUS\n");
    hd_list_explained(hd_exit_codes, man_entry);
    printf(".SH ENVIRONMENT\n");
    hd_list_explained(hd_variables, man_entry);
    printf(".SH EXAMPLES\n");
    hd_list_explained(hd_first_steps, man_entry);
    hd_list_explained(hd_examples, man_entry);
    printf(".SH SEE ALSO\n"
           ".BR ffmpeg (1),\n"
           ".BR ffprobe (1)\n"
           ".PP\n");
    man_line("The tutorial and the references are in share/doc/hedron/docs.");
}
