/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "view/start_window.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "system/path.h"

static const char program[] = "hedron-view";

char **hd_copy_arguments(char *const *arguments, int count) {
    char **copy = calloc((size_t)count + 1, sizeof *copy);
    if (copy != NULL)
        memcpy(copy, arguments, (size_t)count * sizeof *copy);
    return copy;
}

HdStatus hd_start_window(char **arguments, HdError *error) {
    char folder[HD_MAX_PATH], path[HD_MAX_PATH + sizeof program + 1];
    if (arguments == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room for the arguments");
    if (hd_path_of_program(folder)) {
        snprintf(path, sizeof path, "%s/%s", folder, program);
        execv(path, arguments);
    }
    execvp(program, arguments);
    return hd_fail(
        error, HD_UNAVAILABLE,
        "the window's program, %s, cannot be started (%s): it is the package hedron-view, "
        "or is built where SDL 2 is (libsdl2-dev); 'hedron view --terminal' needs "
        "neither",
        program, strerror(errno));
}
