/* SPDX-License-Identifier: MIT */
/* From the arguments of main to what they say (options.h). */
#ifndef HD_CLI_COMMAND_LINE_H
#define HD_CLI_COMMAND_LINE_H

#include "cli/options.h"

/* Parses the arguments of main, whose order it changes. Fails with HD_BAD_INPUT and a sentence that
   names the argument, and the nearest right one where there is one. */
HdStatus hd_options_parse(HdOptions *options, int count, char **arguments, HdError *error);

#endif
