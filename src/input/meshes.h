/* SPDX-License-Identifier: MIT */
/* Loads what the entries of "meshes" name: each file once for all entries that agree. */
#ifndef HD_INPUT_MESHES_H
#define HD_INPUT_MESHES_H

#include "input/scene_file.h"

/* Reads the files that the scene's meshes name, with their materials and textures, builds the
   hierarchies, and fills in the scene's meshes, instances and pictures; without any mesh it does
   nothing. Every file that cannot be used is told in `problems`. Where that has any in the end,
   those from before included, the scene has no meshes.
   Notes of the reader, and textures that cannot be read, whose materials keep their colour, are
   told in `notes`; NULL: they are not. Other than HD_OK: there is too little memory (HD_FAILED), or
   a signal came (HD_INTERRUPTED). */
HdStatus hd_scene_file_load_meshes(HdSceneFile *file, HdProblems *problems, HdProblems *notes,
                                   HdError *error);

#endif
