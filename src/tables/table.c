/* SPDX-License-Identifier: MIT */
#include "tables/table.h"

#include <stdlib.h>
#include <string.h>

#include "base/minmax.h"
#include "kernels/host/shared.h"

const char *hd_scene_table_content(int table) {
    static const char *const contents[HD_SCENE_TABLE_COUNT] = {
        [HD_TABLE_header] = "numbers",
        [HD_TABLE_objects] = "objects",
        [HD_TABLE_planes] = "planes",
        [HD_TABLE_edges] = "edges",
        [HD_TABLE_materials] = "materials",
        [HD_TABLE_lights] = "lights",
        [HD_TABLE_light_offsets] = "places of lights",
        [HD_TABLE_light_coordinates] = "distances of lights from planes",
        [HD_TABLE_light_sides] = "sides of lights",
        [HD_TABLE_light_ways] = "what lies beside the ways of lights",
        [HD_TABLE_light_groups] = "groups of lights",
        [HD_TABLE_light_runs] = "runs of lights",
        [HD_TABLE_object_offsets] = "places of objects",
        [HD_TABLE_floor_map] = "maps of the floor",
        [HD_TABLE_texels] = "texels",
        [HD_TABLE_instances] = "instances of meshes",
        [HD_TABLE_triangles] = "triangles",
        [HD_TABLE_mesh_nodes] = "nodes over triangles",
        [HD_TABLE_wide_bounds] = "boxes of wide nodes",
        [HD_TABLE_wide_children] = "children of wide nodes",
        [HD_TABLE_top_items] = "lists of instances",
        [HD_TABLE_skins] = "materials of meshes",
        [HD_TABLE_mesh_normals] = "normals",
        [HD_TABLE_corner_normals] = "normals of corners",
        [HD_TABLE_mesh_uvs] = "texture coordinates",
        [HD_TABLE_corner_uvs] = "texture coordinates of corners",
        [HD_TABLE_pictures] = "textures",
    };
    return contents[table];
}

static void free_tables(HdTable *table, int count) {
    for (int i = 0; i < count; i++)
        free(table[i].data);
}

void hd_scene_tables_raise(HdSceneTables *tables, const HdSceneTables *like) {
    tables->plane_count = hd_max(tables->plane_count, like->plane_count);
    tables->depth = hd_max(tables->depth, like->depth);
    tables->node_stack = hd_max(tables->node_stack, like->node_stack);
    tables->refracts = tables->refracts || like->refracts;
    tables->lit_from_behind = tables->lit_from_behind || like->lit_from_behind;
    tables->many_lights = tables->many_lights || like->many_lights;
    tables->surveyed = tables->surveyed || like->surveyed;
    tables->small_tables = tables->small_tables && like->small_tables;
}

void hd_scene_tables_free(HdSceneTables *tables) {
    free_tables(tables->table, tables->table_count);
    memset(tables, 0, sizeof *tables);
}

void hd_frame_tables_free(HdFrameTables *tables) {
    free_tables(tables->table, tables->table_count);
    memset(tables, 0, sizeof *tables);
}
