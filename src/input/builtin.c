/* SPDX-License-Identifier: MIT */
#include "input/builtin.h"

#include <string.h>

#include "image/picture.h"
#include "system/path.h"

/* Made by the build from default.json, starter.json, classic.in and floor.png of scenes/. */
extern const unsigned char hd_default_scene[], hd_starter_scene[], hd_default_classic[],
    hd_default_texture[];
extern const size_t hd_default_scene_size, hd_starter_scene_size, hd_default_classic_size,
    hd_default_texture_size;

const char *hd_default_scene_text(size_t *size) {
    *size = hd_default_scene_size;
    return (const char *)hd_default_scene;
}

const char *hd_starter_scene_text(size_t *size) {
    *size = hd_starter_scene_size;
    return (const char *)hd_starter_scene;
}

HdStatus hd_default_input(HdSceneFile *input, HdError *error) {
    return hd_classic_parse(input, (const char *)hd_default_classic, hd_default_classic_size,
                            "the built-in configuration", HD_CLASSIC_DEFAULT_VARIANT, error);
}

bool hd_texture_path_is_relative(const char *path) {
    const bool is_at_home = path[0] == '~' && (path[1] == '\0' || path[1] == '/');
    return path[0] != '\0' && path[0] != '/' && !is_at_home &&
           strcmp(path, HD_BUILTIN_TEXTURE) != 0;
}

HdStatus hd_scene_file_load_texture(HdSceneFile *file, HdError *error) {
    HdTexture *texture = &file->scene.floor.texture;
    char expanded[HD_MAX_PATH];
    if (file->texture_path[0] == '\0')
        return HD_OK;
    if (strcmp(file->texture_path, HD_BUILTIN_TEXTURE) == 0)
        return hd_texture_decode(texture, hd_default_texture, hd_default_texture_size,
                                 "the built-in texture", file->texture_curve, error);
    HdStatus status = hd_path_expand_home(file->texture_path, expanded, error);
    if (status != HD_OK)
        return status;
    return hd_texture_read(texture, expanded, file->texture_curve, error);
}
