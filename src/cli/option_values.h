/* SPDX-License-Identifier: MIT */
/* From the text behind an option to the member that it sets. */
#ifndef HD_CLI_OPTION_VALUES_H
#define HD_CLI_OPTION_VALUES_H

#include "cli/options.h"

/* What there is where no option is given. */
void hd_options_reset(HdOptions *options);

/* Lays one option over those read before; `value` is "" for one that takes none. HD_BAD_INPUT with
   the option's name, the text and what was expected. */
HdStatus hd_option_apply(HdOptions *options, const HdOptionSpec *spec, const char *value,
                         HdError *error);

/* The number of `text` among the choices, from 0; -1: it is none of them. */
int hd_option_choice(const char *const *choices, const char *text);

/* The choices as people list them: "auto, c, opencl or cuda". */
void hd_option_list_choices(const char *const *choices, char *text, int capacity);

#endif
