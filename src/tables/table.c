/* SPDX-License-Identifier: MIT */
#include "tables/table.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/minmax.h"
#include "kernels/host/shared.h"
#include "system/machine.h"

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
        [HD_TABLE_occlusion_masks] = "occlusion masks",
        [HD_TABLE_light_clusters] = "clusters of lights",
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
        [HD_TABLE_mesh_materials] = "materials of meshes",
        [HD_TABLE_mesh_normals] = "normals",
        [HD_TABLE_corner_normals] = "normals of corners",
        [HD_TABLE_mesh_uvs] = "texture coordinates",
        [HD_TABLE_corner_uvs] = "texture coordinates of corners",
        [HD_TABLE_corner_colours] = "colours of corners",
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
    tables->bounded = tables->bounded || like->bounded;
    tables->cut_outs = tables->cut_outs || like->cut_outs;
    tables->environment = tables->environment || like->environment;
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

/* Memory */

const char hd_budget_advice[] = "try fewer triangles, a device with more memory, or --backend c";

void hd_byte_text(double bytes, char out[HD_BYTE_TEXT_SIZE]) {
    static const char *const units[] = {"bytes", "kB", "MB", "GB", "TB"};
    int unit = 0;
    while (bytes >= 999.5 && unit < 4) {
        bytes /= 1000.0;
        unit++;
    }
    int decimals = unit == 0 || bytes >= 99.95 ? 0 : bytes >= 9.995 ? 1 : 2;
    snprintf(out, HD_BYTE_TEXT_SIZE, "%.*f %s", decimals, bytes, units[unit]);
}

HdStatus hd_check_budget(const HdSceneTables *tables, const HdMemoryBudget *capacity,
                         HdError *error) {
    char need[HD_BYTE_TEXT_SIZE], most[HD_BYTE_TEXT_SIZE], at_once[HD_BYTE_TEXT_SIZE],
        memory[HD_BYTE_TEXT_SIZE];
    double all = 0.0, largest_bytes = 0.0;
    int largest = 0;
    for (int i = 0; i < tables->table_count; i++) {
        const double bytes = (double)tables->table[i].bytes;
        all += bytes;
        largest = bytes > largest_bytes ? i : largest;
        largest_bytes = fmax(bytes, largest_bytes);
    }
    hd_byte_text(all, need);
    hd_byte_text(largest_bytes, most);
    hd_byte_text(capacity->at_once, at_once);
    hd_byte_text(capacity->memory, memory);
    const char *content = hd_scene_table_content(largest);
    if (capacity->memory > 0.0 && all > capacity->memory)
        return hd_fail(error, HD_UNAVAILABLE,
                       "the scene's tables need %s, %s of them for its %s; %s has %s; %s", need,
                       most, content, capacity->name, memory, capacity->advice);
    if (capacity->at_once > 0.0 && largest_bytes > capacity->at_once)
        return hd_fail(error, HD_UNAVAILABLE,
                       "the scene's %s need %s in one buffer; %s allows %s of its %s; %s", content,
                       most, capacity->name, at_once, memory, capacity->advice);
    return HD_OK;
}

HdStatus hd_table_allocate(HdTable *table, const char *what, HdError *error) {
    char need[HD_BYTE_TEXT_SIZE];
    size_t bytes = (table->bytes + 63) / 64 * 64 + 64;
    hd_byte_text((double)table->bytes, need);
    table->data = hd_large_allocate(bytes);
    if (table->data == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: the %s need %s", what, need);
    memset(table->data, 0, bytes);
    return HD_OK;
}
