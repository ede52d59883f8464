/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "cli/commands.h"
#include "input/builtin.h"
#include "system/path.h"

/* Where the file can be written at all, it is new and whole, or it is taken away again. */
static HdStatus write_new(const char *path, HdError *error) {
    size_t size;
    const char *text = hd_starter_scene_text(&size);
    FILE *out = fopen(path, "wbx");
    if (out == NULL && errno == EEXIST)
        return hd_fail(error, HD_BAD_INPUT, "%s is there already, expected a new name", path);
    if (out == NULL)
        return hd_fail(error, HD_FAILED, "cannot write %s: %s", path, strerror(errno));
    const bool is_written = fwrite(text, 1, size, out) == size && fflush(out) == 0;
    const int why = errno;
    if (fclose(out) == 0 && is_written)
        return HD_OK;
    remove(path);
    return hd_fail(error, HD_FAILED, "cannot write %s: %s", path,
                   strerror(is_written ? errno : why));
}

HdStatus hd_command_new(const HdOptions *options, HdError *error) {
    const char *name = options->operand_count > 0 ? options->operands[0] : "scene";
    const char *ending = hd_path_has_ending(name, ".json") ? "" : ".json";
    char path[HD_MAX_PATH];
    if (snprintf(path, sizeof path, "%s%s", name, ending) >= (int)sizeof path)
        return hd_fail(error, HD_BAD_INPUT, "the name of the scene has %zu bytes, expected fewer",
                       strlen(name));
    HdStatus status = write_new(path, error);
    if (status == HD_OK)
        printf("%s\n", path);
    return status;
}
