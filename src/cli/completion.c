/* SPDX-License-Identifier: MIT */
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "cli/commands.h"

/* What is the same whatever the tables hold. Bash cuts --name=value into three words. */
static const char beginning[] =
    "# Completion of hedron's arguments for bash, made by 'hedron help completion'.\n"
    "_hedron_files() {\n"
    "    compopt -o filenames 2>/dev/null || true\n"
    "    if [[ -z $1 ]]; then\n"
    "        mapfile -t COMPREPLY < <(compgen -f -- \"$current\")\n"
    "    else\n"
    "        mapfile -t COMPREPLY < <(compgen -d -- \"$current\" || true\n"
    "            compgen -f -X \"!*$1\" -- \"$current\")\n"
    "    fi\n"
    "}\n"
    "\n"
    "_hedron_words() {\n"
    "    mapfile -t COMPREPLY < <(compgen -W \"$1\" -- \"$current\")\n"
    "}\n"
    "\n"
    "_hedron() {\n"
    "    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]}\n"
    "    local command='' options='' commands=''\n"
    "    COMPREPLY=()\n"
    "    if [[ $current == = ]]; then\n"
    "        current=''\n"
    "    elif [[ $previous == = ]]; then\n"
    "        previous=${COMP_WORDS[COMP_CWORD - 2]}\n"
    "    fi\n";

/* True where an option before this one has the same name: both are completed alike. */
static bool is_repeated(const HdOptionSpec *spec) {
    for (const HdOptionSpec *other = hd_option_specs; other < spec; other++)
        if (strcmp(other->name, spec->name) == 0)
            return true;
    return false;
}

static void print_choices(const char *const *choices) {
    printf("        _hedron_words '%s", choices[0]);
    while (*++choices != NULL)
        printf(" %s", *choices);
    printf("'\n");
}

static void print_values(void) {
    printf("    case $previous in\n");
    for (const HdOptionSpec *spec = hd_option_specs; spec->name != NULL; spec++) {
        if (spec->value == NULL || is_repeated(spec))
            continue;
        printf("    %s", spec->name);
        if (spec->short_name != NULL)
            printf(" | %s", spec->short_name);
        printf(")\n");
        if (spec->choices != NULL)
            print_choices(spec->choices);
        else if (spec->takes_file)
            printf("        _hedron_files ''\n");
        printf("        return\n        ;;\n");
    }
    printf("    esac\n");
}

static void print_command_names(const char *separator) {
    const char *between = "";
    for (int i = 0; i < HD_COMMAND_SPEC_COUNT; i++) {
        if (hd_command_specs[i].name == NULL)
            continue;
        printf("%s%s", between, hd_command_specs[i].name);
        between = separator;
    }
}

static void print_topics(void) {
    printf("        _hedron_words '");
    print_command_names(" ");
    for (int i = HD_HELP_TEXT + 1; i < HD_HELP_FORM_COUNT; i++)
        printf(" %s", hd_help_forms[i]);
    printf("'\n");
}

static void print_option_names(HdCommand command) {
    const char *between = "";
    const HdOptionSpec *spec = NULL;
    while ((spec = hd_option_next(spec, command)) != NULL) {
        if (spec->short_name != NULL)
            printf("%s%s", between, spec->short_name);
        printf("%s%s", spec->short_name != NULL ? " " : between, spec->name);
        between = " ";
    }
}

/* What may stand where no option does. */
static void print_operands(const HdCommandSpec *spec) {
    if (spec->name == NULL)
        printf("        ((COMP_CWORD > 1)) || _hedron_words \"$commands\"\n");
    else if (spec->command == HD_COMMAND_HELP)
        print_topics();
    else if (spec->most_operands != 0)
        printf("        _hedron_files '%s'\n", spec->ending != NULL ? spec->ending : "");
}

static void print_commands(void) {
    printf("    case $command in\n");
    for (int i = 0; i < HD_COMMAND_SPEC_COUNT; i++) {
        const HdCommandSpec *spec = &hd_command_specs[i];
        printf("    %s)\n        options='", spec->name != NULL ? spec->name : "''");
        print_option_names(spec->command);
        printf("'\n");
        print_operands(spec);
        printf("        ;;\n");
    }
    printf("    esac\n");
}

void hd_print_completion(void) {
    printf("%s    commands='", beginning);
    print_command_names(" ");
    printf("'\n    if ((COMP_CWORD > 1)); then\n        case ${COMP_WORDS[1]} in\n        ");
    print_command_names(" | ");
    printf(") command=${COMP_WORDS[1]} ;;\n        esac\n    fi\n");
    print_values();
    print_commands();
    printf("    if [[ $current == -* ]]; then\n"
           "        _hedron_words \"$options\"\n"
           "    fi\n"
           "}\n"
           "complete -F _hedron hedron\n");
}
