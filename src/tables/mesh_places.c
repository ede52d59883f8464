/* SPDX-License-Identifier: MIT */
/* The places of meshes and instances, in the tables and in space, before rounding. */
#include "tables/builder.h"

#include <math.h>
#include <stdlib.h>

#include "base/minmax.h"
#include "system/thread_pool.h"

double hd_box_meshes(const HdScene *scene, HdVec3 *centre) {
    HdVec3 lower = {0}, upper = {0};
    for (int i = 0; i < scene->instance_count; i++) {
        HdPlacement to = hd_placement_of(scene, i);
        HdVec3 reach = hd_placed_mesh_half(hd_mesh_of(scene, i), &to);
        lower = i == 0 ? hd_sub(to.start, reach) : hd_minimum(lower, hd_sub(to.start, reach));
        upper = i == 0 ? hd_add(to.start, reach) : hd_maximum(upper, hd_add(to.start, reach));
    }
    HdVec3 half = hd_scale(hd_sub(upper, lower), 0.5);
    *centre = hd_add(lower, half);
    return fmax(half.x, fmax(half.y, half.z));
}

/* Up to this count, testing each triangle is as fast (docs/performance.md). */
enum { FEW_TRIANGLES = 8 };

bool hd_has_hierarchy(const HdScene *scene, const HdMesh *mesh) {
    return scene->accel == HD_ACCEL_BVH ||
           (scene->accel == HD_ACCEL_AUTO && mesh->triangle_count > FEW_TRIANGLES);
}

/* Adds a mesh to the sizes of the tables. */
static HdStatus add_mesh(HdBuilder *builder, const HdMesh *mesh, HdMeshPlace *place,
                         HdError *error) {
    HdMeshSizes *sizes = &builder->sizes;
    size_t triangles = (size_t)mesh->triangle_count;
    place->first = *sizes;
    sizes->triangles += triangles;
    sizes->corner_normals += mesh->normals != NULL ? 3 * triangles : 0;
    sizes->corner_uvs += mesh->uvs != NULL ? 3 * triangles : 0;
    sizes->corner_colours += mesh->colours != NULL ? 3 * triangles : 0;
    sizes->normals += (size_t)mesh->normal_count;
    sizes->uvs += (size_t)mesh->uv_count;
    if (!hd_has_hierarchy(builder->scene, mesh))
        return HD_OK;
    builder->node_stack = hd_max(mesh->tree.depth, builder->node_stack);
    if (builder->lanes == 1) {
        sizes->nodes += (size_t)mesh->tree.node_count;
        return HD_OK;
    }
    HD_TRY(hd_hierarchy_widen(&place->wide, &mesh->tree, builder->lanes, error));
    sizes->wide_nodes += (size_t)place->wide.node_count;
    builder->wide_stack = hd_max((builder->lanes - 1) * place->wide.depth + 1, builder->wide_stack);
    return HD_OK;
}

static HdStatus count_meshes(HdBuilder *builder, HdError *error) {
    const HdScene *scene = builder->scene;
    HdMeshSizes *sizes = &builder->sizes;
    builder->places = calloc((size_t)scene->mesh_count + 1, sizeof *builder->places);
    if (builder->places == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: the scene has %d meshes",
                       scene->mesh_count);
    for (int i = 0; i < scene->mesh_count; i++)
        HD_TRY(add_mesh(builder, &scene->meshes[i], &builder->places[i], error));
    if (sizes->triangles > HD_MAX_MESH_TRIANGLES)
        return hd_fail(error, HD_BAD_INPUT,
                       "the meshes have %zu triangles in all, expected at most %d",
                       sizes->triangles, (int)HD_MAX_MESH_TRIANGLES);
    for (int i = 0; i < scene->instance_count; i++)
        sizes->mesh_materials += (size_t)hd_mesh_of(builder->scene, i)->material_count;
    return HD_OK;
}

/* ---- over the instances ---- */

/* Returns an instance's box in floats, slightly too large. */
static HdBox box_of_instance(const HdBuilder *builder, int number) {
    HdPlacement to = hd_placement_of(builder->scene, number);
    HdVec3 middle = hd_sub(to.start, builder->mesh_centre);
    HdVec3 reach = hd_placed_mesh_half(hd_mesh_of(builder->scene, number), &to);
    double low[3] = {middle.x - reach.x, middle.y - reach.y, middle.z - reach.z};
    double high[3] = {middle.x + reach.x, middle.y + reach.y, middle.z + reach.z};
    double slack = 0x1p-20 * builder->mesh_reach;
    HdBox box;
    for (int axis = 0; axis < 3; axis++) {
        box.lower[axis] = (float)(low[axis] - slack);
        box.upper[axis] = (float)(high[axis] + slack);
    }
    return box;
}

/* Kernels test fewer instances one by one. */
enum { FEW_INSTANCES = 4 };

static HdStatus build_top(HdBuilder *builder, HdError *error) {
    const HdScene *scene = builder->scene;
    const HdHierarchyOptions options = {.node_cost = 0.1f, .max_in_leaf = 1};
    if (scene->accel == HD_ACCEL_BRUTE || scene->instance_count < FEW_INSTANCES)
        return HD_OK;
    HdThreadPool *pool = NULL;
    HdBox *boxes = calloc((size_t)scene->instance_count, sizeof *boxes);
    if (boxes == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: the scene has %d mesh instances",
                       scene->instance_count);
    for (int i = 0; i < scene->instance_count; i++)
        boxes[i] = box_of_instance(builder, i);
    HdStatus status = hd_thread_pool_create(&pool, 1, error);
    if (status == HD_OK)
        status =
            hd_hierarchy_build(&builder->top, boxes, scene->instance_count, &options, pool, error);
    hd_thread_pool_destroy(pool);
    free(boxes);
    builder->first_top_node = builder->sizes.nodes;
    builder->sizes.nodes += (size_t)builder->top.node_count;
    builder->node_stack = hd_max(builder->top.depth + 1, builder->node_stack);
    return status;
}

/* ---- all meshes ---- */

HdStatus hd_builder_prepare_meshes(HdBuilder *builder, HdError *error) {
    if (builder->scene->instance_count == 0)
        return HD_OK;
    HD_TRY(count_meshes(builder, error));
    builder->mesh_reach = hd_box_meshes(builder->scene, &builder->mesh_centre);
    HD_TRY(build_top(builder, error));
    builder->node_stack = hd_max(builder->node_stack, 1);
    return HD_OK;
}

void hd_builder_free_meshes(HdBuilder *builder) {
    for (int i = 0; builder->places != NULL && i < builder->scene->mesh_count; i++)
        hd_wide_hierarchy_free(&builder->places[i].wide);
    free(builder->places);
    hd_hierarchy_free(&builder->top);
}
