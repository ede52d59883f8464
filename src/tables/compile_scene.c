/* SPDX-License-Identifier: MIT */
/* All tables of a scene: their sizes, memory and contents; compiled for each precision. */
#include "tables/builder.h"

#include <stdio.h>
#include <stdlib.h>

#include "system/machine.h"
#include "tables/room.h"

_Static_assert(HD_SCENE_TABLE_COUNT <= sizeof((HdSceneTables){0}.table) / sizeof(HdTable),
               "HdSceneTables has room for every table");
_Static_assert(HD_FRAME_TABLE_COUNT <= sizeof((HdFrameTables){0}.table) / sizeof(HdTable),
               "HdFrameTables has room for every table");
_Static_assert(HD_MAX_FACES < 32, "LightSides has a bit for each face");

static void set_bytes(HdSceneTables *tables, int index, size_t count, size_t element) {
    tables->table[index].bytes = count * element;
}

static void size_mesh_tables(const HdBuilder *builder, HdSceneTables *tables) {
    const HdMeshSizes *sizes = &builder->sizes;
    size_t lanes = (size_t)builder->lanes;
    set_bytes(tables, HD_TABLE_instances, (size_t)builder->scene->instance_count, sizeof(Instance));
    set_bytes(tables, HD_TABLE_triangles, sizes->triangles, sizeof(Triangle));
    set_bytes(tables, HD_TABLE_mesh_nodes, sizes->nodes, sizeof(MeshNode));
    set_bytes(tables, HD_TABLE_wide_bounds, sizes->wide_nodes * 6 * lanes, sizeof(real));
    set_bytes(tables, HD_TABLE_wide_children, sizes->wide_nodes * lanes, sizeof(int));
    if (builder->top.node_count > 0)
        set_bytes(tables, HD_TABLE_top_items, (size_t)builder->scene->instance_count, sizeof(int));
    set_bytes(tables, HD_TABLE_skins, sizes->skins, sizeof(Skin));
    set_bytes(tables, HD_TABLE_mesh_normals, sizes->normals, sizeof(Vector));
    /* Kernels read four corners at a time. */
    set_bytes(tables, HD_TABLE_corner_normals, sizes->corner_normals + 1, sizeof(int));
    set_bytes(tables, HD_TABLE_mesh_uvs, sizes->uvs, sizeof(TextureCoordinates));
    set_bytes(tables, HD_TABLE_corner_uvs, sizes->corner_uvs + 1, sizeof(int));
    set_bytes(tables, HD_TABLE_pictures, (size_t)builder->scene->picture_count, sizeof(Picture));
}

static void size_tables(const HdBuilder *builder, HdSceneTables *tables) {
    size_t objects = (size_t)builder->object_count, lights = (size_t)builder->light_count;
    size_t planes = (size_t)builder->plane_count;
    set_bytes(tables, HD_TABLE_header, 1, sizeof(Header));
    set_bytes(tables, HD_TABLE_objects, objects, sizeof(Object));
    set_bytes(tables, HD_TABLE_planes, planes, sizeof(Plane));
    set_bytes(tables, HD_TABLE_edges, (size_t)builder->edge_count, sizeof(Edge));
    set_bytes(tables, HD_TABLE_materials,
              2 * (size_t)builder->solid_count + 1 + builder->sizes.skins, sizeof(Material));
    set_bytes(tables, HD_TABLE_lights, lights, sizeof(Light));
    set_bytes(tables, HD_TABLE_light_offsets, objects * lights, sizeof(Vector));
    set_bytes(tables, HD_TABLE_light_coordinates, lights * planes, sizeof(real));
    set_bytes(tables, HD_TABLE_light_sides, lights * objects, sizeof(LightSides));
    set_bytes(tables, HD_TABLE_object_offsets, objects * objects, sizeof(Vector));
    set_bytes(tables, HD_TABLE_floor_map, 1, sizeof(FloorMap));
    set_bytes(tables, HD_TABLE_texels, 2 * builder->first_picture_texel + builder->sizes.texels + 2,
              sizeof(uint));
    size_mesh_tables(builder, tables);
}

static HdStatus allocate_builder(HdBuilder *builder, HdSceneTables *tables, HdError *error) {
    builder->centres = calloc((size_t)builder->object_count + 1, sizeof *builder->centres);
    builder->sources = calloc((size_t)builder->light_count + 1, sizeof *builder->sources);
    if (builder->centres == NULL || builder->sources == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: the scene has %d lights",
                       builder->light_count);
    size_tables(builder, tables);
    tables->table_count = HD_SCENE_TABLE_COUNT;
    const HdRoom machine = {.name = "this machine",
                            .advice = "fewer triangles need less",
                            .memory = hd_physical_memory()};
    HdStatus status = hd_check_room(tables, &machine, error);
    for (int i = 0; status == HD_OK && i < HD_SCENE_TABLE_COUNT; i++) {
        char what[64];
        snprintf(what, sizeof what, "scene's %s", hd_scene_table_content(i));
        status = hd_table_allocate(&tables->table[i], what, error);
        builder->table[i] = tables->table[i].data;
    }
    return status;
}

static void describe_material(HdSceneTables *tables, const HdMaterial *material) {
    tables->refracts |= material->index_of_refraction != 1.0;
    tables->lit_from_behind |= material->lit_from_behind;
}

/* What kernels are specialised by. */
static void describe_shape(const HdBuilder *builder, HdSceneTables *tables) {
    const HdScene *scene = builder->scene;
    tables->plane_count = builder->plane_count;
    tables->depth = scene->depth;
    tables->surveyed = hd_scene_is_surveyed(scene);
    tables->node_stack = builder->node_stack;
    if (builder->has_floor)
        describe_material(tables, &scene->floor.material);
    for (int s = 0; s < builder->solid_count; s++)
        describe_material(tables, &scene->solids[s].face);
    for (int i = 0; i < scene->instance_count; i++)
        for (int m = 0; m < hd_mesh_of(scene, i)->material_count; m++)
            describe_material(
                tables, hd_material_of(&scene->instances[i], &hd_mesh_of(scene, i)->materials[m]));
}

HdStatus NAMED(hd_compile_scene)(HdSceneTables *tables, const HdScene *scene, HdError *error) {
    const HdTexture *texture = &scene->floor.texture;
    HdBuilder builder = {.scene = scene, .lanes = tables->lanes};
    HdStatus status = hd_builder_shape_solids(&builder, error);
    if (status == HD_OK)
        status = hd_builder_prepare_meshes(&builder, error);
    if (status == HD_OK) {
        hd_builder_count(&builder);
        describe_shape(&builder, tables);
        builder.first_mesh_material = 2 * builder.solid_count + 1;
        builder.first_picture_texel = (size_t)texture->width * (size_t)texture->height + 1;
        status = allocate_builder(&builder, tables, error);
    }
    if (status == HD_OK) {
        hd_builder_place_objects(&builder);
        hd_builder_list_lights(&builder);
        NAMED(hd_fill_header)(&builder, tables);
        NAMED(hd_fill_solids)(&builder);
        NAMED(hd_fill_floor)(&builder);
        NAMED(hd_fill_object_offsets)(&builder);
        NAMED(hd_fill_meshes)(&builder);
        NAMED(hd_fill_lights)(&builder);
    }
    hd_builder_free_meshes(&builder);
    free(builder.shapes);
    free(builder.centres);
    free(builder.sources);
    return status;
}
