/* SPDX-License-Identifier: MIT */
/* Where commands get their scenes from. */
#ifndef HD_CLI_LOAD_SCENE_H
#define HD_CLI_LOAD_SCENE_H

#include "cli/options.h"
#include "input/scene_file.h"

/* Reads a classic input from a file, or, `path` being NULL, from standard input, as what its JSON
   would be: curves are linear everywhere, as they are in the classic mode. */
HdStatus hd_read_classic(HdSceneFile *file, const char *path, int variant, HdError *error);

/* What messages call a scene file that the command line names: "-" is standard input. */
const char *hd_operand_name(const char *operand);

/* Reads a scene file, or, `path` being "-", standard input; the name and the folder of `source` are
   those that suit it. */
HdStatus hd_read_scene_file(HdSceneFile *file, const char *path, const HdSceneSource *source,
                            HdError *error);

/* Lays size, samples, depth and cut-off of the command line over a valid scene. Where they do not
   suit it, the message begins with them, as "--size 60000x60000: ". */
HdStatus hd_apply_scene_options(HdScene *scene, const HdOptions *options, HdError *error);

/* Makes the scene, whose textures are loaded, out of what the options say: solids or triangles, and
   how these are searched. */
HdStatus hd_apply_geometry(HdScene *scene, const HdOptions *options, HdError *error);

/* Reads the scene that is named on the command line, or the built-in one, with its texture and
   its meshes, and lays the options over it. What of the meshes' files is not used is told on
   standard error, unless the options are quiet. */
HdStatus hd_read_scene(HdSceneFile *file, const HdOptions *options, HdError *error);

/* The name of that scene, for people. */
const char *hd_scene_name(const HdOptions *options);

#endif
