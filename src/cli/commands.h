/* SPDX-License-Identifier: MIT */
/* The program's commands. Each returns the status that becomes the exit code. */
#ifndef HD_CLI_COMMANDS_H
#define HD_CLI_COMMANDS_H

#include "cli/options.h"

/* The classic mode: input on standard input, one line for each frame on standard output. */
HdStatus hd_command_classic(const HdOptions *options, HdError *error);

/* Renders a scene file, or the built-in scene. */
HdStatus hd_command_render(const HdOptions *options, HdError *error);

/* Reads scenes and says what is wrong with them. */
HdStatus hd_command_check(const HdOptions *options, HdError *error);

/* Turns a classic input into a scene file. */
HdStatus hd_command_convert(const HdOptions *options, HdError *error);

/* Lists backends and devices on standard output. */
HdStatus hd_command_devices(const HdOptions *options, HdError *error);

/* Tests what devices compute and prints a certificate for each; HD_FAILED where one is wrong. */
HdStatus hd_command_selftest(const HdOptions *options, HdError *error);

/* Measures ways to launch a device's kernels for a scene, prints them and remembers the best. */
HdStatus hd_command_tune(const HdOptions *options, HdError *error);

/* Prints how far two pictures are apart; HD_FAILED where that is too far. */
HdStatus hd_command_compare(const HdOptions *options, HdError *error);

/* Writes the scene to start from. */
HdStatus hd_command_new(const HdOptions *options, HdError *error);

/* Prints how the last word of a command line may go on, for the scripts in completions/. */
void hd_command_complete(const HdOptions *options);

/* Prints help, the man page or the completion script on standard output. */
void hd_command_help(const HdHelpTopic *topic);

/* A man page in troff, on standard output. */
void hd_print_man_page(void);

#endif
