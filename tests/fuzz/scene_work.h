/* SPDX-License-Identifier: MIT */
#ifndef HD_SCENE_WORK_H
#define HD_SCENE_WORK_H

#include "scene/scene.h"

/* Renders the last frame of a valid scene, a few pixels of it in both precisions, where it has few
   lights. Ends the process where a valid scene is refused. */
void fuzz_render_scene(const HdScene *scene);

#endif
