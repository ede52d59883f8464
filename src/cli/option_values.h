/* SPDX-License-Identifier: MIT */
/* From the text behind an option to a value. */
#ifndef HD_CLI_OPTION_VALUES_H
#define HD_CLI_OPTION_VALUES_H

#include "cli/option_table.h"
#include "cli/options.h"

/* Lays one option over those read before; `value` is "" for one that takes none. HD_BAD_INPUT with
   the option's name, the text and what was expected. */
HdStatus hd_option_apply(HdOptions *options, const HdOptionSpec *spec, const char *value,
                         HdError *error);

#endif
