/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "cli/commands.h"
#include "image/picture.h"
#include "input/builtin.h"
#include "input/write.h"
#include "run/load_scene.h"
#include "system/atomic_file.h"

/* A scene's texture counts from the scene's folder, that of a classic input from the current one.
   Where the two differ, the name gets the current folder in front. */
static HdStatus keep_texture(HdSceneFile *file, const char *output, HdError *error) {
    char folder[HD_MAX_PATH], name[HD_MAX_PATH];
    memcpy(name, file->texture_path, sizeof name);
    if (output == NULL || strchr(output, '/') == NULL || !hd_texture_path_is_relative(name))
        return HD_OK;
    if (getcwd(folder, sizeof folder) == NULL)
        return hd_fail(error, HD_FAILED, "cannot tell the current folder: %s", strerror(errno));
    if (snprintf(file->texture_path, sizeof file->texture_path, "%s/%s", folder, name) >=
        (int)sizeof file->texture_path)
        return hd_fail(error, HD_BAD_INPUT, "the path of the texture %s gets too long", name);
    return HD_OK;
}

/* The classic mode writes any other name in the data format; a scene says it by the ending. */
static HdStatus keep_output(HdSceneFile *file, HdError *error) {
    static const char ending[] = ".data";
    char *path = file->output.path;
    const HdFormat *format = hd_format_of(path);
    if (format != NULL && !hd_format_is_film(format))
        return HD_OK;
    if (strlen(path) + sizeof ending > HD_MAX_PATH)
        return hd_fail(error, HD_BAD_INPUT, "the output path has %zu bytes, too many for %s",
                       strlen(path), ending);
    memcpy(path + strlen(path), ending, sizeof ending);
    return HD_OK;
}

static HdStatus write_scene(const HdSceneFile *file, const char *name, HdError *error) {
    char path[HD_MAX_PATH];
    HdAtomicFile out;
    HdStatus status = hd_path_expand_home(name, path, error);
    if (status == HD_OK)
        status = hd_atomic_file_open(&out, path, error);
    if (status != HD_OK)
        return status;
    status = hd_scene_file_print(out.stream, file, error);
    if (status == HD_OK)
        return hd_atomic_file_commit(&out, HD_DURABLE, error);
    hd_atomic_file_discard(&out);
    return status;
}

HdStatus hd_command_convert(const HdOptions *options, HdError *error) {
    const char *source = options->operand_count > 0 ? options->operands[0] : NULL;
    const char *output = options->store.count > 0 ? options->store.names[0] : NULL;
    HdSceneFile file;
    HdStatus status = hd_read_classic(&file, source, options->variant, error);
    if (status != HD_OK)
        return status;
    status = keep_texture(&file, output, error);
    if (status == HD_OK)
        status = keep_output(&file, error);
    if (status == HD_OK)
        status = output != NULL ? write_scene(&file, output, error)
                                : hd_scene_file_print(stdout, &file, error);
    hd_scene_file_free(&file);
    return status;
}
