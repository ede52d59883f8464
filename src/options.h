/* SPDX-License-Identifier: MIT */
/* The command line. One table describes every option; parsing and help are made from it. */
#ifndef HD_OPTIONS_H
#define HD_OPTIONS_H

#include <stdio.h>

#include "backend.h"
#include "error.h"

typedef enum HdCommand {
    HD_COMMAND_CLASSIC = 1,
    HD_COMMAND_RENDER = 2,
    HD_COMMAND_DEVICES = 4,
    HD_COMMAND_HELP = 8,
    HD_COMMAND_VERSION = 16
} HdCommand;

typedef enum HdClassicMode { HD_CLASSIC_GPU, HD_CLASSIC_CPU, HD_CLASSIC_PRINT } HdClassicMode;

/* What the command line said. */
typedef struct HdOptions {
    HdCommand command;
    HdCommand help_topic;   /* of HD_COMMAND_HELP; 0: the program as a whole */
    HdClassicMode mode;     /* HD_CLASSIC_GPU if not given */
    int variant;            /* HD_CLASSIC_DEFAULT_VARIANT if not given */
    const char *output;     /* NULL: not given */
    const char *backend;    /* NULL: auto or not given */
    const char *device;     /* number or part of a name; NULL: not given */
    const char *frames;     /* NULL: not given */
    HdRenderOptions render; /* all 0 if not given: the device's lanes, a thread for each core,
                               float, strict */
    int depth, samples, width, height; /* each -1: not given */
    double cutoff;                     /* -1: not given */
} HdOptions;

/* Parses the arguments of main. Fails with HD_BAD_INPUT and a sentence that names the argument. */
HdStatus hd_options_parse(HdOptions *options, int count, char **arguments, HdError *error);

/* Prints the options of a command, two columns. */
void hd_options_print(FILE *out, HdCommand command);

#endif
