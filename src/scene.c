/* SPDX-License-Identifier: MIT */
#include "scene.h"

#include <stdlib.h>

#include "image.h"

void hd_scene_free(HdScene *scene) {
    free(scene->solids);
    free(scene->lights);
    hd_texture_clear(&scene->floor.texture);
    *scene = (HdScene){0};
}
