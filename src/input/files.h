/* SPDX-License-Identifier: MIT */
/* The scenes that are part of the program, and the textures and meshes that scenes name. */
#ifndef HD_INPUT_FILES_H
#define HD_INPUT_FILES_H

#include <stdbool.h>

#include "input/scene_file.h"

/* The texture path that stands for the embedded texture. */
#define HD_BUILTIN_TEXTURE "builtin:floor"

/* Whether the path of a texture counts from some folder: it is there, not absolute, not in the home
   folder ("~", "~/..."; "~name" is a name like others) and not the embedded texture. */
bool hd_texture_path_is_relative(const char *path);

/* The default scene, JSON (docs/reference/scene.md) of `*size` bytes. */
const char *hd_default_scene_text(size_t *size);

/* The scene that people start from, likewise, with comments. */
const char *hd_starter_scene_text(size_t *size);

/* The most colourful configuration that the classic input can tell, without its texture. */
HdStatus hd_default_input(HdSceneFile *input, HdError *error);

/* Reads the texture that the scene names, if any: the embedded one, or a file ("~" is
   the home folder). */
HdStatus hd_scene_file_load_texture(HdSceneFile *file, HdError *error);

/* Reads the files that the entries of "meshes" name, each once for all entries that agree, with
   their materials and textures, builds the hierarchies, and fills in the scene's meshes, instances
   and pictures; without any mesh it does nothing. Every file that cannot be used is told in
   `problems`. Where that has any in the end, those from before included, the scene has no meshes.
   Notes of the reader, and textures that cannot be read, whose materials keep their colour, are
   told in `notes`; NULL: they are not. Other than HD_OK: there is too little memory (HD_FAILED), or
   a signal came (HD_INTERRUPTED). */
HdStatus hd_scene_file_load_meshes(HdSceneFile *file, HdProblems *problems, HdProblems *notes,
                                   HdError *error);

#endif
