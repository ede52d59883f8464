/* SPDX-License-Identifier: MIT */
#include "cli/mesh_report.h"

#include <math.h>
#include <stdlib.h>

#include "base/text.h"
#include "input/json.h"
#include "scene/placement.h"

/* Entries, and materials of each, that are printed. */
enum { MOST_LINES = 8, MOST_NAMES = 3 };

/* What a mesh is made of; found once for all places of the mesh. */
typedef struct Contents {
    bool *is_used; /* owned; for each material, whether a triangle has it; NULL: not found yet */
    int material_count, texture_count; /* used ones */
} Contents;

typedef struct Report {
    int entry, frame;
    bool has_camera;
    HdCamera camera; /* of the frame */
    const char *file;
    const HdMesh *mesh;
    const Contents *contents;
    bool is_covered; /* a material of the scene replaces those of the mesh */
    HdVec3 lower, upper;
    HdSight sight;
} Report;

/* `is_seen` has a place for each picture of the scene. */
static void count_materials(Contents *contents, const HdMesh *mesh, bool *is_seen) {
    for (int i = 0; i < mesh->triangle_count; i++)
        contents->is_used[mesh->material_of != NULL ? mesh->material_of[i] : 0] = true;
    for (int i = 0; i < mesh->material_count; i++) {
        const int picture = mesh->materials[i].picture;
        contents->material_count += contents->is_used[i];
        if (!contents->is_used[i] || mesh->materials[i].texture == NULL || picture < 0)
            continue;
        contents->texture_count += !is_seen[picture];
        is_seen[picture] = true;
    }
}

/* Returns false if memory is short. */
static bool find_contents(Contents *contents, const HdScene *scene, const HdMesh *mesh) {
    bool *is_seen = calloc((size_t)scene->picture_count + 1, sizeof *is_seen);
    contents->is_used = calloc((size_t)mesh->material_count, sizeof *contents->is_used);
    const bool has_memory = is_seen != NULL && contents->is_used != NULL;
    if (has_memory)
        count_materials(contents, mesh, is_seen);
    free(is_seen);
    return has_memory;
}

/* Returns false if memory is short. */
static bool make_report(Report *report, const HdSceneFile *file, int number, Contents *of_meshes) {
    const HdScene *scene = &file->scene;
    const HdInstance *instance = &scene->instances[number];
    Contents *contents = &of_meshes[instance->mesh];
    report->entry = instance->entry;
    report->file = file->mesh_entries[report->entry].file;
    report->mesh = hd_mesh_of(scene, number);
    report->contents = contents;
    report->is_covered = instance->has_material;
    if (contents->is_used == NULL && !find_contents(contents, scene, report->mesh))
        return false;
    hd_instance_box(scene, number, &report->lower, &report->upper);
    if (report->has_camera)
        report->sight = hd_instance_sight(scene, number, &report->camera);
    return true;
}

/* Starts a report, which make_report completes for each mesh. */
static Report start_report(const HdScene *scene, int frame) {
    Report report = {.frame = frame};
    HdError ignored;
    report.has_camera = hd_camera_at(&report.camera, scene, frame, &ignored) == HD_OK;
    return report;
}

static Contents *open_contents(const HdSceneFile *file) {
    return calloc((size_t)file->scene.mesh_count + 1, sizeof(Contents));
}

static void close_contents(const HdSceneFile *file, Contents *of_meshes) {
    for (int i = 0; of_meshes != NULL && i < file->scene.mesh_count; i++)
        free(of_meshes[i].is_used);
    free(of_meshes);
}

/* Writes "2 materials (red, green)". */
static void describe_materials(const Report *report, char out[512]) {
    const int count = report->contents->material_count;
    char name[96];
    int named = 0;
    snprintf(out, 512, "%d material%s (", count, hd_plural(count));
    for (int i = 0; i < report->mesh->material_count && named < MOST_NAMES; i++) {
        if (!report->contents->is_used[i])
            continue;
        hd_escape(report->mesh->materials[i].name, name, sizeof name);
        hd_add_text(out, 512, named > 0 ? ", " : "", "%s", name);
        named++;
    }
    if (count > named)
        hd_add_text(out, 512, "", " and %d more", count - named);
    hd_add_text(out, 512, "", ")%s", report->is_covered ? ", replaced by one of the scene" : "");
}

/* Writes "[0, 0, -1]"; what is but rounding of coordinates of that size becomes 0. */
static void describe_point(HdVec3 point, double size, char out[96]) {
    const double number[3] = {point.x, point.y, point.z};
    out[0] = '\0';
    for (int i = 0; i < 3; i++)
        hd_add_text(out, 96, i == 0 ? "" : ", ", "%s%.7g", i == 0 ? "[" : "",
                    fabs(number[i]) > 1e-12 * size ? number[i] : 0.0);
    hd_add_text(out, 96, "", "]");
}

static void print_report(FILE *out, const char *prefix, const Report *report) {
    static const char *const sights[] = {"out of", "partly in", "wholly in"};
    const double size = fmax(hd_largest(report->lower), hd_largest(report->upper));
    char materials[512], file[HD_MAX_PATH], lower[96], upper[96];
    describe_materials(report, materials);
    describe_point(report->lower, size, lower);
    describe_point(report->upper, size, upper);
    hd_escape(report->file, file, sizeof file);
    fprintf(
        out,
        "%smeshes[%d], %s: %d triangle%s from %s to %s, %s, %d texture%s; %s view in frame %d\n",
        prefix, report->entry, file, report->mesh->triangle_count,
        hd_plural(report->mesh->triangle_count), lower, upper, materials,
        report->contents->texture_count, hd_plural(report->contents->texture_count),
        sights[report->sight], report->frame);
}

void hd_mesh_report_print(FILE *out, const char *prefix, const HdSceneFile *file, int frame) {
    const HdScene *scene = &file->scene;
    Contents *of_meshes = open_contents(file);
    Report report = start_report(scene, frame);
    int count = 0;
    for (int i = 0; of_meshes != NULL && i < scene->instance_count; i++) {
        if (scene->instances[i].entry < 0 || count++ >= MOST_LINES)
            continue;
        if (make_report(&report, file, i, of_meshes))
            print_report(out, prefix, &report);
    }
    close_contents(file, of_meshes);
    if (count > MOST_LINES)
        fprintf(out, "%s%d more meshes are not listed\n", prefix, count - MOST_LINES);
}

/* Names of used materials. */
static json_t *list_names(const Report *report) {
    json_t *names = json_array();
    for (int i = 0; i < report->mesh->material_count; i++)
        if (report->contents->is_used[i])
            names = hd_json_append(names, hd_json_device_text(report->mesh->materials[i].name));
    return names;
}

static json_t *describe(const Report *report) {
    static const char *const sights[] = {"none", "part", "whole"};
    const HdVec3 lower = report->lower, upper = report->upper;
    return json_pack("{s:o, s:i, s:[f, f, f], s:[f, f, f], s:o, s:b, s:i, s:s}", "file",
                     hd_json_device_text(report->file), "triangles", report->mesh->triangle_count,
                     "lower", lower.x, lower.y, lower.z, "upper", upper.x, upper.y, upper.z,
                     "materials", list_names(report), "replaced", report->is_covered, "textures",
                     report->contents->texture_count, "view", sights[report->sight]);
}

json_t *hd_mesh_report_json(const HdSceneFile *file, int frame) {
    Contents *of_meshes = open_contents(file);
    json_t *list = of_meshes != NULL ? json_array() : NULL;
    Report report = start_report(&file->scene, frame);
    for (int i = 0; list != NULL && i < file->scene.instance_count; i++) {
        if (file->scene.instances[i].entry < 0)
            continue;
        const bool is_made = make_report(&report, file, i, of_meshes);
        list = hd_json_append(list, is_made ? describe(&report) : NULL);
    }
    close_contents(file, of_meshes);
    return list;
}
