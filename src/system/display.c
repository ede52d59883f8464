/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "system/display.h"

#include <glob.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "system/path.h"

static bool is_set(const char *variable) {
    const char *value = getenv(variable);
    return value != NULL && value[0] != '\0';
}

static bool is_connected(const char *path) {
    char text[16] = "";
    FILE *file = fopen(path, "r");
    if (file == NULL)
        return false;
    bool is_read = fgets(text, sizeof text, file) != NULL;
    fclose(file);
    return is_read && strcmp(text, "connected\n") == 0;
}

bool hd_display_may_be_there(const char *folder) {
    char pattern[HD_MAX_PATH];
    glob_t paths;
    bool is_there = is_set("DISPLAY") || is_set("WAYLAND_DISPLAY");
    snprintf(pattern, sizeof pattern, "%s/card*-*/status", folder);
    if (!is_there && glob(pattern, 0, NULL, &paths) == 0) {
        for (size_t i = 0; i < paths.gl_pathc && !is_there; i++)
            is_there = is_connected(paths.gl_pathv[i]);
        globfree(&paths);
    }
    return is_there;
}
