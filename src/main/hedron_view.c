/* SPDX-License-Identifier: MIT */
/* The program 'hedron-view', which 'hedron view' starts with its own arguments: the view in a
   window or a terminal. It is a program of its own, so that nothing else needs SDL and chafa. */
#include <string.h>

#include "main/program.h"
#include "view/view.h"

static HdStatus show_terminal(const HdViewPlan *plan, HdError *error) {
#if HD_HAS_CHAFA
    return hd_view_in_terminal(plan, error);
#else
    (void)plan;
    return hd_fail(error, HD_UNAVAILABLE,
                   "hedron-view was built without chafa (libchafa-dev), so that it has no "
                   "--terminal");
#endif
}

static HdStatus show_window(const HdViewPlan *plan, HdError *error) {
#if HD_HAS_SDL
    return hd_view_in_window(plan, error);
#else
    (void)plan;
    return hd_fail(error, HD_UNAVAILABLE,
                   "hedron-view was built without SDL 2 (libsdl2-dev), so that it has no window; "
                   "'hedron view --terminal' shows the scene in a terminal");
#endif
}

static HdStatus run(const HdOptions *options, HdError *error) {
    const HdViewPlan plan = {options->scene, options->devices};
    if (options->command != HD_COMMAND_VIEW)
        return hd_fail(error, HD_BAD_INPUT, "'hedron-view' is what 'hedron view' starts");
    if (plan.scene.path != NULL && strcmp(plan.scene.path, "-") == 0)
        return hd_fail(error, HD_BAD_INPUT,
                       "'hedron view' needs a scene's file, which it reads again when it changes, "
                       "and not standard input");
    return (options->terminal ? show_terminal : show_window)(&plan, error);
}

int main(int count, char **arguments) {
    return hd_program_run(count, arguments, run);
}
