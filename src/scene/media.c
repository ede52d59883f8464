/* SPDX-License-Identifier: MIT */
#include "scene/media.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "scene/triangulate.h"

static HdStatus no_memory(HdError *error) {
    return HD_NO_ROOM(error, "the objects that let light pass");
}

/* ---- what counts ---- */

static bool is_clear(const HdMaterial *material) {
    return !hd_is_opaque(material);
}

bool hd_refracts(const HdMaterial *material) {
    return material->index_of_refraction != 1.0 && is_clear(material);
}

/* Returns whether the condition holds for some material that the instance shows. */
static bool some_material(const HdScene *scene, int number,
                          bool (*condition)(const HdMaterial *material)) {
    const HdInstance *instance = &scene->instances[number];
    const HdMesh *mesh = hd_mesh_of(scene, number);
    if (instance->has_material)
        return condition(&instance->material);
    for (int i = 0; i < mesh->material_count; i++)
        if (condition(&mesh->materials[i].material))
            return true;
    return false;
}

bool hd_instance_refracts(const HdScene *scene, int number) {
    return some_material(scene, number, hd_refracts);
}

/* Opaque solids count too. */
bool hd_has_media(const HdScene *scene) {
    for (int i = 0; i < scene->solid_count; i++)
        if (scene->solids[i].face.index_of_refraction != 1.0)
            return true;
    for (int i = 0; i < scene->instance_count; i++)
        if (hd_instance_refracts(scene, i))
            return true;
    return false;
}

/* ---- preparing ---- */

static void add_to_medium(HdMedium *medium, const HdMaterial *material) {
    if (hd_is_opaque(material))
        return;
    if (!medium->is_clear)
        *medium = (HdMedium){true, material->index_of_refraction};
    else if (medium->index != material->index_of_refraction)
        medium->index = (double)NAN;
}

static HdStatus prepare_model(HdMediumModel *model, const HdMesh *mesh, HdShells *shells,
                              HdError *error) {
    if (model->mesh != NULL)
        return HD_OK;
    *model = (HdMediumModel){.mesh = mesh, .shells = shells};
    HD_TRY(hd_shells_find(shells, mesh, error));
    model->media = calloc((size_t)shells->count, sizeof *model->media);
    if (model->media == NULL)
        return no_memory(error);
    for (int i = 0; i < mesh->triangle_count; i++)
        add_to_medium(
            &model->media[shells->shell_of[i]],
            &mesh->materials[mesh->material_of != NULL ? mesh->material_of[i] : 0].material);
    return HD_OK;
}

static void place_object(HdMediumObject *object, HdPlacement to) {
    const HdMesh *mesh = object->model->mesh;
    const HdVec3 half = hd_placed_mesh_half(mesh, &to);
    object->placed = (HdPlacedMesh){mesh, object->model->shells, to};
    object->lower = hd_sub(to.start, half);
    object->upper = hd_add(to.start, half);
}

/* A solid's faces, without rim and discs. */
static HdStatus mesh_solid(HdMedia *media, HdMediumObject *object, int number, HdError *error) {
    HdMesh *mesh = &media->solids[number];
    HdSolid plain = *object->solid;
    plain.rim_width = 0.0;
    plain.lights.per_edge = 0;
    HD_TRY(hd_triangulate_solid(mesh, &plain, HD_MIN_DISC_SIDES, 1, error));
    HD_TRY(hd_mesh_build(mesh, media->pool, error));
    object->model = &media->models[media->scene->mesh_count + number];
    HD_TRY(prepare_model(object->model, mesh, &media->of_solids[number], error));
    HD_TRY(hd_shells_measure(&media->of_solids[number], mesh, error));
    const double half = hd_mesh_half_side(mesh);
    place_object(object, (HdPlacement){{{half, 0.0, 0.0}, {0.0, half, 0.0}, {0.0, 0.0, half}},
                                       hd_add(object->solid->centre, hd_mesh_centre(mesh))});
    return HD_OK;
}

static HdStatus add_solids(HdMedia *media, bool has_meshes, HdError *error) {
    for (int i = 0; i < media->scene->solid_count; i++) {
        const HdSolid *solid = &media->scene->solids[i];
        const double radius = solid->circumradius;
        HdMediumObject *object = &media->objects[media->object_count++];
        *object = (HdMediumObject){.solid = solid, .number = i, .material = &solid->face};
        if (has_meshes)
            HD_TRY(mesh_solid(media, object, i, error));
        object->lower = hd_sub(solid->centre, hd_vec3(radius, radius, radius));
        object->upper = hd_add(solid->centre, hd_vec3(radius, radius, radius));
    }
    return HD_OK;
}

static HdStatus add_instances(HdMedia *media, HdShells *shells, HdError *error) {
    const HdScene *scene = media->scene;
    for (int i = 0; i < scene->instance_count; i++) {
        const HdInstance *instance = &scene->instances[i];
        if (!some_material(scene, i, is_clear))
            continue;
        HdMediumObject *object = &media->objects[media->object_count++];
        *object = (HdMediumObject){.number = i,
                                   .material = instance->has_material ? &instance->material : NULL,
                                   .model = &media->models[instance->mesh]};
        HD_TRY(prepare_model(object->model, hd_mesh_of(scene, i), &shells[instance->mesh], error));
        place_object(object, hd_placement_of(scene, i));
    }
    return HD_OK;
}

/* Returns a box in floats, slightly too large. */
static HdBox box_of(const HdMediumObject *object) {
    const double lower[3] = {object->lower.x, object->lower.y, object->lower.z};
    const double upper[3] = {object->upper.x, object->upper.y, object->upper.z};
    HdBox box;
    for (int axis = 0; axis < 3; axis++) {
        box.lower[axis] = nextafterf((float)lower[axis], -FLT_MAX);
        box.upper[axis] = nextafterf((float)upper[axis], FLT_MAX);
    }
    return box;
}

static HdStatus build_tree(HdMedia *media, HdError *error) {
    const HdHierarchyOptions options = {.node_cost = 0.1f, .max_in_leaf = 1};
    HdBox *boxes = calloc((size_t)media->object_count, sizeof *boxes);
    if (boxes == NULL)
        return no_memory(error);
    for (int i = 0; i < media->object_count; i++)
        boxes[i] = box_of(&media->objects[i]);
    const HdStatus status =
        hd_hierarchy_build(&media->tree, boxes, media->object_count, &options, media->pool, error);
    free(boxes);
    return status;
}

HdStatus hd_media_find(HdMedia *media, const HdScene *scene, HdShells *shells, HdError *error) {
    *media = (HdMedia){.scene = scene};
    const size_t solids = (size_t)scene->solid_count, meshes = (size_t)scene->mesh_count;
    bool has_meshes = false;
    for (int i = 0; i < scene->instance_count && !has_meshes; i++)
        has_meshes = some_material(scene, i, is_clear);
    media->objects = calloc(solids + (size_t)scene->instance_count, sizeof *media->objects);
    media->models = calloc(solids + meshes, sizeof *media->models);
    media->solids = calloc(solids + 1, sizeof *media->solids);
    media->of_solids = calloc(solids + 1, sizeof *media->of_solids);
    if (media->objects == NULL || media->models == NULL || media->solids == NULL ||
        media->of_solids == NULL)
        return no_memory(error);
    HD_TRY(hd_thread_pool_create(&media->pool, 1, error));
    HD_TRY(add_solids(media, has_meshes, error));
    HD_TRY(add_instances(media, shells, error));
    return build_tree(media, error);
}

void hd_media_free(HdMedia *media) {
    const int solids = media->scene->solid_count, meshes = media->scene->mesh_count;
    for (int i = 0; media->models != NULL && i < meshes + solids; i++)
        free(media->models[i].media);
    for (int i = 0; media->solids != NULL && i < solids; i++)
        hd_mesh_free(&media->solids[i]);
    for (int i = 0; media->of_solids != NULL && i < solids; i++)
        hd_shells_free(&media->of_solids[i]);
    free(media->objects);
    free(media->models);
    free(media->solids);
    free(media->of_solids);
    hd_thread_pool_destroy(media->pool);
    hd_hierarchy_free(&media->tree);
}
