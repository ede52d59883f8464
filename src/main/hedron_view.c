/* SPDX-License-Identifier: MIT */
/* The program 'hedron-view', which 'hedron view' starts with its own arguments: the view in a
   window. It is a program of its own, so that nothing else needs SDL. */
#include "main/program.h"
#include "view/window.h"

static HdStatus run(const HdOptions *options, HdError *error) {
    if (options->command != HD_COMMAND_VIEW)
        return hd_fail(error, HD_BAD_INPUT, "'hedron-view' is what 'hedron view' starts");
    const HdViewPlan plan = {options->scene, options->devices};
    return hd_view_in_window(&plan, error);
}

int main(int count, char **arguments) {
    return hd_program_run(count, arguments, run);
}
