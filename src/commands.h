/* SPDX-License-Identifier: MIT */
/* The program's commands. Each returns the status that becomes the exit code. */
#ifndef HD_COMMANDS_H
#define HD_COMMANDS_H

#include "options.h"

/* The classic mode: input on standard input, one line for each frame on standard output. */
HdStatus hd_command_classic(const HdOptions *options, HdError *error);

/* Renders the embedded default scene. */
HdStatus hd_command_render(const HdOptions *options, HdError *error);

/* Lists backends and devices on standard output. */
HdStatus hd_command_devices(HdError *error);

/* Prints the help of one command, or with 0 of the whole program, on standard output. */
void hd_command_help(HdCommand topic);

#endif
