/* SPDX-License-Identifier: MIT */
/* What the programs share: from the arguments to the exit code. */
#ifndef HD_MAIN_PROGRAM_H
#define HD_MAIN_PROGRAM_H

#include "cli/options.h"

/* Parses the command line, which the options point into afterwards, calls `run`, prints its error
   and returns the exit code. */
int hd_program_run(int count, char **arguments, HdCommandFunction *run);

#endif
