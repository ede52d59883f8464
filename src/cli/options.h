/* SPDX-License-Identifier: MIT */
/* Describes the command line as tables of commands and options, and holds the parsed options in the
   struct whose members the tables name. Parsing, help, man page and completion follow the tables.
 */
#ifndef HD_CLI_OPTIONS_H
#define HD_CLI_OPTIONS_H

#include <stdbool.h>
#include <stddef.h>

#include "base/error.h"
#include "run/plan.h"

/* Each is a bit, so that an option can list its commands. */
typedef enum HdCommand {
    HD_COMMAND_CLASSIC = 1, /* no command */
    HD_COMMAND_RENDER = 2,
    HD_COMMAND_CHECK = 4,
    HD_COMMAND_CONVERT = 8,
    HD_COMMAND_DEVICES = 16,
    HD_COMMAND_TUNE = 32,
    HD_COMMAND_HELP = 64,
    HD_COMMAND_VERSION = 128,
    HD_COMMAND_COMPARE = 256,
    HD_COMMAND_NEW = 512,
    HD_COMMAND_COMPLETE = 1024,
    HD_COMMAND_SELFTEST = 2048,
    HD_COMMAND_VIEW = 4096
} HdCommand;

/* Commands that render or measure: most options belong to them. */
#define HD_USUAL_COMMANDS                                                                          \
    (HD_COMMAND_CLASSIC | HD_COMMAND_RENDER | HD_COMMAND_TUNE | HD_COMMAND_VIEW)

/* Parsed command line: the parts of the plan, each for its reader, and the options of single
   commands. A member whose option is not given is 0, false or NULL, or negative if 0 is a value. */
typedef struct HdOptions {
    HdCommand command;
    const char *topic; /* of HD_COMMAND_HELP: a command or a topic; NULL: the program */
    char **operands; /* arguments that are no options, in order; at the front of main's arguments */
    int operand_count;
    HdScenePlan scene;
    HdDevicePlan devices;
    HdStorePlan store;
    HdReportPlan reporting;
#define ROW(...)
#define OPTION(member, ...) member;
#include "cli/option_table.h"
#undef ROW
#undef OPTION
} HdOptions;

/* ---- commands ---- */

/* Topics of the help, except commands. */
enum {
    HD_HELP_SCENE,
    HD_HELP_CLASSIC,
    HD_HELP_MAN,
    HD_HELP_BASH,
    HD_HELP_ZSH,
    HD_HELP_FISH,
    HD_HELP_REFERENCE_SCENE, /* pages of docs/reference, in Markdown, for ./dev docs */
    HD_HELP_REFERENCE_COMMANDS,
    HD_HELP_REFERENCE_STATISTICS,
    HD_HELP_TOPIC_COUNT
};
typedef struct HdHelpTopic {
    const char *name;
    const char *about; /* NULL: not listed */
} HdHelpTopic;
extern const HdHelpTopic hd_help_topics[HD_HELP_TOPIC_COUNT];
int hd_help_topic_named(const char *name); /* Returns the topic of that name; negative: none. */

/* Runs a command; the status becomes the exit code. */
typedef HdStatus HdCommandFunction(const HdOptions *options, HdError *error);

HdCommandFunction hd_command_classic, hd_command_render, hd_command_check, hd_command_convert,
    hd_command_devices, hd_command_selftest, hd_command_tune, hd_command_compare, hd_command_new,
    hd_command_complete, hd_command_help;

typedef struct HdCommandSpec {
    HdCommand command;
    const char *name;        /* NULL: the classic mode */
    const char *operands;    /* text of the usage; "": none */
    const char *ending;      /* file extension of operands; NULL: any, or no files */
    int max_operands;        /* -1: any number */
    const char *summary;     /* half a sentence, for lists */
    const char *description; /* paragraphs, separated by empty lines */
} HdCommandSpec;

enum { HD_COMMAND_SPEC_COUNT = 12 };
extern const HdCommandSpec hd_command_specs[HD_COMMAND_SPEC_COUNT];

/* Returns the command of that name, or NULL. */
const HdCommandSpec *hd_command_named(const char *name);
const HdCommandSpec *hd_command_spec(HdCommand command);

/* Runs a program from its arguments to the exit code: parses the command line, which the options
   then point into, calls `run` and prints its error. */
int hd_program_run(int count, char **arguments, HdCommandFunction *run);

/* ---- options ---- */

/* Syntax of an option's value, and the member that it sets. */
typedef enum HdOptionType {
    HD_OPTION_FLAG,    /* no value; bool */
    HD_OPTION_COMMAND, /* no value; switches to another command, which ends parsing */
    HD_OPTION_INTEGER, /* whole number from `low` to `high`; int */
    HD_OPTION_REAL,    /* number from `low` to `high`, or to below it; double */
    HD_OPTION_CHOICE,  /* one of `choices`; int or an enum: its index */
    HD_OPTION_NUMERAL, /* one of `choices`, which are whole numbers; int */
    HD_OPTION_WORD,    /* one of `choices`; const char *: the word, NULL: the first choice */
    HD_OPTION_SET,     /* some of `choices`, with commas; unsigned: the bit 1 << i for choice i */
    HD_OPTION_SIZE,    /* WxH; HdPlannedArea, at 0, 0 */
    HD_OPTION_CROP,    /* WxH+X+Y; HdPlannedArea */
    HD_OPTION_TEXT,    /* const char * */
    HD_OPTION_TEXTS    /* repeatable text, `high` times at most; const char *[], and their count */
} HdOptionType;

/* Effect of an option. */
typedef enum HdOptionRole {
    HD_DECIDES_NO_PIXEL, /* devices, outputs, messages */
    HD_DECIDES_NUMBERS,  /* pixels, through numbers of the scene */
    HD_DECIDES_PIXELS    /* pixels, in other ways */
} HdOptionRole;

typedef struct HdOptionSpec {
    const char *name;       /* NULL ends the table */
    const char *short_name; /* NULL: none */
    const char *value;      /* the value's placeholder in the help; NULL: no value */
    const char *help;       /* effect: sentences, the last one without a full stop */
    unsigned commands;      /* commands that accept it */
    const char *standard;   /* default; NULL: none, or off */
    const char *use;        /* when to use it, as a sentence without a full stop; NULL: plain */
    HdOptionRole role;
    HdOptionType type;
    size_t offset;              /* offset of its member in HdOptions */
    size_t count_offset;        /* offset of the count of texts */
    double low, high;           /* bounds of a number */
    bool below_high;            /* excludes `high` itself */
    int step;                   /* a whole number is a multiple of this; 0: any */
    const char *const *choices; /* NULL ends them */
    const char *expected;       /* expected value, for messages; NULL: the text may be empty */
    HdStatus (*check)(const char *text, const char *option, HdError *error); /* NULL: any text */
    bool takes_file;
    const char *only_one_of; /* name of flags that exclude each other; NULL: none */
    HdCommand command;       /* command that it switches to */
} HdOptionSpec;

/* Values of --curve, by HdCurve; ends with NULL. */
extern const char *const hd_curve_names[];

/* All options. An option may occur twice, with another meaning for another command. */
extern const HdOptionSpec hd_option_specs[];

/* Returns the command's next option after `spec` (NULL: the first), or NULL. */
const HdOptionSpec *hd_option_next(const HdOptionSpec *spec, HdCommand command);

/* Returns the option that an argument names as "--name", "--name=value", "-n" or "-nvalue", or
   NULL; sets `*value` to its value, or NULL. Prefers an option of the command to one of the same
   name of another command. */
const HdOptionSpec *hd_option_find(const char *argument, HdCommand command, const char **value);

/* Writes "-o, --output OUT". */
void hd_option_heading(const HdOptionSpec *spec, char text[64]);

/* Writes the values that an option takes: "1 to 64", "float or double"; "" for a free text. */
void hd_option_values(const HdOptionSpec *spec, char text[256]);

/* Parses the arguments of main, and reorders them. Fails with HD_BAD_INPUT and a message that names
   the argument and the nearest correct one, if any. */
HdStatus hd_options_parse(HdOptions *options, int count, char **arguments, HdError *error);

#endif
