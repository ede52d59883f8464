/* SPDX-License-Identifier: MIT */
/* The scenes and the texture that are part of the program. */
#ifndef HD_INPUT_BUILTIN_H
#define HD_INPUT_BUILTIN_H

#include <stdbool.h>

#include "input/classic.h"
#include "input/scene_file.h"

/* The texture path that stands for the embedded texture. */
#define HD_BUILTIN_TEXTURE "builtin:floor"

/* Whether the path of a texture counts from some folder: it is there, not absolute, not in the home
   folder ("~", "~/..."; "~name" is a name like others) and not the embedded texture. */
bool hd_texture_path_is_relative(const char *path);

/* The default scene, JSON (docs/formats.md) of `*size` bytes. */
const char *hd_default_scene_text(size_t *size);

/* The scene that people start from, likewise, with comments. */
const char *hd_starter_scene_text(size_t *size);

/* The most colourful configuration that the classic input can tell, without its texture. */
HdStatus hd_default_input(HdSceneFile *input, HdError *error);

/* Reads the texture that the scene names, if any: the embedded one, or a file ("~" is
   the home folder). */
HdStatus hd_scene_file_load_texture(HdSceneFile *file, HdError *error);

#endif
