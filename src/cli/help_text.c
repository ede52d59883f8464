/* SPDX-License-Identifier: MIT */
#include "cli/help_text.h"

#include <stdio.h>
#include <string.h>

#include "base/text.h"

enum { LINE_WIDTH = 96 };

const char hd_program_summary[] =
    "renders mirrored, transparent platonic solids with lights along their edges";

const HdExplained hd_first_steps[] = {
    {"hedron render -o film.mp4", "render the built-in scene"},
    {"hedron new scene.json", "write a scene with comments, to edit"},
    {"hedron view scene.json", "fly through it while you edit it"},
    {NULL, NULL},
};

const HdExplained hd_examples[] = {
    {"hedron render scene.json -o out/%04d.png -o film.mkv", "pictures and a film in one run"},
    {"hedron render scene.json -o big.png --frames 0 --size 1920x1080 --samples 4",
     "one large frame"},
    {"hedron render scene.json --set camera.field_of_view=40 --set image.exposure=2",
     "the scene with other values"},
    {"hedron render scene.json -o film.mp4 --stats frames.jsonl",
     "a film, and times and rays of each frame"},
    {"hedron check scene.json", "errors of a scene"},
    {"hedron tune scene.json --backend cuda", "the fastest settings for this kind of scene"},
    {"hedron compare a.png b.png --diff heat.png --fail-above 1",
     "the difference of two pictures, and whether it is too large"},
    {"hedron convert old.in -o scene.json", "a classic input as a scene file"},
    {"hedron --default | hedron --cpu --frames 0-2", "the classic mode"},
    {"source <(hedron help completion)", "completion in this bash"},
    {NULL, NULL},
};

const HdExplained hd_exit_codes[] = {
    {"0", "success"},
    {"1", "the work failed, such as writing a file"},
    {"2", "wrong command line or input"},
    {"3", "unavailable backend, device, display or program (FFmpeg, hedron-view)"},
    {"129, 130, 143", "interrupted by SIGHUP, SIGINT or SIGTERM"},
    {NULL, NULL},
};

const HdExplained hd_variables[] = {
    {"HEDRON_CACHE",
     "Folder for compiled kernels and measured settings, at most 128 MiB; off: none. Default: "
     "$XDG_CACHE_HOME/hedron, else ~/.cache/hedron."},
    {"HEDRON_NVRTC",
     "File of the NVRTC library that compiles for CUDA; off: none. Default: the newest one that "
     "suits the driver. hedron also looks in CUDA_HOME, CUDA_PATH, VIRTUAL_ENV and CONDA_PREFIX."},
    {"HEDRON_FFMPEG_PATIENCE",
     "Whole seconds that FFmpeg may be idle, 1 to 86400. Default: 600. Use: more for a slow "
     "disk."},
    {"HEDRON_STOP_PATIENCE",
     "Seconds from a signal to the end of the program, even if something hangs, 0.1 to 86400. "
     "Default: 1.5."},
    {NULL, NULL},
};

const char hd_scene_rules[] =
    "World space is right-handed and z points up. Lengths and positions are in world units of your "
    "choice. Angles are in degrees, except on a camera path, where phi0 and the phases are in "
    "radians. Colours are [red, green, blue], linear; positions are [x, y, z].\n\n"
    "Any object may have a comment, \"$comment\": \"...\". 'hedron new' writes a scene with "
    "comments, 'hedron check' reports errors, and 'hedron check --schema' prints the JSON Schema "
    "for editors. --set reaches each value by its path: '--set solids[0].kind=cube'.";

const char hd_option_rules[] =
    "Parentheses hold the commands that take an option; without them it belongs to render, view, "
    "tune and the classic mode. Options stand before or after names of files; after '--' there "
    "are only names. If an option is given twice, its last value counts, unless it is repeatable.";

/* Returns whether a word may not begin a line, since Markdown would make a list or heading of it:
   "+", "-", "#", "1.". */
static bool is_marker(const char *word, int length) {
    const int digits = (int)strspn(word, "0123456789");
    return (length == 1 && strchr("+-*>", word[0]) != NULL) || word[0] == '#' ||
           (digits > 0 && length == digits + 1 && word[digits] == '.');
}

void hd_print_wrapped(const char *text, int indent, int column) {
    for (;;) {
        text += strspn(text, " ");
        int length = (int)strcspn(text, " \n");
        if (column > indent && column + 1 + length > LINE_WIDTH && !is_marker(text, length)) {
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

void hd_command_usage(const HdCommandSpec *spec, char text[128]) {
    snprintf(text, 128, "hedron%s%s [OPTIONS]%s%s", spec->name ? " " : "",
             spec->name ? spec->name : "", spec->operands[0] != '\0' ? " " : "", spec->operands);
}

/* Returns whether the text explains each of the values. */
static bool explains_values(const HdOptionSpec *spec) {
    char explained[64];
    if (spec->choices == NULL || spec->type == HD_OPTION_SET)
        return false;
    for (const char *const *choice = spec->choices; *choice != NULL; choice++) {
        snprintf(explained, sizeof explained, "%s: ", *choice);
        if (strstr(spec->help, explained) == NULL)
            return false;
    }
    return true;
}

void hd_option_explain(const HdOptionSpec *spec, char text[HD_EXPLANATION_SIZE]) {
    char values[256];
    hd_option_values(spec, values);
    snprintf(text, HD_EXPLANATION_SIZE, "%s.", spec->help);
    if (values[0] != '\0' && !explains_values(spec))
        hd_add_text(text, HD_EXPLANATION_SIZE, " ", "Values: %s.", values);
    if (spec->standard != NULL)
        hd_add_text(text, HD_EXPLANATION_SIZE, " ", "Default: %s.", spec->standard);
    if (spec->use != NULL)
        hd_add_text(text, HD_EXPLANATION_SIZE, " ", "Use: %s.", spec->use);
}

/* Lists the commands that take an option; "" for the usual ones. */
static void list_commands(unsigned commands, char text[256]) {
    unsigned all = 0;
    text[0] = '\0';
    if (commands == HD_USUAL_COMMANDS)
        return;
    for (int i = 0; i < HD_COMMAND_SPEC_COUNT; i++) {
        const HdCommandSpec *spec = &hd_command_specs[i];
        all |= (unsigned)spec->command;
        if ((commands & (unsigned)spec->command) != 0)
            hd_add_text(text, 256, ", ", "%s", spec->name != NULL ? spec->name : "classic mode");
    }
    if ((commands & all) == all)
        snprintf(text, 256, "all commands");
}

void hd_list_options(HdEntry *entry) {
    char heading[64], text[HD_EXPLANATION_SIZE], commands[256];
    for (const HdOptionSpec *spec = hd_option_specs; spec->name != NULL; spec++) {
        hd_option_heading(spec, heading);
        hd_option_explain(spec, text);
        list_commands(spec->commands, commands);
        if (commands[0] != '\0')
            hd_add_text(text, sizeof text, " ", "(%s)", commands);
        entry(heading, text);
    }
}

void hd_field_default(const HdField *field, char text[128]) {
    char numbers[3][HD_NUMBER_SIZE];
    for (int i = 0; i < 3; i++)
        hd_short_number(field->standard[i], numbers[i]);
    text[0] = '\0';
    if (field->required)
        snprintf(text, 128, "required");
    else if (hd_field_may_be_absent(field) || (field->object != NULL && !hd_field_parts(field)))
        return;
    else if (field->type == HD_FIELD_CHOICE)
        snprintf(text, 128, "%s", hd_field_choice(field, (int)field->standard[0]));
    else if (field->type == HD_FIELD_BOOLEAN)
        snprintf(text, 128, "%s", field->standard[0] != 0.0 ? "true" : "false");
    else if (hd_field_parts(field) == 3 && field->type != HD_FIELD_SCALE)
        snprintf(text, 128, field->type == HD_FIELD_VECTORS ? "[[%s, %s, %s]]" : "[%s, %s, %s]",
                 numbers[0], numbers[1], numbers[2]);
    else
        snprintf(text, 128, "%s", numbers[0]);
}

void hd_field_path(const HdField *field, const char *path, char out[128]) {
    snprintf(out, 128, "%s%s%s%s", path, path[0] != '\0' ? "." : "", field->key,
             field->type == HD_FIELD_LIST        ? "[0]"
             : field->type == HD_FIELD_MATERIALS ? ".NAME"
                                                 : "");
}

void hd_list_explained(const HdExplained *list, HdEntry *entry) {
    for (; list->text != NULL; list++)
        entry(list->text, list->meaning);
}

static void visit_object(const HdObjectType *type, const char *path, HdObjectVisit *visit) {
    const HdObjectType *before = NULL; /* eye and target are paths both */
    char part[128];
    visit(type, path);
    for (int i = 0; i < type->field_count; i++) {
        const HdField *field = &type->fields[i];
        if (field->object == NULL || field->object == before)
            continue;
        before = field->object;
        hd_field_path(field, path, part);
        visit_object(field->object, part, visit);
    }
}

void hd_visit_scene(HdObjectVisit *visit) {
    visit_object(&hd_scene_fields, "", visit);
}
