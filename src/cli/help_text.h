/* SPDX-License-Identifier: MIT */
/* Texts that the help, the man page and the references share, and how they are set. */
#ifndef HD_CLI_HELP_TEXT_H
#define HD_CLI_HELP_TEXT_H

#include "cli/options.h"
#include "input/fields.h"

enum { HD_EXPLANATION_SIZE = 1024 };

/* A term and its meaning. */
typedef struct HdExplained {
    const char *text, *meaning;
} HdExplained;

/* NULL ends each list. */
extern const HdExplained hd_first_steps[], hd_examples[], hd_exit_codes[], hd_variables[];

extern const char hd_program_summary[];

/* Rules for every scene file; paragraphs, separated by empty lines. */
extern const char hd_scene_rules[];

/* Prints words up to the width of a line, then indents the next one. `column` is where the line
   stands. An empty line in the text is one in the output. */
void hd_print_wrapped(const char *text, int indent, int column);

/* Writes the usage of a command: "hedron render [OPTIONS] [SCENE.json]". */
void hd_command_usage(const HdCommandSpec *spec, char text[128]);

/* Writes all about an option: effect, values, default, when to use it. */
void hd_option_explain(const HdOptionSpec *spec, char text[HD_EXPLANATION_SIZE]);

/* Writes the default of a key of a scene: "60", "required"; "" if there is none. */
void hd_field_default(const HdField *field, char text[128]);

/* Writes the path of a field in the object at `path` ("": the scene): "solids[0].rim". */
void hd_field_path(const HdField *field, const char *path, char out[128]);

/* Writes a term and its meaning in one of the forms. */
typedef void HdEntry(const char *term, const char *meaning);
void hd_list_explained(const HdExplained *list, HdEntry *entry);

/* Lists each option once, with the commands that take it. If a name has two meanings, each comes
   once. hd_option_rules explains the list. */
void hd_list_options(HdEntry *entry);
extern const char hd_option_rules[];

/* Visits an object of a scene and those in it, each once, with its path ("": the scene). */
typedef void HdObjectVisit(const HdObjectType *type, const char *path);
void hd_visit_scene(HdObjectVisit *visit);

/* Print the man page in troff, and the pages of docs/reference in Markdown. */
void hd_print_man_page(void);
void hd_print_scene_reference(void);
void hd_print_command_reference(void);
void hd_print_statistics_reference(void);

#endif
