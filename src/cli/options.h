/* SPDX-License-Identifier: MIT */
/* What the command line may say, as tables of commands and options, and what it said, as the struct
   whose members the options' rows name. Parsing, help, man page and completion follow the tables.
 */
#ifndef HD_CLI_OPTIONS_H
#define HD_CLI_OPTIONS_H

#include <stdbool.h>
#include <stddef.h>

#include "base/error.h"
#include "run/plan.h"

/* Each is a bit, for the options to tell which commands they belong to. */
typedef enum HdCommand {
    HD_COMMAND_CLASSIC = 1, /* no command at all */
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

/* What the command line said: the parts of the plan, each for its reader, and what belongs to a
   single command. Where an option is not given, its member is 0, false or NULL, or negative where 0
   is a value. */
typedef struct HdOptions {
    HdCommand command;
    const char *topic; /* of HD_COMMAND_HELP: a command or a topic; NULL: the program */
    char **operands;   /* what is no option, in order; at the front of main's arguments */
    int operand_count;
    HdScenePlan scene;
    HdDevicePlan devices;
    HdStorePlan store;
    HdTelling telling;
#define ROW(...)
#define OPTION(member, ...) member;
#include "cli/option_table.h"
#undef ROW
#undef OPTION
} HdOptions;

/* ---- commands ---- */

/* Topics of help that are not commands. */
enum {
    HD_HELP_SCENE,
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
int hd_help_topic_named(const char *name); /* negative: none has it */

/* What a command does; the status becomes the exit code. */
typedef HdStatus HdCommandFunction(const HdOptions *options, HdError *error);

HdCommandFunction hd_command_classic, hd_command_render, hd_command_check, hd_command_convert,
    hd_command_devices, hd_command_selftest, hd_command_tune, hd_command_compare, hd_command_new,
    hd_command_complete, hd_command_help;

typedef struct HdCommandSpec {
    HdCommand command;
    const char *name;        /* NULL: the classic mode */
    const char *operands;    /* as the usage shows them; "" where there are none */
    const char *ending;      /* of the files that are operands; NULL: any, or no files */
    int max_operands;        /* -1: any number */
    const char *summary;     /* half a sentence for lists */
    const char *description; /* paragraphs, separated by empty lines */
} HdCommandSpec;

enum { HD_COMMAND_SPEC_COUNT = 12 };
extern const HdCommandSpec hd_command_specs[HD_COMMAND_SPEC_COUNT];

/* NULL where no command has that name. */
const HdCommandSpec *hd_command_named(const char *name);
const HdCommandSpec *hd_command_spec(HdCommand command);

/* What the programs share, from the arguments to the exit code: parses the command line, which the
   options point into afterwards, calls `run` and prints its error. */
int hd_program_run(int count, char **arguments, HdCommandFunction *run);

/* ---- options ---- */

/* What is behind an option, and the member that it sets. */
typedef enum HdOptionType {
    HD_OPTION_FLAG,    /* nothing; bool */
    HD_OPTION_COMMAND, /* nothing; another command takes over, and no argument is read any more */
    HD_OPTION_INTEGER, /* a whole number from `low` to `high`; int */
    HD_OPTION_REAL,    /* a number from `low` to `high`, or to below it; double */
    HD_OPTION_CHOICE,  /* one of `choices`; int or an enum: which of them, from 0 */
    HD_OPTION_NUMERAL, /* one of `choices`, which are whole numbers; int */
    HD_OPTION_WORD,    /* one of `choices`; const char *: the word, NULL: the first of them */
    HD_OPTION_SET,     /* some of `choices`, with commas; unsigned: the bit 1 << i for number i */
    HD_OPTION_SIZE,    /* WxH; HdPlannedArea, at 0, 0 */
    HD_OPTION_CROP,    /* WxH+X+Y; HdPlannedArea */
    HD_OPTION_TEXT,    /* const char * */
    HD_OPTION_TEXTS /* a text each time, `high` times at most; const char *[], and their number */
} HdOptionType;

/* What an option decides. */
typedef enum HdOptionRole {
    HD_DECIDES_NO_PIXEL, /* devices, outputs, what is told */
    HD_DECIDES_NUMBERS,  /* pixels, by numbers of the scene */
    HD_DECIDES_PIXELS    /* pixels, in another way */
} HdOptionRole;

typedef struct HdOptionSpec {
    const char *name;       /* NULL ends the table */
    const char *short_name; /* NULL: none */
    const char *value;      /* what stands for the value in the help; NULL: takes none */
    const char *help;       /* effect: sentences, the last one without a full stop */
    unsigned commands;      /* those that take it */
    const char *standard;   /* default; NULL: none, or off */
    const char *use;        /* when to use it, as a sentence without a full stop; NULL: plain */
    HdOptionRole role;
    HdOptionType type;
    size_t offset;              /* of its member of HdOptions */
    size_t count_offset;        /* of texts */
    double low, high;           /* of a number */
    bool below_high;            /* a number must not be `high` itself */
    int step;                   /* a whole number is a multiple of it; 0: any */
    const char *const *choices; /* NULL ends them */
    const char *expected;       /* instead of a wrong value; NULL for a text that may be empty */
    HdStatus (*check)(const char *text, const char *option, HdError *error); /* NULL: any text */
    bool takes_file;
    const char *only_one_of; /* the flags of which only one may be given; NULL: no such flag */
    HdCommand command;       /* that takes over */
} HdOptionSpec;

/* What --curve may be, by HdCurve; NULL ends them. */
extern const char *const hd_curve_names[];

/* An option may be there twice, with another meaning for another command. */
extern const HdOptionSpec hd_option_specs[];

/* The option of the command that follows after `spec` (NULL: the first one), or NULL. */
const HdOptionSpec *hd_option_next(const HdOptionSpec *spec, HdCommand command);

/* The option that an argument names as "--name", "--name=value", "-n" or "-nvalue", or NULL;
   `*value` is what came with it, or NULL. One of the command comes before one of the same name that
   belongs to another. */
const HdOptionSpec *hd_option_find(const char *argument, HdCommand command, const char **value);

/* Writes "-o, --output OUT". */
void hd_option_heading(const HdOptionSpec *spec, char text[64]);

/* Writes the values that an option takes: "1 to 64", "float or double"; "" for a free text. */
void hd_option_values(const HdOptionSpec *spec, char text[256]);

/* Parses the arguments of main, whose order it changes. Fails with HD_BAD_INPUT and a sentence that
   names the argument, and the nearest right one where there is one. */
HdStatus hd_options_parse(HdOptions *options, int count, char **arguments, HdError *error);

#endif
