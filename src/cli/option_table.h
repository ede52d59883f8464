/* SPDX-License-Identifier: MIT */
/* The program's options as a table. */
#ifndef HD_CLI_OPTION_TABLE_H
#define HD_CLI_OPTION_TABLE_H

#include <stdbool.h>
#include <stddef.h>

typedef enum HdOptionId {
    HD_OPTION_GPU,
    HD_OPTION_CPU,
    HD_OPTION_DEFAULT,
    HD_OPTION_VARIANT,
    HD_OPTION_OUTPUT,
    HD_OPTION_SET,
    HD_OPTION_FRAMES,
    HD_OPTION_AGAIN,
    HD_OPTION_SIZE,
    HD_OPTION_SAMPLES,
    HD_OPTION_DEPTH,
    HD_OPTION_CUTOFF,
    HD_OPTION_CROP,
    HD_OPTION_AA,
    HD_OPTION_MAX_ERROR,
    HD_OPTION_REFERENCE,
    HD_OPTION_BACKEND,
    HD_OPTION_DEVICE,
    HD_OPTION_LANES,
    HD_OPTION_THREADS,
    HD_OPTION_PIPELINE,
    HD_OPTION_BLOCK,
    HD_OPTION_GRID,
    HD_OPTION_GEOMETRY,
    HD_OPTION_DIVISIONS,
    HD_OPTION_ACCEL,
    HD_OPTION_PRECISION,
    HD_OPTION_MATH,
    HD_OPTION_STATS,
    HD_OPTION_VERBOSE,
    HD_OPTION_QUIET,
    HD_OPTION_FRAME_LINES,
    HD_OPTION_SCHEMA,
    HD_OPTION_JSON,
    HD_OPTION_DIFF,
    HD_OPTION_FAIL_ABOVE,
    HD_OPTION_CURVE,
    HD_OPTION_HELP,
    HD_OPTION_VERSION
} HdOptionId;

typedef struct HdOptionSpec {
    HdOptionId id;
    const char *name;
    const char *short_name; /* NULL: none */
    const char *value;      /* what stands for the value in the help; NULL: takes none */
    const char *choices;    /* all values, separated by spaces; NULL: no fixed list */
    bool takes_file;
    int least, most; /* of a whole number; both 0: it is none */
    unsigned commands;
    const char *help;
} HdOptionSpec;

/* An option may be there twice, with another meaning for another command. */
enum { HD_OPTION_SPEC_COUNT = 42 };
extern const HdOptionSpec hd_option_specs[HD_OPTION_SPEC_COUNT];

/* The number of `text` among the choices, from 0; -1: it is none of them. */
int hd_option_choice(const char *choices, const char *text);

/* The length of the first choice that begins with `text`, and where it starts; 0: there is none, or
   the text is empty. */
size_t hd_option_completed(const char *choices, const char *text, const char **word);

/* The choices as people list them: "auto, c, opencl or cuda". */
void hd_option_list_choices(const char *choices, char *text, int capacity);

/* "-o, --output OUT" */
void hd_option_heading(const HdOptionSpec *spec, char *text, int capacity);

#endif
