/* SPDX-License-Identifier: MIT */
/* The command line. Two tables describe it (command_table.h, option_table.h); parsing, help, man
   page and completion are made from them. */
#ifndef HD_CLI_OPTIONS_H
#define HD_CLI_OPTIONS_H

#include <stdbool.h>

#include "base/error.h"
#include "cli/command_table.h"
#include "device/renderer.h"
#include "output/outputs.h"
#include "scene/scene.h"

typedef enum HdClassicMode {
    HD_CLASSIC_UNSAID, /* as HD_CLASSIC_GPU */
    HD_CLASSIC_GPU,
    HD_CLASSIC_CPU,
    HD_CLASSIC_PRINT
} HdClassicMode;

enum { HD_MAX_CHANGES = 64 };

/* What the command line said. */
typedef struct HdOptions {
    HdCommand command;
    HdHelpTopic help_topic; /* of HD_COMMAND_HELP */
    char **operands;        /* what is no option, in order; at the front of main's arguments */
    int operand_count;
    HdClassicMode mode;
    int variant; /* HD_CLASSIC_DEFAULT_VARIANT if not given */
    const char *outputs[HD_MAX_OUTPUTS];
    int output_count;
    const char *changes[HD_MAX_CHANGES]; /* "PATH=VALUE" each */
    int change_count;
    const char *backend;    /* NULL: auto or not given */
    const char *device;     /* number or part of a name; NULL: not given */
    const char *frames;     /* NULL: not given */
    const char *statistics; /* a file, "-": standard output; NULL: not given */
    bool again;             /* finished frames are rendered again */
    bool verbose, quiet;    /* not both */
    bool tells_frames;      /* a line of progress for each frame */
    bool json;              /* of 'devices', 'tune' and 'compare' */
    bool schema;            /* of 'check' */
    HdRenderOptions render; /* all 0 if not given: the device's lanes, a thread for each core,
                               float, strict */
    HdGeometry geometry;
    int divisions; /* 0: not given */
    HdAccel accel;
    int depth, samples, width, height; /* each -1: not given */
    double cutoff, max_error;          /* each -1: not given */
    int sampling;                      /* an HdSampling; -1: not given */
    bool reference;
    struct {
        int width, height, left, top; /* width 0: not given */
    } crop;
    const char *diff;  /* a PNG file; NULL: not given */
    double fail_above; /* steps of 255; -1: not given */
    bool has_curve;    /* `curve` is given */
    HdCurve curve;
} HdOptions;

/* Parses the arguments of main, whose order it changes. Fails with HD_BAD_INPUT and a sentence that
   names the argument, and the nearest right one where there is one. */
HdStatus hd_options_parse(HdOptions *options, int count, char **arguments, HdError *error);

#endif
