/* SPDX-License-Identifier: MIT */
/* All tables of a scene, and of a frame: their sizes, memory and contents; compiled for each
   precision. */
#include "tables/builder.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/sample_pattern.h"
#include "system/machine.h"

_Static_assert(HD_SCENE_TABLE_COUNT <= sizeof((HdSceneTables){0}.table) / sizeof(HdTable),
               "HdSceneTables has room for every table");
_Static_assert(HD_FRAME_TABLE_COUNT <= sizeof((HdFrameTables){0}.table) / sizeof(HdTable),
               "HdFrameTables has room for every table");
_Static_assert(HD_MAX_FACES < 32, "LightSides has a bit for each face");

/* Sets the size of each table. */
static void size_tables(const HdBuilder *builder, HdSceneTables *tables) {
#define SIZE(type, name) sizeof(type),
    static const size_t row_bytes[] = {HD_SCENE_TABLES(SIZE)};
#undef SIZE
    const HdMeshSizes *sizes = &builder->sizes;
    size_t objects = (size_t)builder->object_count, lights = (size_t)builder->light_count;
    size_t planes = (size_t)builder->plane_count, lanes = (size_t)builder->lanes;
    size_t instances = (size_t)builder->scene->instance_count;
    const size_t rows[HD_SCENE_TABLE_COUNT] = {
        [HD_TABLE_header] = 1,
        [HD_TABLE_objects] = objects,
        [HD_TABLE_planes] = planes,
        [HD_TABLE_edges] = (size_t)builder->edge_count,
        [HD_TABLE_materials] = 2 * (size_t)builder->solid_count + 1 + sizes->mesh_materials,
        [HD_TABLE_lights] = lights,
        [HD_TABLE_light_offsets] = objects * lights,
        [HD_TABLE_light_coordinates] = lights * planes,
        [HD_TABLE_light_sides] = lights * objects,
        [HD_TABLE_occlusion_masks] = objects * (lights + 1),
        [HD_TABLE_light_clusters] = objects * HD_CLUSTER_ROWS * HD_LIGHT_CLUSTERS(lights),
        [HD_TABLE_light_runs] = tables->many_lights ? objects * lights : 0,
        [HD_TABLE_object_offsets] = objects * objects,
        [HD_TABLE_floor_map] = 1,
        [HD_TABLE_texels] = 2 * builder->texels + 4, /* kernels read four words at a time */
        [HD_TABLE_instances] = instances,
        [HD_TABLE_triangles] = sizes->triangles,
        [HD_TABLE_mesh_nodes] = sizes->nodes,
        [HD_TABLE_wide_bounds] = sizes->wide_nodes * 6 * lanes,
        [HD_TABLE_wide_children] = sizes->wide_nodes * lanes,
        [HD_TABLE_top_items] = builder->top.node_count > 0 ? instances : 0,
        [HD_TABLE_mesh_materials] = sizes->mesh_materials,
        [HD_TABLE_mesh_normals] = sizes->normals,
        [HD_TABLE_corner_normals] = sizes->corner_normals + 1, /* likewise */
        [HD_TABLE_mesh_uvs] = sizes->uvs,
        [HD_TABLE_corner_uvs] = sizes->corner_uvs + 1,
        [HD_TABLE_corner_colours] = sizes->corner_colours,
        [HD_TABLE_pictures] = (size_t)builder->picture_count,
    };
    tables->table_count = HD_SCENE_TABLE_COUNT;
    for (int i = 0; i < HD_SCENE_TABLE_COUNT; i++)
        tables->table[i].bytes = rows[i] * row_bytes[i];
#define FITS(type, name, most) rows[HD_TABLE_##name] <= (most) &&
    tables->small_tables = HD_SMALL_SCENE_TABLES(FITS) true;
#undef FITS
}

/* Kernels count the two words of a texel in an int. */
enum { MAX_TEXELS = (1 << 30) - 2 };

static HdStatus allocate_builder(HdBuilder *builder, HdSceneTables *tables, HdError *error) {
    if (builder->texels > MAX_TEXELS)
        return hd_fail(error, HD_BAD_INPUT,
                       "the scene's textures have %zu texels, expected at most %d", builder->texels,
                       MAX_TEXELS);
    builder->centres = calloc((size_t)builder->object_count + 1, sizeof *builder->centres);
    builder->sources = calloc((size_t)builder->light_count + 1, sizeof *builder->sources);
    builder->clustered = calloc((size_t)builder->light_count + 1, sizeof *builder->clustered);
    if (builder->centres == NULL || builder->sources == NULL || builder->clustered == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: the scene has %d lights",
                       builder->light_count);
    size_tables(builder, tables);
    const HdMemoryBudget machine = {.name = "this machine",
                                    .advice = "fewer triangles need less",
                                    .memory = hd_physical_memory()};
    HD_TRY(hd_check_budget(tables, &machine, error));
    for (int i = 0; i < HD_SCENE_TABLE_COUNT; i++) {
        char what[64];
        snprintf(what, sizeof what, "scene's %s", hd_scene_table_content(i));
        HD_TRY(hd_table_allocate(&tables->table[i], what, error));
        builder->table[i] = tables->table[i].data;
    }
    return HD_OK;
}

static void describe_material(HdSceneTables *tables, const HdMaterial *material) {
    tables->refracts |= material->index_of_refraction != 1.0;
    tables->lit_from_behind |= material->lit_from_behind;
}

/* Sets the members that kernels are specialised by. */
static void describe_shape(const HdBuilder *builder, HdSceneTables *tables) {
    const HdScene *scene = builder->scene;
    tables->plane_count = builder->plane_count;
    tables->light_count = builder->light_count;
    tables->depth = scene->depth;
    tables->many_lights = builder->lanes == 1 && HD_LIGHT_CLUSTERS(builder->light_count) > 0;
    tables->bounded = hd_scene_has_error_bound(scene);
    tables->environment = builder->environment_picture >= 0;
    tables->node_stack = builder->node_stack;
    if (builder->has_floor)
        describe_material(tables, &scene->floor.material);
    for (int s = 0; s < builder->solid_count; s++)
        describe_material(tables, &scene->solids[s].face);
    for (int i = 0; i < scene->instance_count; i++)
        for (int m = 0; m < hd_mesh_of(scene, i)->material_count; m++) {
            const HdMesh *mesh = hd_mesh_of(scene, i);
            const HdMaterial material = hd_instance_material(scene, &scene->instances[i], m);
            describe_material(tables, &material);
            tables->cut_outs |= mesh->materials[m].mask_picture >= 0 && mesh->uvs != NULL;
        }
}

HdStatus NAMED(hd_compile_scene)(HdSceneTables *tables, const HdScene *scene, HdError *error) {
    HdBuilder builder = {.scene = scene, .lanes = tables->lanes};
    HdStatus status = hd_builder_count(&builder, error);
    if (status == HD_OK)
        status = hd_builder_prepare_meshes(&builder, error);
    if (status == HD_OK) {
        describe_shape(&builder, tables);
        builder.first_mesh_material = 2 * builder.solid_count + 1;
        status = allocate_builder(&builder, tables, error);
    }
    if (status == HD_OK) {
        for (int i = 0; i < builder.object_count; i++)
            builder.centres[i] = hd_object_centre(scene, i);
        hd_builder_list_lights(&builder);
        NAMED(hd_fill_header)(&builder, tables);
        NAMED(hd_fill_solids)(&builder);
        if (tables->bounded)
            NAMED(hd_fill_seen)(&builder);
        NAMED(hd_fill_floor)(&builder);
        NAMED(hd_fill_pictures)(&builder);
        NAMED(hd_fill_object_offsets)(&builder);
        NAMED(hd_fill_meshes)(&builder);
        NAMED(hd_fill_lights)(&builder);
    }
    hd_builder_free_meshes(&builder);
    free(builder.shapes);
    free(builder.centres);
    free(builder.sources);
    free(builder.clustered);
    return status;
}

/* ---- a frame ---- */

static int ceil_log2(int n) {
    int bits = 0;
    while ((1 << bits) < n)
        bits++;
    return bits;
}

/* Small bounds matter most, so the fraction has more bits the smaller the maximum is. */
enum { MAX_BOUND_BITS = 44 };

static void fill_fixed_bound(View *view, double max_left_out, int samples) {
    int exponent;
    frexp(max_left_out, &exponent);
    int bits = exponent + MAX_BOUND_BITS <= 61 ? MAX_BOUND_BITS : 61 - exponent;
    int excess = exponent + bits + ceil_log2(samples) - 62;
    view->bound_shift = excess > 0 ? excess : 0;
    view->bound_to_fixed = (real)ldexp(1.0, bits);
    view->bound_from_fixed = (real)ldexp(1.0, view->bound_shift - bits);
}

/* A contribution is at most 2^16 and the weights at one depth add up to at most 1. So a sample's
   sum is at most (depth + 1) 2^16; 62 bits hold a pixel's sum of samples. */
static void fill_fixed_point(View *view, const HdScene *scene, int samples) {
    int sum_bits = 16 + ceil_log2(scene->depth + 1);
    int sample_bits = sum_bits + 40 <= 62 ? 40 : 62 - sum_bits;
    int excess = sum_bits + sample_bits + ceil_log2(samples) - 62;
    view->pixel_shift = excess > 0 ? excess : 0;
    view->to_fixed = (real)ldexp(1.0, sample_bits);
    view->from_fixed = (real)ldexp(1.0, view->pixel_shift - sample_bits);
}

/* Returns whether the samples' positions are a table. */
static bool is_patterned(const HdScene *scene, const HdPixelList *list) {
    return list != NULL || scene->sampling != HD_SAMPLING_GRID;
}

static void fill_view(View *view, const HdFrameTables *tables, const HdScene *scene,
                      const HdCamera *camera, const HdPixelList *list) {
    const HdCrop *crop = &scene->crop;
    int whole_width = crop->whole_width > 0 ? crop->whole_width : scene->width;
    int whole_height = crop->whole_height > 0 ? crop->whole_height : scene->height;
    int side = hd_sample_lattice(scene);
    double step = camera->tangent_of_half_fov / ((double)whole_width * (double)side);
    hd_store3(view->forward, camera->forward);
    hd_store3(view->right, hd_scale(camera->right, step));
    hd_store3(view->down, hd_scale(camera->up, -step));
    view->cutoff = (real)scene->cutoff;
    view->width = tables->width;
    view->height = tables->height;
    view->samples = tables->samples;
    view->grid_side = side;
    view->first_column = 1 - whole_width * side + 2 * crop->left * side;
    view->first_row = 1 - whole_height * side + 2 * crop->top * side;
    view->depth = scene->depth;
    view->listed = list != NULL;
    view->patterned = is_patterned(scene, list);
    fill_fixed_point(view, scene, tables->samples);
    if (list != NULL) {
        view->bound_cutoff = (real)list->bound_cutoff;
        fill_fixed_bound(view, list->max_left_out, tables->samples);
    }
}

/* Copies the list; entries that fill up the frame's last row are empty. */
static void fill_list(const HdFrameTables *tables, const HdPixelList *list) {
    int *entries = tables->table[HD_TABLE_entries].data;
    size_t words = tables->table[HD_TABLE_entries].bytes / sizeof *entries;
    size_t filled = (size_t)list->entry_count;
    memcpy(entries, list->entries, filled * sizeof *entries);
    for (size_t i = filled; i < words; i++)
        entries[i] = -1;
}

static void fill_places(const HdFrameTables *tables, const HdScene *scene) {
    int *places = tables->table[HD_TABLE_sample_places].data;
    hd_sample_places(scene, places);
    for (int i = 0; i < HD_PATTERN_SPARE; i++)
        places[tables->samples + i] = places[i % tables->samples];
}

HdStatus NAMED(hd_compile_frame)(HdFrameTables *tables, const HdScene *scene,
                                 const HdCamera *camera, const HdPixelList *list, HdError *error) {
    int object_count = hd_object_count(scene);
    tables->table_count = HD_FRAME_TABLE_COUNT;
    tables->table[HD_TABLE_view].bytes = sizeof(View);
    tables->table[HD_TABLE_eye_offsets].bytes = (size_t)object_count * sizeof(Vector);
    if (list != NULL)
        tables->table[HD_TABLE_entries].bytes =
            sizeof(int) * (size_t)tables->width * (size_t)tables->height;
    if (is_patterned(scene, list))
        tables->table[HD_TABLE_sample_places].bytes =
            sizeof(int) * ((size_t)tables->samples + HD_PATTERN_SPARE);
    for (int i = 0; i < HD_FRAME_TABLE_COUNT; i++)
        HD_TRY(hd_table_allocate(&tables->table[i], "tables of a frame", error));
    fill_view(tables->table[HD_TABLE_view].data, tables, scene, camera, list);
    if (list != NULL)
        fill_list(tables, list);
    if (is_patterned(scene, list))
        fill_places(tables, scene);
    Vector *offsets = tables->table[HD_TABLE_eye_offsets].data;
    for (int object = 0; object < object_count; object++)
        offsets[object] = hd_as_vector(hd_sub(camera->eye, hd_object_centre(scene, object)));
    return HD_OK;
}
