/* SPDX-License-Identifier: MIT */
/* Runs the command that writes a scene to start from. */
#define _POSIX_C_SOURCE 200809L
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/trigonometry.h"
#include "cli/options.h"
#include "input/files.h"
#include "input/json.h"
#include "scene/placement.h"

/* ---- a mesh ---- */

/* Length of the mesh in the scene; what suits that are the numbers of mesh_format too. */
static const double mesh_size = 2.0;

/* Horizontal field of view and angle of the eye about the z axis, in degrees and radians; share of
   the picture that the mesh takes. */
static const double field_of_view = 30.0, eye_angle = -1.05, filled = 0.88;

/* Slopes of the view of what is tall and what is flat, and the height from which on, as a share of
   its length, a mesh counts as tall. */
static const double tall_slope = 0.22, flat_slope = 0.6, least_tall = 0.25;

enum { WIDTH = 960, HEIGHT = 640 };

/* The size of picture, the field of view, the eye's radius, height and angle, the target's height,
   the file, up, size, normals, and the position of a light. */
static const char mesh_format[] =
    "{\n"
    "  \"$comment\": \"See 'hedron help scene'. z points up; lengths are in world units.\",\n"
    "  \"hedron\": 1,\n"
    "  \"image\": {\"width\": %d, \"height\": %d, \"samples\": 4, \"depth\": 8},\n"
    "  \"camera\": {\n"
    "    \"$comment\": \"All of the mesh is in view. More frames turn around it, for a film.\",\n"
    "    \"field_of_view\": %.6g,\n"
    "    \"frames\": 1,\n"
    "    \"eye\": {\"r0\": %.6g, \"z0\": %.6g, \"phi0\": %.6g, \"phi_frequency\": 1},\n"
    "    \"target\": [0, 0, %.6g]\n"
    "  },\n"
    "  \"background\": [0.25, 0.26, 0.28],\n"
    "  \"materials\": {\n"
    "    \"floor\": {\n"
    "      \"$comment\": \"ambient times colour is background, so the floor has no visible "
    "end.\",\n"
    "      \"colour\": [0.5, 0.52, 0.56], \"ambient\": 0.5, \"diffuse\": 0.3\n"
    "    }\n"
    "  },\n"
    "  \"meshes\": [\n"
    "    {\n"
    "      \"$comment\": \"Its longest side becomes size, and it stands on position.\",\n"
    "      \"file\": %s,\n"
    "      \"up\": \"%s\",\n"
    "      \"size\": %.6g,\n"
    "      \"position\": [0, 0, 0],\n"
    "      \"normals\": \"%s\"\n"
    "    }\n"
    "  ],\n"
    "  \"lights\": [\n"
    "    {\"$comment\": \"at the eye\", \"position\": [%.6g, %.6g, %.6g], \"intensity\": 0.15},\n"
    "    {\"position\": [-2, -6, 7], \"intensity\": 0.55},\n"
    "    {\"position\": [7, -4, 3], \"intensity\": 0.2},\n"
    "    {\"position\": [-5, 6, 5], \"intensity\": 0.2}\n"
    "  ],\n"
    "  \"floor\": {\n"
    "    \"$comment\": \"A little lower, so that it coincides with no face of the mesh.\",\n"
    "    \"corners\": [[-500, 500, -0.002], [500, 500, -0.002],\n"
    "                [500, -500, -0.002], [-500, -500, -0.002]],\n"
    "    \"material\": \"floor\"\n"
    "  }\n"
    "}\n";

/* Loads the mesh as it is, alone in the scene. */
static HdStatus load_mesh(HdSceneFile *file, const char *name, HdError *error) {
    static const char place[] = "meshes[0].file: "; /* there is but one */
    HdProblems problems = {.count = 0};
    *file = (HdSceneFile){.mesh_entry_count = 1, .mesh_entries = calloc(1, sizeof(HdMeshEntry))};
    HdMeshEntry *entry = file->mesh_entries;
    if (entry != NULL) {
        entry->file = strdup(name);
        entry->instance.scale = hd_vec3(1.0, 1.0, 1.0);
    }
    if (entry == NULL || entry->file == NULL) {
        file->mesh_entry_count = entry != NULL;
        return HD_NO_ROOM(error, "the mesh");
    }
    HD_TRY(hd_scene_file_load_meshes(file, &problems, NULL, error));
    if (problems.count == 0)
        return HD_OK;
    const size_t skipped = strncmp(problems.text, place, strlen(place)) == 0 ? strlen(place) : 0;
    const char *text = problems.text + skipped;
    return hd_fail(error, HD_BAD_INPUT, "%.*s", (int)strcspn(text, "\n"), text);
}

/* Guesses the axis that points up. In maps y points north and is large. */
static HdUpAxis guess_up(const HdMesh *mesh) {
    const double longest = 2.0 * hd_mesh_half_side(mesh), slack = 1e-3 * longest;
    const bool is_map = fabs(hd_mesh_centre(mesh).y) > 4.0 * longest;
    const bool is_on_z = fabs(mesh->lower.z) <= slack, is_on_y = fabs(mesh->lower.y) <= slack;
    return is_map || (is_on_z && !is_on_y) ? HD_UP_Z : HD_UP_Y;
}

/* Returns the distance from which a box is within the picture. The eye looks at the middle of the
   box, along `forward`. */
static double distance_of(HdVec3 half, HdVec3 forward) {
    const HdVec3 right = hd_normalize(hd_cross(forward, hd_vec3(0.0, 0.0, 1.0)));
    const HdVec3 up = hd_cross(right, forward);
    double sine, cosine, distance = 0.0;
    hd_sine_cosine(field_of_view * (HD_PI / 360.0), &sine, &cosine);
    const double across = filled * sine / cosine, upright = across * HEIGHT / WIDTH;
    for (int i = 0; i < 8; i++) {
        const HdVec3 corner =
            hd_vec3(i & 1 ? half.x : -half.x, i & 2 ? half.y : -half.y, i & 4 ? half.z : -half.z);
        const double aside =
            fmax(fabs(hd_dot(corner, right)) / across, fabs(hd_dot(corner, up)) / upright);
        const double needed = aside - hd_dot(corner, forward);
        if (needed > distance) /* gcc 12 for aarch64 fails on fmax here, at -O3 */
            distance = needed;
    }
    return distance;
}

/* Prints the scene around the loaded mesh. `file_text` is the mesh's name in JSON. */
static void print_around(FILE *out, HdSceneFile *file, const char *up, const char *file_text) {
    HdInstance *instance = &file->scene.instances[0];
    const HdMesh *mesh = hd_mesh_of(&file->scene, 0);
    HdVec3 lower, upper, forward = {0.0, 0.0, 0.0};
    if (up == NULL || strcmp(up, "auto") == 0)
        instance->up = guess_up(mesh);
    else
        instance->up = strcmp(up, "y") == 0 ? HD_UP_Y : HD_UP_Z;
    hd_instance_fit(instance, mesh, mesh_size);
    hd_instance_box(&file->scene, 0, &lower, &upper);
    const HdVec3 half = hd_scale(hd_sub(upper, lower), 0.5);
    const bool is_tall = half.z > least_tall * fmax(half.x, half.y);
    hd_sine_cosine(eye_angle + HD_PI, &forward.y, &forward.x);
    forward.z = is_tall ? -tall_slope : -flat_slope;
    const double distance = distance_of(half, hd_normalize(forward));
    const HdVec3 to_eye = hd_scale(hd_normalize(forward), -distance);
    const double radius = sqrt(to_eye.x * to_eye.x + to_eye.y * to_eye.y);
    const double height = half.z + to_eye.z;
    fprintf(out, mesh_format, WIDTH, HEIGHT, field_of_view, radius, height, eye_angle, half.z,
            file_text, instance->up == HD_UP_Y ? "y" : "z", mesh_size,
            mesh->normals != NULL ? "file" : "smooth", to_eye.x, to_eye.y, height);
}

/* Writes the mesh's name as a scene at `path` has it: relative to the scene's folder. If that is
   not the current one, the current one comes first. */
static HdStatus name_for(const char *path, const char *mesh, char out[HD_MAX_PATH],
                         HdError *error) {
    char folder[HD_MAX_PATH] = "";
    const char *slash = strrchr(path, '/');
    const size_t before = slash != NULL ? (size_t)(slash + 1 - path) : 0;
    const bool is_below = strncmp(path, mesh, before) == 0;
    const bool is_elsewhere = !is_below && hd_texture_path_is_relative(mesh);
    if (is_elsewhere && getcwd(folder, sizeof folder - 1) == NULL)
        return hd_fail(error, HD_FAILED, "cannot determine the current folder: %s",
                       strerror(errno));
    if (snprintf(out, HD_MAX_PATH, "%s%s%s", folder, is_elsewhere ? "/" : "",
                 is_below ? mesh + before : mesh) >= HD_MAX_PATH)
        return hd_fail(error, HD_BAD_INPUT, "the path of the mesh %s is too long", mesh);
    return HD_OK;
}

/* Makes the text of a scene that shows a mesh; the caller frees it. */
static HdStatus make_around(const HdOptions *options, const char *path, char **text, size_t *size,
                            HdError *error) {
    char name[HD_MAX_PATH];
    HdSceneFile file;
    HD_TRY(name_for(path, options->mesh, name, error));
    json_t *string = json_string(name);
    char *file_text = string != NULL ? json_dumps(string, JSON_ENCODE_ANY) : NULL;
    json_decref(string);
    if (file_text == NULL)
        return hd_fail(error, HD_BAD_INPUT,
                       "the name of the mesh %s cannot be written, expected UTF-8", options->mesh);
    HdStatus status = load_mesh(&file, options->mesh, error);
    FILE *out = status == HD_OK ? open_memstream(text, size) : NULL;
    if (out != NULL)
        print_around(out, &file, options->up, file_text);
    if (status == HD_OK && (out == NULL || fclose(out) != 0))
        status = HD_NO_ROOM(error, "the scene");
    hd_scene_file_free(&file);
    free(file_text);
    return status;
}

/* ---- the command ---- */

static HdStatus fail_existing(const char *path, HdError *error) {
    return hd_fail(error, HD_BAD_INPUT, "%s exists already, expected a new name", path);
}

/* Leaves a new and whole file, or removes it on failure. */
static HdStatus write_new(const char *path, const char *text, size_t size, HdError *error) {
    FILE *out = fopen(path, "wbx");
    if (out == NULL && errno == EEXIST)
        return fail_existing(path, error);
    if (out == NULL)
        return hd_fail(error, HD_FAILED, "cannot write %s: %s", path, strerror(errno));
    const bool is_written = fwrite(text, 1, size, out) == size && fflush(out) == 0;
    const int why = errno;
    if (fclose(out) == 0 && is_written)
        return HD_OK;
    remove(path);
    return hd_fail(error, HD_FAILED, "cannot write %s: %s", path,
                   strerror(is_written ? errno : why));
}

HdStatus hd_command_new(const HdOptions *options, HdError *error) {
    const char *name = options->operand_count > 0 ? options->operands[0] : "scene";
    const char *ending = hd_path_has_ending(name, ".json") ? "" : ".json";
    char path[HD_MAX_PATH], *made = NULL;
    size_t size;
    const char *text = hd_starter_scene_text(&size);
    if (snprintf(path, sizeof path, "%s%s", name, ending) >= (int)sizeof path)
        return hd_fail(error, HD_BAD_INPUT, "the name of the scene has %zu bytes, expected fewer",
                       strlen(name));
    if (options->mesh == NULL && options->up != NULL)
        return hd_fail(error, HD_BAD_INPUT, "--up needs --mesh");
    if (access(path, F_OK) == 0)
        return fail_existing(path, error);
    if (options->mesh != NULL) {
        HD_TRY(make_around(options, path, &made, &size, error));
        text = made;
    }
    const HdStatus status = write_new(path, text, size, error);
    free(made);
    HD_TRY(status);
    printf("%s\n", path);
    return HD_OK;
}
