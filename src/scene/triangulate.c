/* SPDX-License-Identifier: MIT */
#include "scene/triangulate.h"

#include <stdlib.h>
#include <string.h>

#include "scene/triangulate_solid.h"
#include "system/machine.h"

/* In `made` is what the scene gets in front of its own meshes and instances, and behind its
   pictures, in arrays that have room for those too. */

/* Gives the mesh that was made last its place. */
static void place(HdScene *made, HdVec3 position) {
    made->instances[made->instance_count++] = (HdInstance){
        .mesh = made->mesh_count++, .position = position, .scale = hd_vec3(1.0, 1.0, 1.0)};
}

/* It goes on at its border instead of repeating. */
static HdStatus copy_texture(HdPicture *picture, const HdTexture *texture, HdError *error) {
    size_t bytes = (size_t)texture->width * (size_t)texture->height * 3 * sizeof *texture->texels;
    *picture = (HdPicture){.texture = *texture, .is_clamped = true};
    picture->texture.texels = malloc(bytes);
    if (picture->texture.texels == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: the floor's texture has %zu bytes", bytes);
    memcpy(picture->texture.texels, texture->texels, bytes);
    return HD_OK;
}

static HdStatus make_floor(HdScene *made, const HdScene *scene, int divisions, HdError *error) {
    const HdFloor *floor = &scene->floor;
    HdMesh *mesh = &made->meshes[made->mesh_count];
    HdStatus status = hd_triangulate_floor(mesh, floor, divisions, error);
    if (status != HD_OK)
        return status;
    place(made, hd_floor_centre(floor));
    mesh->materials[0].is_opaque_to_shadows = true;
    if (floor->texture.width == 0)
        return HD_OK;
    mesh->materials[0].picture = scene->picture_count;
    made->picture_count = scene->picture_count + 1;
    return copy_texture(&made->pictures[scene->picture_count], &floor->texture, error);
}

static HdStatus build_meshes(const HdScene *made, HdError *error) {
    HdThreadPool *pool = NULL;
    HdStatus status = hd_thread_pool_create(&pool, hd_processor_count(), error);
    for (int i = 0; status == HD_OK && i < made->mesh_count; i++)
        status = hd_mesh_build(&made->meshes[i], pool, error);
    hd_thread_pool_destroy(pool);
    return status;
}

static HdStatus make(HdScene *made, const HdScene *scene, int disc_sides, int divisions,
                     HdError *error) {
    size_t own = (size_t)scene->solid_count + 1;
    HdStatus status = HD_OK;
    made->meshes = calloc(own + (size_t)scene->mesh_count, sizeof *made->meshes);
    made->instances = calloc(own + (size_t)scene->instance_count, sizeof *made->instances);
    made->pictures = calloc((size_t)scene->picture_count + 1, sizeof *made->pictures);
    if (made->meshes == NULL || made->instances == NULL || made->pictures == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room for %zu meshes",
                       own + (size_t)scene->mesh_count);
    for (int s = 0; s < scene->solid_count && status == HD_OK; s++) {
        const HdSolid *solid = &scene->solids[s];
        status = hd_triangulate_solid(&made->meshes[s], solid, disc_sides, divisions, error);
        if (status == HD_OK)
            place(made, solid->centre);
    }
    if (status == HD_OK && scene->floor.present)
        status = make_floor(made, scene, divisions, error);
    return status == HD_OK ? build_meshes(made, error) : status;
}

static void take(HdScene *scene, const HdScene *made) {
    const int count = made->mesh_count;
    for (int i = 0; i < scene->mesh_count; i++)
        made->meshes[count + i] = scene->meshes[i];
    for (int i = 0; i < scene->instance_count; i++) {
        made->instances[count + i] = scene->instances[i];
        made->instances[count + i].mesh += count;
    }
    for (int i = 0; i < scene->picture_count; i++)
        made->pictures[i] = scene->pictures[i];
    free(scene->meshes);
    free(scene->instances);
    free(scene->pictures);
    scene->meshes = made->meshes;
    scene->instances = made->instances;
    scene->pictures = made->pictures;
    scene->mesh_count += count;
    scene->instance_count += count;
    scene->picture_count += made->picture_count > 0;
    scene->geometry = HD_GEOMETRY_TRIANGLES;
}

HdStatus hd_scene_triangulate(HdScene *scene, int disc_sides, int divisions, HdError *error) {
    HdScene made = {0};
    HdStatus status = make(&made, scene, disc_sides, divisions, error);
    if (status == HD_OK)
        take(scene, &made);
    else
        hd_scene_drop_meshes(&made);
    return status;
}
