/* SPDX-License-Identifier: MIT */
/* The program's commands: the table of them, with what they do, and the topics of help. */
#ifndef HD_CLI_COMMANDS_H
#define HD_CLI_COMMANDS_H

#include "base/error.h"

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

/* What there is help about, apart from commands. */
typedef struct HdHelpTopic {
    const char *name, *about; /* NULL ends the table */
    void (*print)(void);
    const unsigned char *script; /* instead of `print` */
    const size_t *script_size;
} HdHelpTopic;
extern const HdHelpTopic hd_help_topics[];
const HdHelpTopic *hd_help_topic_named(const char *name); /* NULL: none has it */

typedef struct HdOptions HdOptions;

/* What a command does; the status becomes the exit code. */
typedef HdStatus HdCommandFunction(const HdOptions *options, HdError *error);

HdCommandFunction hd_command_classic, hd_command_render, hd_command_check, hd_command_convert,
    hd_command_devices, hd_command_selftest, hd_command_tune, hd_command_compare, hd_command_new,
    hd_command_complete, hd_command_help;

typedef struct HdCommandSpec {
    HdCommand command;
    HdCommandFunction *run;  /* NULL: another program does it */
    const char *name;        /* NULL: the classic mode */
    const char *operands;    /* as the usage shows them; "" where there are none */
    const char *ending;      /* of the files that are operands; NULL: any, or no files */
    int most_operands;       /* -1: any number */
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

#endif
