/* SPDX-License-Identifier: MIT */
#include "scene/triangulate/scene.h"

#include <stdlib.h>
#include <string.h>

#include "scene/triangulate/solid.h"
#include "system/machine.h"

/* What the scene gets in front of its own meshes, instances and pictures. */
typedef struct Made {
    int count; /* of meshes, each with one instance */
    HdMesh *meshes;
    HdInstance *instances;
    HdPicture *pictures;
} Made;

static void place(HdInstance *instance, int mesh, HdVec3 position) {
    *instance = (HdInstance){
        .mesh = mesh,
        .position = position,
        .scale = hd_vec3(1.0, 1.0, 1.0),
    };
}

static HdStatus make_solids(Made *made, const HdScene *scene, int disc_sides, int divisions,
                            HdError *error) {
    for (int s = 0; s < scene->solid_count; s++) {
        const HdSolid *solid = &scene->solids[s];
        HdStatus status =
            hd_triangulate_solid(&made->meshes[s], solid, disc_sides, divisions, error);
        if (status != HD_OK)
            return status;
        made->count++;
        place(&made->instances[s], s, solid->centre);
    }
    return HD_OK;
}

/* The floor keeps its texture, which goes on at its border instead of repeating. */
static HdStatus make_floor(Made *made, const HdScene *scene, int divisions, HdError *error) {
    const HdFloor *floor = &scene->floor;
    int number = scene->solid_count;
    HdMesh *mesh = &made->meshes[number];
    HdStatus status = hd_triangulate_floor(mesh, floor, divisions, error);
    if (status != HD_OK)
        return status;
    made->count++;
    mesh->materials[0].is_opaque_to_shadows = true;
    place(&made->instances[number], number, hd_floor_centre(floor));
    if (floor->texture.width == 0)
        return HD_OK;
    size_t bytes = (size_t)floor->texture.width * (size_t)floor->texture.height * 3 *
                   sizeof *floor->texture.texels;
    HdTexture *copy = &made->pictures[scene->picture_count].texture;
    *copy = floor->texture;
    copy->texels = malloc(bytes);
    if (copy->texels == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: the floor's texture has %zu bytes", bytes);
    memcpy(copy->texels, floor->texture.texels, bytes);
    made->pictures[scene->picture_count].is_clamped = true;
    mesh->materials[0].picture = scene->picture_count;
    return HD_OK;
}

static HdStatus build_meshes(const Made *made, HdError *error) {
    HdThreadPool *pool = NULL;
    HdStatus status = hd_thread_pool_create(&pool, hd_processor_count(), error);
    for (int i = 0; status == HD_OK && i < made->count; i++)
        status = hd_mesh_build(&made->meshes[i], pool, error);
    hd_thread_pool_destroy(pool);
    return status;
}

static HdStatus make(Made *made, const HdScene *scene, int disc_sides, int divisions,
                     HdError *error) {
    size_t own = (size_t)scene->solid_count + 1;
    made->meshes = calloc(own + (size_t)scene->mesh_count, sizeof *made->meshes);
    made->instances = calloc(own + (size_t)scene->instance_count, sizeof *made->instances);
    made->pictures = calloc((size_t)scene->picture_count + 1, sizeof *made->pictures);
    if (made->meshes == NULL || made->instances == NULL || made->pictures == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room for %zu meshes",
                       own + (size_t)scene->mesh_count);
    HdStatus status = make_solids(made, scene, disc_sides, divisions, error);
    if (status == HD_OK && scene->floor.present)
        status = make_floor(made, scene, divisions, error);
    if (status == HD_OK)
        status = build_meshes(made, error);
    return status;
}

static void discard(Made *made, const HdScene *scene) {
    for (int i = 0; made->meshes != NULL && i <= scene->solid_count; i++)
        hd_mesh_free(&made->meshes[i]);
    if (made->pictures != NULL)
        free(made->pictures[scene->picture_count].texture.texels);
    free(made->meshes);
    free(made->instances);
    free(made->pictures);
}

static void take(HdScene *scene, const Made *made) {
    for (int i = 0; i < scene->mesh_count; i++)
        made->meshes[made->count + i] = scene->meshes[i];
    for (int i = 0; i < scene->instance_count; i++) {
        made->instances[made->count + i] = scene->instances[i];
        made->instances[made->count + i].mesh += made->count;
    }
    for (int i = 0; i < scene->picture_count; i++)
        made->pictures[i] = scene->pictures[i];
    free(scene->meshes);
    free(scene->instances);
    free(scene->pictures);
    scene->meshes = made->meshes;
    scene->instances = made->instances;
    scene->pictures = made->pictures;
    scene->mesh_count += made->count;
    scene->instance_count += made->count;
    scene->picture_count += made->pictures[scene->picture_count].texture.width > 0;
    scene->geometry = HD_GEOMETRY_TRIANGLES;
}

HdStatus hd_scene_triangulate(HdScene *scene, int disc_sides, int divisions, HdError *error) {
    Made made = {0};
    HdStatus status = make(&made, scene, disc_sides, divisions, error);
    if (status == HD_OK)
        take(scene, &made);
    else
        discard(&made, scene);
    return status;
}
