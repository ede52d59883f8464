/* SPDX-License-Identifier: MIT */
/* The texts about the program that are made from its tables. */
#ifndef HD_CLI_HELP_H
#define HD_CLI_HELP_H

/* A man page in troff. */
void hd_print_man_page(void);

/* A script for bash that completes the program's arguments. */
void hd_print_completion(void);

#endif
