/* SPDX-License-Identifier: MIT */
/* The program 'hedron': its commands. */
#include <stdio.h>
#include <stdlib.h>

#include "cli/options.h"
#include "main/program.h"
#include "view/start_window.h"
#include "view/terminal.h"

static char **original_arguments; /* for the program that opens windows */

static HdStatus view(const HdOptions *options, HdError *error) {
    const HdViewPlan plan = {options->scene, options->devices};
    return options->terminal ? hd_view_in_terminal(&plan, error)
                             : hd_start_window(original_arguments, error);
}

static HdStatus run(const HdOptions *options, HdError *error) {
    switch (options->command) {
    case HD_COMMAND_CLASSIC:
        return hd_command_classic(options, error);
    case HD_COMMAND_RENDER:
        return hd_command_render(options, error);
    case HD_COMMAND_CHECK:
        return hd_command_check(options, error);
    case HD_COMMAND_CONVERT:
        return hd_command_convert(options, error);
    case HD_COMMAND_DEVICES:
        return hd_command_devices(options, error);
    case HD_COMMAND_SELFTEST:
        return hd_command_selftest(options, error);
    case HD_COMMAND_TUNE:
        return hd_command_tune(options, error);
    case HD_COMMAND_COMPARE:
        return hd_command_compare(options, error);
    case HD_COMMAND_NEW:
        return hd_command_new(options, error);
    case HD_COMMAND_VIEW:
        return view(options, error);
    case HD_COMMAND_COMPLETE:
        return hd_command_complete(options, error);
    case HD_COMMAND_HELP:
        return hd_command_help(options, error);
    case HD_COMMAND_VERSION:
        printf("hedron %s\n", HD_VERSION);
        return HD_OK;
    }
    return HD_OK;
}

int main(int count, char **arguments) {
    original_arguments = hd_copy_arguments(arguments, count);
    const int code = hd_program_run(count, arguments, run);
    free(original_arguments);
    return code;
}
