/* SPDX-License-Identifier: MIT */
/* Runs the program 'hedron-view', the view in a window or a terminal, which 'hedron view' starts
   with its own arguments. A separate program, so that nothing else needs SDL and chafa. */
#include <string.h>

#include "cli/options.h"
#include "view/viewer.h"

static HdStatus run(const HdOptions *options, HdError *error) {
    if (options->command != HD_COMMAND_VIEW)
        return hd_fail(error, HD_BAD_INPUT, "expected 'hedron view', which starts hedron-view");
    if (options->scene.path != NULL && strcmp(options->scene.path, "-") == 0)
        return hd_fail(error, HD_BAD_INPUT,
                       "'hedron view' needs a scene's file, which it reads again when it changes, "
                       "and not standard input");
#if HD_HAS_CHAFA
    if (options->terminal)
        return hd_view_in_terminal(&options->scene, &options->devices, error);
#endif
#if HD_HAS_SDL
    if (!options->terminal)
        return hd_view_in_window(&options->scene, &options->devices, error);
#endif
    return hd_fail(error, HD_UNAVAILABLE,
                   options->terminal
                       ? "hedron-view was built without chafa (libchafa-dev), and has no --terminal"
                       : "hedron-view was built without SDL 2 (libsdl2-dev), and has no window; "
                         "'hedron view --terminal' shows the scene in a terminal");
}

int main(int count, char **arguments) {
    return hd_program_run(count, arguments, run);
}
