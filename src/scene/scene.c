/* SPDX-License-Identifier: MIT */
#include "scene/scene.h"

#include <stdlib.h>

#include "image/picture.h"
#include "system/machine.h"
#include "system/thread_pool.h"

#define SAMPLING_NAME(value, name) [value] = (name),
const char *const hd_sampling_names[] = {HD_SAMPLINGS(SAMPLING_NAME) NULL};

bool hd_scene_has_error_bound(const HdScene *scene) {
    return scene->sampling == HD_SAMPLING_REFERENCE || scene->max_error > 0.0;
}

bool hd_scene_has_deep_trees(const HdScene *scene) {
    enum { FEW_LEVELS = 64 };
    const double small_cutoff = 1e-4; /* too small to end trees early */
    return scene->depth > FEW_LEVELS && (scene->max_error > 0.0 || scene->cutoff <= small_cutoff);
}

void hd_scene_drop_error_bound(HdScene *scene) {
    enum { USUAL_DEPTH = 16 };
    if (scene->max_error > 0.0 && scene->depth > USUAL_DEPTH)
        scene->depth = USUAL_DEPTH;
    if (scene->sampling != HD_SAMPLING_MULTIJITTER)
        scene->sampling = HD_SAMPLING_GRID;
    scene->max_error = 0.0;
}

HdPlatonic hd_solid_shape(const HdSolid *solid) {
    HdPlatonic shape;
    hd_platonic(solid->kind, &shape);
    hd_platonic_rotate(&shape, solid->rotation_degrees);
    return shape;
}

HdMaterial hd_instance_material(const HdScene *scene, const HdInstance *instance, int number) {
    HdMaterial material = instance->has_material
                              ? instance->material
                              : scene->meshes[instance->mesh].materials[number].material;
    if (instance->around != NULL)
        material.index_of_refraction /= instance->around[number];
    return material;
}

bool hd_is_opaque(const HdMaterial *face) {
    return face->transmission == 0.0 && (!face->has_inner_side || face->inner_transmission == 0.0);
}

int hd_edge_light_count(const HdSolid *solid) {
    HdPlatonic platonic;
    hd_platonic(solid->kind, &platonic);
    return platonic.edge_count * solid->lights.per_edge;
}

HdVec3 hd_floor_centre(const HdFloor *floor) {
    HdVec3 sum = floor->corners[0];
    for (int i = 1; i < 4; i++)
        sum = hd_add(sum, floor->corners[i]);
    return hd_scale(sum, 0.25);
}

int hd_scene_light_count(const HdScene *scene) {
    int count = scene->light_count;
    for (int i = 0; i < scene->solid_count; i++)
        count += hd_edge_light_count(&scene->solids[i]);
    return count;
}

int hd_scene_endless_light_count(const HdScene *scene) {
    int count = 0;
    for (int i = 0; i < scene->light_count; i++)
        count += !(scene->lights[i].falloff.end > 0.0);
    for (int i = 0; i < scene->solid_count; i++) {
        const HdEdgeLights *lights = &scene->solids[i].lights;
        if (lights->intensity > 0.0 && !(lights->falloff.end > 0.0))
            count += hd_edge_light_count(&scene->solids[i]);
    }
    return count;
}

int64_t hd_scene_triangle_count(const HdScene *scene) {
    int64_t count = 0;
    for (int i = 0; i < scene->mesh_count; i++)
        count += scene->meshes[i].triangle_count;
    return count;
}

HdStatus hd_scene_build_meshes(HdScene *scene, HdError *error) {
    HdThreadPool *pool = NULL;
    HdStatus status = hd_thread_pool_create(&pool, hd_processor_count(), error);
    for (int i = 0; i < scene->mesh_count && status == HD_OK; i++)
        status = hd_mesh_build(&scene->meshes[i], pool, error);
    hd_thread_pool_destroy(pool);
    return status;
}

void hd_scene_drop_meshes(HdScene *scene) {
    for (int i = 0; i < scene->mesh_count; i++)
        hd_mesh_free(&scene->meshes[i]);
    for (int i = 0; i < scene->picture_count; i++)
        hd_texture_clear(&scene->pictures[i].texture);
    for (int i = 0; i < scene->instance_count; i++)
        free(scene->instances[i].around);
    free(scene->meshes);
    free(scene->instances);
    free(scene->pictures);
    scene->meshes = NULL;
    scene->instances = NULL;
    scene->pictures = NULL;
    scene->mesh_count = scene->instance_count = scene->picture_count = 0;
}

void hd_scene_free(HdScene *scene) {
    free(scene->solids);
    free(scene->lights);
    hd_scene_drop_meshes(scene);
    hd_texture_clear(&scene->floor.texture);
    hd_texture_clear(&scene->environment.texture);
    free(scene->environment.file);
    *scene = (HdScene){0};
}
