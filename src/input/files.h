/* SPDX-License-Identifier: MIT */
/* Built-in scenes, and the textures and meshes that scenes name. */
#ifndef HD_INPUT_FILES_H
#define HD_INPUT_FILES_H

#include <stdbool.h>

#include "input/scene_file.h"

/* Path of the embedded texture. */
#define HD_BUILTIN_TEXTURE "builtin:floor"

/* Returns whether a texture's path is relative: not empty, not absolute, not in the home folder
   ("~", "~/..."; "~name" is an ordinary name) and not the embedded texture. */
bool hd_texture_path_is_relative(const char *path);

/* Returns the default scene, JSON (docs/reference/scene.md) of `*size` bytes. */
const char *hd_default_scene_text(size_t *size);

/* Returns the commented scene to start from, likewise. */
const char *hd_starter_scene_text(size_t *size);

/* Fills in the most colourful configuration of the classic input, without its texture. */
HdStatus hd_default_input(HdSceneFile *input, HdError *error);

/* Loads the texture that the scene names, if any: the embedded one or a file ("~" is the home
   folder). */
HdStatus hd_scene_file_load_texture(HdSceneFile *file, HdProblems *notes, HdError *error);

/* Loads the picture of the scene's environment, if any. */
HdStatus hd_scene_file_load_environment(HdSceneFile *file, HdProblems *notes, HdError *error);

/* Loads the files of the entries of "meshes", each once for all entries that agree, with their
   materials and textures. Builds the hierarchies and fills in the scene's meshes, instances and
   pictures. Reports unusable files in `problems`, if the scene is strict all wrong ones; if it has
   any at the end, earlier ones included, the scene has no meshes. Reports the reader's notes in
   `notes` (NULL: nowhere), also faults that it passes over, unless the scene is strict, and
   unreadable textures, whose materials keep their colour. Fails with HD_FAILED if memory is short,
   and with HD_INTERRUPTED after a signal. */
HdStatus hd_scene_file_load_meshes(HdSceneFile *file, HdProblems *problems, HdProblems *notes,
                                   HdError *error);

#endif
