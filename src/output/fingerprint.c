/* SPDX-License-Identifier: MIT */
#include "output/fingerprint.h"

#include <string.h>

#include "base/hash.h"
#include "input/write.h"

/* Made by cmake/sources_hash.cmake, like hd_kernels_hash. */
extern const char hd_sources_hash[];

static void add(uint64_t *hash, const void *data, size_t size) {
    *hash = hd_hash_bytes(*hash, data, size);
}

static void add_integer(uint64_t *hash, int value) {
    add(hash, &value, sizeof value);
}

/* That there is none differs from an empty one. */
static void add_array(uint64_t *hash, const void *array, int count, size_t size) {
    add_integer(hash, array != NULL);
    add_integer(hash, count);
    if (array != NULL)
        *hash = hd_hash_words(*hash, array, (size_t)count * size);
}

/* As it would be written: the scene, and what its meshes' files say about materials and places. */
static void add_objects(uint64_t *hash, const HdSceneFile *file) {
    const HdObjectType *entry_type = hd_field(&hd_scene_fields, "meshes")->object;
    const HdScene *scene = &file->scene;
    *hash = hd_object_hash(*hash, &hd_scene_fields, file);
    for (int i = 0; i < scene->mesh_count; i++)
        for (int k = 0; k < scene->meshes[i].material_count; k++)
            *hash =
                hd_object_hash(*hash, &hd_material_fields, &scene->meshes[i].materials[k].material);
    for (int i = 0; i < scene->instance_count; i++) {
        const HdMeshEntry entry = {.instance = scene->instances[i]};
        *hash = hd_object_hash(*hash, entry_type, &entry);
    }
}

/* What files hold besides */

static void add_texture(uint64_t *hash, const HdTexture *texture) {
    add_integer(hash, texture->width);
    add_array(hash, texture->texels, texture->height,
              (size_t)texture->width * 3 * sizeof *texture->texels);
}

/* The hierarchy follows from the rest. */
static void add_mesh(uint64_t *hash, const HdMesh *mesh) {
    const int triangles = mesh->triangle_count;
    add_array(hash, mesh->vertices, mesh->vertex_count, sizeof *mesh->vertices);
    add_array(hash, mesh->normals, mesh->normal_count, sizeof *mesh->normals);
    add_array(hash, mesh->uvs, mesh->uv_count, sizeof *mesh->uvs);
    add_array(hash, mesh->corners, triangles, sizeof *mesh->corners);
    add_array(hash, mesh->corner_normals, triangles, sizeof *mesh->corner_normals);
    add_array(hash, mesh->corner_uvs, triangles, sizeof *mesh->corner_uvs);
    add_array(hash, mesh->material_of, triangles, sizeof *mesh->material_of);
    add_array(hash, mesh->group_of, triangles, sizeof *mesh->group_of);
    add_integer(hash, mesh->material_count);
    for (int i = 0; i < mesh->material_count; i++) {
        const HdMeshMaterial *material = &mesh->materials[i];
        add(hash, &material->emission, sizeof material->emission);
        add_integer(hash, material->picture);
        add_integer(hash, material->passes_as);
        add_integer(hash, material->is_opaque_to_shadows);
    }
}

static void add_content(uint64_t *hash, const HdScene *scene) {
    add_texture(hash, &scene->floor.texture);
    add_integer(hash, scene->picture_count);
    for (int i = 0; i < scene->picture_count; i++) {
        add_texture(hash, &scene->pictures[i].texture);
        add_integer(hash, scene->pictures[i].is_clamped);
    }
    add_integer(hash, scene->mesh_count);
    for (int i = 0; i < scene->mesh_count; i++)
        add_mesh(hash, &scene->meshes[i]);
    add_integer(hash, scene->instance_count);
    for (int i = 0; i < scene->instance_count; i++)
        add_integer(hash, scene->instances[i].mesh);
}

/* What the command line changed */

static void add_options(uint64_t *hash, const HdScene *scene) {
    add_integer(hash, scene->crop.whole_width);
    add_integer(hash, scene->crop.whole_height);
    add_integer(hash, scene->crop.left);
    add_integer(hash, scene->crop.top);
    add_integer(hash, (int)scene->geometry);
    add_integer(hash, (int)scene->accel);
}

uint64_t hd_run_fingerprint(const HdSceneFile *file, HdPrecision precision,
                            const HdPictureStyle *style) {
    uint64_t hash = hd_hash_bytes(HD_HASH_START, hd_sources_hash, strlen(hd_sources_hash));
    add_objects(&hash, file);
    add_content(&hash, &file->scene);
    add_options(&hash, &file->scene);
    add_integer(&hash, (int)precision);
    add_integer(&hash, (int)style->curve);
    add_integer(&hash, style->bits);
    return hash;
}

uint64_t hd_frame_fingerprint(uint64_t run, int number) {
    return hd_hash_bytes(run, &number, sizeof number);
}
