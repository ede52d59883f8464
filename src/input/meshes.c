/* SPDX-License-Identifier: MIT */
#include "input/meshes.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "image/picture.h"
#include "mesh/mesh.h"
#include "scene/check.h"
#include "system/interrupt.h"
#include "system/machine.h"

typedef struct Loader {
    const HdSceneFile *file;
    HdScene *scene;
    HdProblems *problems, *notes;
    HdError *error;
    double room;      /* bytes that files may still take */
    int *first_entry; /* for each mesh the number of the first entry that names it */
} Loader;

static HdStatus fail_memory(const Loader *loader) {
    return hd_fail(loader->error, HD_FAILED, "out of memory: no room for the scene's meshes");
}

/* What is wrong with a file is told along with the rest of the scene; anything else ends it. */
static HdStatus told(Loader *loader, HdStatus status, int mesh) {
    if (status != HD_BAD_INPUT)
        return status;
    hd_problem(loader->problems, "meshes[%d].file: %s", loader->first_entry[mesh],
               loader->error->message);
    return HD_OK;
}

/* Which entries share a mesh */

static int compare_numbers(double a, double b) {
    return (a > b) - (a < b);
}

/* An entry whose file was refused has none. */
static const char *file_of(const HdMeshEntry *entry) {
    return entry->file != NULL ? entry->file : "";
}

static int compare_meshes(const HdMeshEntry *a, const HdMeshEntry *b) {
    const int files = strcmp(file_of(a), file_of(b));
    if (files != 0 || a->normals != b->normals)
        return files != 0 ? files : (int)a->normals - (int)b->normals;
    return a->normals == HD_NORMALS_SMOOTH ? compare_numbers(a->crease_degrees, b->crease_degrees)
                                           : 0;
}

/* Entries of one mesh in their order. */
static int compare_entries(const void *a, const void *b) {
    const HdMeshEntry *first = *(const HdMeshEntry *const *)a;
    const HdMeshEntry *second = *(const HdMeshEntry *const *)b;
    const int meshes = compare_meshes(first, second);
    return meshes != 0 ? meshes : (first > second) - (first < second);
}

/* Numbers meshes in the order in which entries name them. `sorted` has room for all entries. */
static void number_meshes(Loader *loader, const HdMeshEntry **sorted) {
    const HdMeshEntry *entries = loader->file->mesh_entries;
    HdInstance *instances = loader->scene->instances;
    const int count = loader->file->mesh_entry_count;
    for (int i = 0; i < count; i++)
        sorted[i] = &entries[i];
    qsort(sorted, (size_t)count, sizeof(const HdMeshEntry *), compare_entries);
    for (int i = 0, first = 0; i < count; i++) {
        if (compare_meshes(sorted[first], sorted[i]) != 0)
            first = i;
        instances[sorted[i] - entries].mesh = (int)(sorted[first] - entries);
    }
    for (int i = 0; i < count; i++) {
        const int first = instances[i].mesh;
        if (first == i)
            loader->first_entry[loader->scene->mesh_count] = i;
        instances[i].mesh = first == i ? loader->scene->mesh_count++ : instances[first].mesh;
    }
}

static HdStatus place_instances(Loader *loader) {
    HdScene *scene = loader->scene;
    const size_t count = (size_t)loader->file->mesh_entry_count;
    const HdMeshEntry **sorted = malloc(count * sizeof(const HdMeshEntry *));
    loader->first_entry = calloc(count, sizeof *loader->first_entry);
    scene->instances = calloc(count, sizeof *scene->instances);
    const bool has_room = sorted != NULL && loader->first_entry != NULL && scene->instances != NULL;
    if (has_room) {
        scene->instance_count = (int)count;
        for (size_t i = 0; i < count; i++)
            scene->instances[i] = loader->file->mesh_entries[i].instance;
        number_meshes(loader, sorted);
    }
    free(sorted);
    return has_room ? HD_OK : fail_memory(loader);
}

/* Files */

static double bytes_of(const HdMesh *mesh) {
    const double corner = sizeof *mesh->corners + sizeof *mesh->corner_normals +
                          sizeof *mesh->corner_uvs + sizeof *mesh->material_of;
    return (double)mesh->vertex_count * sizeof *mesh->vertices +
           (double)mesh->normal_count * sizeof *mesh->normals +
           (double)mesh->uv_count * sizeof *mesh->uvs + mesh->triangle_count * corner +
           (double)mesh->material_count * sizeof *mesh->materials;
}

static void flatten(HdMesh *mesh) {
    free(mesh->normals);
    free(mesh->corner_normals);
    mesh->normals = NULL;
    mesh->corner_normals = NULL;
    mesh->normal_count = 0;
}

static HdStatus read_mesh(Loader *loader, HdMesh *mesh, const HdMeshEntry *entry) {
    char path[HD_MAX_PATH];
    HdStatus status = hd_path_expand_home(entry->file, path, loader->error);
    const double room = fmin(fmax(loader->room, 0.0), (double)(SIZE_MAX / 2));
    if (status == HD_OK)
        status = hd_mesh_read_obj(mesh, path, (size_t)room, loader->notes, loader->error);
    if (status == HD_OK && entry->normals == HD_NORMALS_FLAT)
        flatten(mesh);
    if (status == HD_OK && entry->normals == HD_NORMALS_SMOOTH)
        status = hd_mesh_smooth(mesh, entry->crease_degrees, loader->error);
    loader->room -= bytes_of(mesh);
    return status;
}

static HdStatus read_meshes(Loader *loader) {
    HdScene *scene = loader->scene;
    HdStatus status = HD_OK;
    scene->meshes = calloc((size_t)scene->mesh_count, sizeof *scene->meshes);
    if (scene->meshes == NULL) {
        scene->mesh_count = 0;
        return fail_memory(loader);
    }
    for (int i = 0; i < scene->mesh_count && status == HD_OK; i++) {
        const HdMeshEntry *entry = &loader->file->mesh_entries[loader->first_entry[i]];
        if (hd_interrupt_signal() != 0)
            return hd_fail(loader->error, HD_INTERRUPTED, "interrupted while reading meshes");
        if (entry->file != NULL)
            status = told(loader, read_mesh(loader, &scene->meshes[i], entry), i);
    }
    return status;
}

/* Textures */

static int compare_textures(const void *a, const void *b) {
    const HdMeshMaterial *first = *(HdMeshMaterial *const *)a;
    const HdMeshMaterial *second = *(HdMeshMaterial *const *)b;
    return strcmp(first->texture, second->texture);
}

/* Materials with a texture; without `out` only their number. */
static size_t gather_textured(const HdScene *scene, HdMeshMaterial **out) {
    size_t count = 0;
    for (int i = 0; i < scene->mesh_count; i++)
        for (int k = 0; k < scene->meshes[i].material_count; k++) {
            HdMeshMaterial *material = &scene->meshes[i].materials[k];
            if (material->texture == NULL)
                continue;
            if (out != NULL)
                out[count] = material;
            count++;
        }
    return count;
}

static HdStatus read_picture(Loader *loader, const char *path, int *number) {
    HdPicture *picture = &loader->scene->pictures[loader->scene->picture_count];
    const HdStatus status = hd_texture_read(&picture->texture, path, HD_CURVE_SRGB, loader->error);
    *number = -1;
    if (status == HD_BAD_INPUT) {
        hd_problem(loader->notes, "%s; materials with this texture keep their colour alone",
                   loader->error->message);
        return HD_OK;
    }
    if (status != HD_OK)
        return status;
    const double pixels = (double)picture->texture.width * picture->texture.height;
    *number = loader->scene->picture_count++;
    loader->room -= pixels * 3 * sizeof *picture->texture.texels;
    if (loader->room < 0.0)
        hd_problem(loader->problems,
                   "meshes: their files up to the texture %s take more memory than they may: one "
                   "of %d parts of what this machine has",
                   path, HD_MESH_MEMORY_PART);
    return HD_OK;
}

static HdStatus read_pictures(Loader *loader, HdMeshMaterial **textured, size_t count) {
    HdStatus status = HD_OK;
    int number = -1;
    qsort(textured, count, sizeof(HdMeshMaterial *), compare_textures);
    for (size_t i = 0; i < count && status == HD_OK && loader->room >= 0.0; i++) {
        if (i == 0 || compare_textures(&textured[i - 1], &textured[i]) != 0)
            status = read_picture(loader, textured[i]->texture, &number);
        textured[i]->picture = number;
    }
    return status;
}

static HdStatus load_pictures(Loader *loader) {
    const size_t count = gather_textured(loader->scene, NULL);
    if (count == 0)
        return HD_OK;
    HdMeshMaterial **textured = malloc(count * sizeof(HdMeshMaterial *));
    loader->scene->pictures = calloc(count, sizeof *loader->scene->pictures);
    if (textured == NULL || loader->scene->pictures == NULL) {
        free(textured);
        return fail_memory(loader);
    }
    gather_textured(loader->scene, textured);
    const HdStatus status = read_pictures(loader, textured, count);
    free(textured);
    return status;
}

/* The whole */

static HdStatus build(Loader *loader) {
    HdThreadPool *pool;
    HdStatus status = hd_thread_pool_create(&pool, hd_processor_count(), loader->error);
    if (status != HD_OK)
        return status;
    for (int i = 0; i < loader->scene->mesh_count && status == HD_OK; i++)
        status = hd_mesh_build(&loader->scene->meshes[i], pool, loader->error);
    hd_thread_pool_destroy(pool);
    return status;
}

static HdStatus load(Loader *loader) {
    HdStatus status = place_instances(loader);
    if (status == HD_OK)
        status = read_meshes(loader);
    if (status == HD_OK)
        status = load_pictures(loader);
    if (status == HD_OK && loader->problems->count == 0)
        status = build(loader);
    HdSceneChecker checker = {.problems = loader->problems, .naming = HD_NAMING_JSON};
    if (status == HD_OK && loader->problems->count == 0)
        hd_check_instances(&checker, loader->scene);
    return status;
}

HdStatus hd_scene_file_load_meshes(HdSceneFile *file, HdProblems *problems, HdProblems *notes,
                                   HdError *error) {
    HdProblems unwanted = {.count = 0};
    Loader loader = {.file = file,
                     .scene = &file->scene,
                     .problems = problems,
                     .notes = notes != NULL ? notes : &unwanted,
                     .error = error,
                     .room = fmin(hd_physical_memory() / HD_MESH_MEMORY_PART, HD_MAX_MESH_MEMORY)};
    if (file->mesh_entry_count == 0)
        return HD_OK;
    HdStatus status = load(&loader);
    free(loader.first_entry);
    if (status != HD_OK || problems->count > 0)
        hd_scene_drop_meshes(&file->scene);
    return status;
}
