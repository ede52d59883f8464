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

static const char program_summary[] =
    "renders mirrored, transparent platonic solids with lights along their edges";

/* ---- what help and man page share; NULL ends lists ---- */

typedef struct Explained {
    const char *text, *meaning;
} Explained;

static const Explained exit_codes[] = {
    {"0", "done"},
    {"1", "failed"},
    {"2", "wrong usage or input"},
    {"3", "no such backend, device, display or program (FFmpeg, hedron-view)"},
    {"129, 130, 143", "interrupted by SIGHUP, SIGINT or SIGTERM"},
    {NULL, NULL},
};

static const Explained examples[] = {
    {"hedron render -o film.mp4", "the built-in scene, all frames"},
    {"hedron render scene.json -o out/%04d.png -o film.mkv", "pictures and a film in one run"},
    {"hedron render scene.json -o big.png --frames 0 --size 1920x1080 --samples 4",
     "one frame, large"},
    {"hedron render scene.json --set camera.field_of_view=40 --set image.exposure=2",
     "values of the scene replaced"},
    {"hedron render scene.json -o film.mp4 --stats frames.jsonl",
     "times and rays of each frame, a line of JSON each"},
    {"hedron new first.json && hedron render first.json -o first.mp4", "a scene of your own"},
    {"hedron view scene.json", "the scene in a window, shown again whenever its file is saved"},
    {"hedron check scene.json", "mistakes of a scene"},
    {"hedron tune scene.json --backend cuda", "what renders this kind of scene fastest there"},
    {"hedron compare a.png b.png --diff heat.png --fail-above 1",
     "how far apart two pictures are, where, and whether that is too much"},
    {"hedron convert old.in -o scene.json", "from the classic input to JSON"},
    {"hedron --default | hedron --cpu --frames 0-2", "the classic mode"},
    {"source <(hedron help completion)", "completion for this bash"},
    {NULL, NULL},
};

static const Explained variables[] = {
    {"HEDRON_CACHE", "folder of compiled kernels and of what was measured (default "
                     "$XDG_CACHE_HOME/hedron, else ~/.cache/hedron); off: none"},
    {"HEDRON_NVRTC",
     "file of the NVRTC library that compiles for CUDA, or off (default: the newest one that "
     "suits the driver)"},
    {"HEDRON_FFMPEG_PATIENCE", "whole seconds for which FFmpeg may stand still (default 600)"},
    {"HEDRON_STOP_PATIENCE", "seconds from a signal to the end, whatever hangs (default 1.5)"},
    {NULL, NULL},
};

/* ---- plain text ---- */

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

/* Writes a term and what it means: as text, or for the man page. */
typedef void Entry(const char *term, const char *meaning);

static void print_term(const char *term, const char *meaning) {
    print_entry(term, OPTION_COLUMN, meaning);
}

static void list_options(HdCommand command, Entry *entry) {
    char heading[64];
    const HdOptionSpec *spec = NULL;
    while ((spec = hd_option_next(spec, command)) != NULL) {
        hd_option_heading(spec, heading);
        entry(heading, spec->help);
    }
}

static void list_explained(const Explained *list, Entry *entry) {
    for (; list->text != NULL; list++)
        entry(list->text, list->meaning);
}

/* "hedron render [OPTIONS] [SCENE.json]"; `options` is "" or " [OPTIONS]". */
static void format_usage(const HdCommandSpec *spec, const char *options, char text[128]) {
    snprintf(text, 128, "hedron%s%s%s%s%s", spec->name ? " " : "", spec->name ? spec->name : "",
             options, spec->operands[0] != '\0' ? " " : "", spec->operands);
}

/* On a line of its own each. */
static void print_example(const char *line, const char *meaning) {
    printf("  %s\n%*s", line, EXAMPLE_COLUMN, "");
    print_wrapped(meaning, EXAMPLE_COLUMN, EXAMPLE_COLUMN);
}

static void print_program(void) {
    char usage[128];
    printf("hedron %s.\n\nUsage:\n", program_summary);
    for (int i = 0; i < HD_COMMAND_SPEC_COUNT; i++) {
        bool is_classic = hd_command_specs[i].command == HD_COMMAND_CLASSIC;
        format_usage(&hd_command_specs[i], is_classic ? " [OPTIONS]" : "", usage);
        print_entry(usage, USAGE_COLUMN, hd_command_specs[i].summary);
    }
    print_entry("hedron --default", USAGE_COLUMN, "print such a configuration");
    printf("\n'hedron help render' explains 'render' and its options, and so on.\n"
           "\nOptions of the classic mode:\n");
    list_options(HD_COMMAND_CLASSIC, print_term);
    printf("\n");
    print_wrapped(hd_command_spec(HD_COMMAND_CLASSIC)->description, 0, 0);
    printf("\nExamples:\n");
    list_explained(examples, print_example);
    printf("\nExit codes:\n");
    list_explained(exit_codes, print_term);
    printf("\nEnvironment:\n");
    list_explained(variables, print_term);
}

static void print_command(const HdCommandSpec *spec) {
    char usage[128];
    format_usage(spec, " [OPTIONS]", usage);
    printf("hedron %s: %s.\n\nUsage: %s\n\n", spec->name, spec->summary, usage);
    print_wrapped(spec->description, 0, 0);
    printf("\nOptions:\n");
    list_options(spec->command, print_term);
}

/* ---- scenes ---- */

static const char min_scene[] =
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
    printf("A scene is a file in JSON. A small one:\n\n%s\n", min_scene);
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
    printf(".SS ");
    man_line(spec->name != NULL ? spec->name : "The classic mode");
    man_line(spec->description);
    printf(".PP\nOptions:\n");
    list_options(spec->command, man_entry);
}

static void print_man_page(void) {
    printf(".TH HEDRON 1 \"\" \"hedron " HD_VERSION "\" \"User Commands\"\n"
           ".nh\n"
           ".SH NAME\n"
           "hedron \\- ");
    man_line(program_summary);
    man_synopsis();
    printf(".SH DESCRIPTION\n"
           "hedron is a ray tracer. It ");
    man_text(program_summary);
    printf(", on CPUs and GPUs, to the same bytes on each.\n"
           ".SH COMMANDS\n");
    for (int i = 0; i < HD_COMMAND_SPEC_COUNT; i++)
        man_command(&hd_command_specs[i]);
    printf(".SH EXIT STATUS\n");
    list_explained(exit_codes, man_entry);
    printf(".SH ENVIRONMENT\n");
    list_explained(variables, man_entry);
    printf(".SH EXAMPLES\n");
    list_explained(examples, man_entry);
    printf(".SH SEE ALSO\n"
           ".BR ffmpeg (1)\n");
}

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
    const HdCommandSpec *command = hd_command_named(options->topic != NULL ? options->topic : "");
    if (options->topic == NULL)
        print_program();
    else if (command != NULL)
        print_command(command);
    else
        print_topic(hd_help_topic_named(options->topic));
    return HD_OK;
}
