/* SPDX-License-Identifier: MIT */
#include "scene.h"

#include <stdlib.h>

#include "image.h"

int hd_edge_light_count(const HdSolid *solid) {
    HdPlatonic platonic;
    hd_platonic(solid->kind, &platonic);
    return platonic.edge_count * solid->lights.per_edge;
}

int hd_scene_light_count(const HdScene *scene) {
    int count = scene->light_count;
    for (int i = 0; i < scene->solid_count; i++)
        count += hd_edge_light_count(&scene->solids[i]);
    return count;
}

void hd_scene_free(HdScene *scene) {
    free(scene->solids);
    free(scene->lights);
    hd_texture_clear(&scene->floor.texture);
    *scene = (HdScene){0};
}
