/* SPDX-License-Identifier: MIT */
#include "input/files.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "image/panorama.h"
#include "image/picture.h"
#include "input/check.h"
#include "input/classic.h"
#include "mesh/mesh.h"
#include "scene/contact.h"
#include "scene/placement.h"
#include "system/interrupt.h"
#include "system/machine.h"

/* Built-in scenes and textures */

/* Generated from default.json, starter.json, classic.in and floor.png of scenes/. */
extern const unsigned char hd_default_scene[], hd_starter_scene[], hd_default_classic[],
    hd_default_texture[];
extern const size_t hd_default_scene_size, hd_starter_scene_size, hd_default_classic_size,
    hd_default_texture_size;

const char *hd_default_scene_text(size_t *size) {
    *size = hd_default_scene_size;
    return (const char *)hd_default_scene;
}

const char *hd_starter_scene_text(size_t *size) {
    *size = hd_starter_scene_size;
    return (const char *)hd_starter_scene;
}

HdStatus hd_default_input(HdSceneFile *input, HdError *error) {
    return hd_classic_parse(input, (const char *)hd_default_classic, hd_default_classic_size,
                            "the built-in configuration", HD_CLASSIC_DEFAULT_VARIANT, error);
}

bool hd_texture_path_is_relative(const char *path) {
    const bool is_at_home = path[0] == '~' && (path[1] == '\0' || path[1] == '/');
    return path[0] != '\0' && path[0] != '/' && !is_at_home &&
           strcmp(path, HD_BUILTIN_TEXTURE) != 0;
}

static void note_cut_short(const HdTexture *texture, const char *path, HdProblems *notes) {
    if (texture->is_cut_short && notes != NULL)
        hd_problem(notes, "%s ends early, so a part of the picture is grey or coarse", path);
}

HdStatus hd_scene_file_load_texture(HdSceneFile *file, HdProblems *notes, HdError *error) {
    HdTexture *texture = &file->scene.floor.texture;
    char expanded[HD_MAX_PATH];
    if (file->texture_path[0] == '\0')
        return HD_OK;
    if (strcmp(file->texture_path, HD_BUILTIN_TEXTURE) == 0)
        return hd_texture_decode(texture, hd_default_texture, hd_default_texture_size,
                                 "the built-in texture", file->texture_curve, error);
    HD_TRY(hd_path_expand_home(file->texture_path, expanded, error));
    HD_TRY(hd_texture_read(texture, expanded, file->texture_curve, error));
    note_cut_short(texture, expanded, notes);
    return HD_OK;
}

HdStatus hd_scene_file_load_environment(HdSceneFile *file, HdProblems *notes, HdError *error) {
    HdEnvironment *environment = &file->scene.environment;
    const HdTexture *texture = &environment->texture;
    char expanded[HD_MAX_PATH];
    if (environment->file == NULL)
        return HD_OK;
    HD_TRY(hd_path_expand_home(environment->file, expanded, error));
    HD_TRY(hd_panorama_read(&environment->texture, &environment->top, expanded, environment->curve,
                            notes, error));
    note_cut_short(texture, expanded, notes);
    if (texture->width != 2 * texture->height && notes != NULL)
        hd_problem(notes, "%s has %d x %d pixels, so it is stretched: a panorama is twice as wide",
                   expanded, texture->width, texture->height);
    return HD_OK;
}

/* Meshes */

typedef struct Loader {
    const HdSceneFile *file;
    HdScene *scene;
    HdProblems *problems, *notes;
    HdFaults texture_faults;
    HdError *error;
    double capacity;  /* bytes left for files */
    int *first_entry; /* number of the first entry of each mesh */
} Loader;

static HdStatus fail_memory(const Loader *loader) {
    return HD_NO_ROOM(loader->error, "the scene's meshes");
}

/* Reports a file's problem along with the scene's other ones; any other failure ends loading. */
static HdStatus report_mesh(Loader *loader, HdStatus status, int mesh) {
    if (status != HD_BAD_INPUT)
        return status;
    hd_problem(loader->problems, "meshes[%d].file: %s", loader->first_entry[mesh],
               loader->error->message);
    return HD_OK;
}

/* Reports faults that readers skipped: as notes, or if strict as problems of the part. */
static void report_faults(const Loader *loader, const HdProblems *faults, const char *part) {
    const bool is_strict = loader->file->is_strict;
    for (const char *line = faults->text; *line != '\0'; line += strcspn(line, "\n") + 1)
        hd_problem(is_strict ? loader->problems : loader->notes, "%s%.*s", is_strict ? part : "",
                   (int)strcspn(line, "\n"), line);
}

/* Assignment of entries to meshes */

static int compare_numbers(double a, double b) {
    return (a > b) - (a < b);
}

/* A rejected entry has no file. */
static const char *file_of(const HdMeshEntry *entry) {
    return entry->file != NULL ? entry->file : "";
}

static int compare_meshes(const HdMeshEntry *a, const HdMeshEntry *b) {
    const int files = strcmp(file_of(a), file_of(b));
    if (files != 0 || a->normals != b->normals)
        return files != 0 ? files : (int)a->normals - (int)b->normals;
    if (a->ambient != b->ambient)
        return compare_numbers(a->ambient, b->ambient);
    return a->normals == HD_NORMALS_SMOOTH ? compare_numbers(a->crease_degrees, b->crease_degrees)
                                           : 0;
}

/* Orders entries of one mesh as in the scene. */
static int compare_entries(const void *a, const void *b) {
    const HdMeshEntry *first = *(const HdMeshEntry *const *)a;
    const HdMeshEntry *second = *(const HdMeshEntry *const *)b;
    const int meshes = compare_meshes(first, second);
    return meshes != 0 ? meshes : (first > second) - (first < second);
}

/* Numbers meshes in the order of their first entries. `sorted` has space for all entries. */
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
    const bool has_memory =
        sorted != NULL && loader->first_entry != NULL && scene->instances != NULL;
    if (has_memory) {
        scene->instance_count = (int)count;
        for (size_t i = 0; i < count; i++) {
            scene->instances[i] = loader->file->mesh_entries[i].instance;
            scene->instances[i].entry = (int)i;
        }
        number_meshes(loader, sorted);
    }
    free(sorted);
    return has_memory ? HD_OK : fail_memory(loader);
}

/* Files */

static double bytes_of(const HdMesh *mesh) {
    const double corner = sizeof *mesh->corners + sizeof *mesh->corner_normals +
                          sizeof *mesh->corner_uvs + sizeof *mesh->material_of;
    return (double)mesh->vertex_count * sizeof *mesh->vertices +
           (double)mesh->normal_count * sizeof *mesh->normals +
           (mesh->colours != NULL ? (double)mesh->vertex_count * sizeof *mesh->colours : 0.0) +
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

static HdStatus read_obj(Loader *loader, HdMesh *mesh, int number, const char *path) {
    HdProblems faults = {.count = 0};
    char part[64];
    const double capacity = fmin(fmax(loader->capacity, 0.0), (double)(SIZE_MAX / 2));
    HD_TRY(hd_mesh_read_obj(mesh, path, (size_t)capacity, &faults, loader->notes, loader->error));
    snprintf(part, sizeof part, "meshes[%d].file: ", loader->first_entry[number]);
    report_faults(loader, &faults, part);
    return HD_OK;
}

static HdStatus read_mesh(Loader *loader, HdMesh *mesh, int number, const HdMeshEntry *entry) {
    char path[HD_MAX_PATH];
    HD_TRY(hd_path_expand_home(entry->file, path, loader->error));
    HD_TRY(read_obj(loader, mesh, number, path));
    for (int i = 0; i < mesh->material_count; i++)
        mesh->materials[i].material.ambient *= entry->ambient;
    if (entry->normals == HD_NORMALS_FLAT)
        flatten(mesh);
    if (entry->normals == HD_NORMALS_SMOOTH)
        HD_TRY(hd_mesh_smooth(mesh, entry->crease_degrees, loader->error));
    loader->capacity -= bytes_of(mesh);
    return HD_OK;
}

static HdStatus read_meshes(Loader *loader) {
    HdScene *scene = loader->scene;
    scene->meshes = calloc((size_t)scene->mesh_count, sizeof *scene->meshes);
    if (scene->meshes == NULL) {
        scene->mesh_count = 0;
        return fail_memory(loader);
    }
    for (int i = 0; i < scene->mesh_count; i++) {
        const HdMeshEntry *entry = &loader->file->mesh_entries[loader->first_entry[i]];
        if (hd_interrupt_signal() != 0)
            return hd_fail(loader->error, HD_INTERRUPTED, "interrupted while reading meshes");
        if (entry->file != NULL)
            HD_TRY(report_mesh(loader, read_mesh(loader, &scene->meshes[i], i, entry), i));
    }
    return HD_OK;
}

/* Textures */

/* A picture that a material needs. */
typedef struct Use {
    const char *path;
    bool is_mask, is_clamped;
    int *number; /* of the picture; -1: its file is none */
} Use;

static int compare_uses(const void *a, const void *b) {
    const Use *first = a, *second = b;
    const int paths = strcmp(first->path, second->path);
    if (paths != 0 || first->is_mask != second->is_mask)
        return paths != 0 ? paths : first->is_mask - second->is_mask;
    return first->is_clamped - second->is_clamped;
}

static HdStatus read_picture(Loader *loader, const Use *use, int *number) {
    HdPicture *picture = &loader->scene->pictures[loader->scene->picture_count];
    const HdStatus status =
        use->is_mask ? hd_mask_read(&picture->texture, use->path, loader->error)
                     : hd_texture_read(&picture->texture, use->path, HD_CURVE_SRGB, loader->error);
    *number = -1;
    if (status == HD_BAD_INPUT) {
        hd_fault(&loader->texture_faults, use->is_mask ? "mask" : "texture", 1,
                 "%s; materials with this %s", loader->error->message,
                 use->is_mask ? "mask have no holes" : "texture use their colour only");
        return HD_OK;
    }
    if (status != HD_OK)
        return status;
    note_cut_short(&picture->texture, use->path, loader->notes);
    picture->is_clamped = use->is_clamped;
    const double pixels = (double)picture->texture.width * picture->texture.height;
    *number = loader->scene->picture_count++;
    loader->capacity -= pixels * 3 * sizeof *picture->texture.texels;
    if (loader->capacity < 0.0)
        hd_problem(
            loader->problems,
            "meshes: the files up to the texture %s need more memory than 1/%d of this machine's",
            use->path, HD_MESH_MEMORY_PART);
    return HD_OK;
}

static HdStatus read_pictures(Loader *loader, Use *uses, size_t count) {
    int number = -1;
    qsort(uses, count, sizeof *uses, compare_uses);
    for (size_t i = 0; i < count && loader->capacity >= 0.0; i++) {
        if (i == 0 || compare_uses(&uses[i - 1], &uses[i]) != 0)
            HD_TRY(read_picture(loader, &uses[i], &number));
        *uses[i].number = number;
    }
    return HD_OK;
}

/* Lists the pictures of a mesh's materials; returns their count. */
static size_t list_uses(const HdMesh *mesh, Use *uses) {
    size_t count = 0;
    for (int k = 0; k < mesh->material_count; k++) {
        HdMeshMaterial *m = &mesh->materials[k];
        if (m->texture != NULL)
            uses[count++] = (Use){m->texture, false, m->is_clamped, &m->picture};
        if (m->mask != NULL)
            uses[count++] = (Use){m->mask, true, m->is_clamped, &m->mask_picture};
    }
    return count;
}

static HdStatus load_pictures(Loader *loader) {
    HdScene *scene = loader->scene;
    size_t most = 1, count = 0;
    for (int i = 0; i < scene->mesh_count; i++)
        most += 2 * (size_t)scene->meshes[i].material_count;
    Use *uses = malloc(most * sizeof *uses);
    scene->pictures = calloc(most, sizeof *scene->pictures);
    const bool has_memory = uses != NULL && scene->pictures != NULL;
    for (int i = 0; i < scene->mesh_count && has_memory; i++)
        count += list_uses(&scene->meshes[i], uses + count);
    const HdStatus status = has_memory ? read_pictures(loader, uses, count) : fail_memory(loader);
    free(uses);
    return status;
}

static void report_texture_faults(const Loader *loader) {
    HdProblems faults = {.count = 0};
    hd_faults_report(&loader->texture_faults, NULL, &faults);
    report_faults(loader, &faults, "meshes: ");
}

/* Loading */

static void fit_instances(const Loader *loader) {
    HdScene *scene = loader->scene;
    for (int i = 0; i < scene->instance_count; i++)
        if (loader->file->mesh_entries[i].size > 0.0)
            hd_instance_fit(&scene->instances[i], hd_mesh_of(scene, i),
                            loader->file->mesh_entries[i].size);
}

static HdStatus drop_second_instances(Loader *loader) {
    int dropped;
    HD_TRY(hd_scene_drop_second_instances(loader->scene, &dropped, loader->error));
    if (dropped > 0)
        hd_problem(
            loader->notes,
            "meshes: %d of them %s in the place of an earlier one of the same file; only the "
            "first one counts",
            dropped, dropped == 1 ? "is" : "are");
    return HD_OK;
}

static HdStatus load(Loader *loader) {
    HdSceneChecker checker = {.problems = loader->problems, .naming = HD_NAMING_JSON};
    HD_TRY(place_instances(loader));
    HD_TRY(read_meshes(loader));
    HD_TRY(load_pictures(loader));
    report_texture_faults(loader);
    if (loader->problems->count > 0)
        return HD_OK;
    HD_TRY(hd_scene_build_meshes(loader->scene, loader->error));
    fit_instances(loader);
    hd_check_instances(&checker, loader->scene);
    return loader->problems->count > 0 ? HD_OK : drop_second_instances(loader);
}

HdStatus hd_scene_file_load_meshes(HdSceneFile *file, HdProblems *problems, HdProblems *notes,
                                   HdError *error) {
    HdProblems unwanted = {.count = 0};
    Loader loader = {.file = file,
                     .scene = &file->scene,
                     .problems = problems,
                     .notes = notes != NULL ? notes : &unwanted,
                     .error = error,
                     .capacity =
                         fmin(hd_physical_memory() / HD_MESH_MEMORY_PART, HD_MAX_MESH_MEMORY)};
    if (file->mesh_entry_count == 0)
        return HD_OK;
    HdStatus status = load(&loader);
    free(loader.first_entry);
    if (status != HD_OK || problems->count > 0)
        hd_scene_drop_meshes(&file->scene);
    return status;
}
