/* SPDX-License-Identifier: MIT */
#ifndef HD_SCENE_WORK_H
#define HD_SCENE_WORK_H

#include "scene/scene.h"

/* What a rendering does with a scene before the first ray: a camera, and the tables in both
   precisions, of scenes with few lights. Ends the process where a valid scene is refused. */
void fuzz_prepare_scene(const HdScene *scene);

#endif
