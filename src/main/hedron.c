/* SPDX-License-Identifier: MIT */
/* Runs the commands of the program 'hedron'. */
#define _POSIX_C_SOURCE 200809L
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/options.h"
#include "system/path.h"

static char **original_arguments; /* copy in the original order; owned, ends with NULL */

/* Becomes hedron-view with the same arguments, from this program's folder or from PATH. Returns
   only if that fails. */
static HdStatus view(const HdOptions *options, HdError *error) {
    static const char program[] = "hedron-view";
    char folder[HD_MAX_PATH], path[HD_MAX_PATH + sizeof program + 1];
    (void)options;
    if (original_arguments == NULL)
        return HD_NO_ROOM(error, "the arguments");
    if (hd_path_of_program(folder)) {
        snprintf(path, sizeof path, "%s/%s", folder, program);
        execv(path, original_arguments);
    }
    execvp(program, original_arguments);
    return hd_fail(error, HD_UNAVAILABLE,
                   "the view's program, %s, cannot be started (%s): it is the package hedron-view",
                   program, strerror(errno));
}

static HdStatus run(const HdOptions *options, HdError *error) {
    static const struct {
        HdCommand command;
        HdCommandFunction *run;
    } commands[] = {
        {HD_COMMAND_CLASSIC, hd_command_classic},   {HD_COMMAND_RENDER, hd_command_render},
        {HD_COMMAND_CHECK, hd_command_check},       {HD_COMMAND_CONVERT, hd_command_convert},
        {HD_COMMAND_DEVICES, hd_command_devices},   {HD_COMMAND_SELFTEST, hd_command_selftest},
        {HD_COMMAND_TUNE, hd_command_tune},         {HD_COMMAND_COMPARE, hd_command_compare},
        {HD_COMMAND_NEW, hd_command_new},           {HD_COMMAND_VIEW, view},
        {HD_COMMAND_COMPLETE, hd_command_complete}, {HD_COMMAND_HELP, hd_command_help},
    };
    for (size_t i = 0; i < sizeof commands / sizeof *commands; i++)
        if (commands[i].command == options->command)
            return commands[i].run(options, error);
    printf("hedron %s\n", HD_VERSION);
    return HD_OK;
}

int main(int count, char **arguments) {
    original_arguments = calloc((size_t)count + 1, sizeof *arguments);
    if (original_arguments != NULL)
        memcpy(original_arguments, arguments, (size_t)count * sizeof *arguments);
    const int code = hd_program_run(count, arguments, run);
    free(original_arguments);
    return code;
}
