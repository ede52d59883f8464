/* SPDX-License-Identifier: MIT */
/* Runs the commands about scene files: check, convert. */
#define _POSIX_C_SOURCE 200809L
#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/text.h"
#include "cli/mesh_report.h"
#include "cli/options.h"
#include "image/picture.h"
#include "input/files.h"
#include "input/json.h"
#include "input/write.h"
#include "run/darkness.h"
#include "run/load_scene.h"
#include "system/atomic_file.h"

/* ---- check ---- */

/* Lists the lines of a text without their indentation. */
static json_t *list_lines(const char *text) {
    char line[sizeof((HdError *)NULL)->message];
    json_t *list = json_array();
    while (*text != '\0') {
        text += strspn(text, " \n");
        const size_t length = strcspn(text, "\n");
        snprintf(line, sizeof line, "%.*s", (int)length, text);
        if (length > 0)
            list = hd_json_append(list, hd_json_device_text(line));
        text += length;
    }
    return list;
}

/* Parses a message of the form "NAME: what is wrong", or "NAME: 3 problems" and a line for each. */
static json_t *list_problems(const char *message, const char *name) {
    const char *several = strchr(message, '\n');
    if (several != NULL)
        message = several;
    else if (strncmp(message, name, strlen(name)) == 0)
        message += strlen(name) + strspn(message + strlen(name), ": ");
    return list_lines(message);
}

/* Returns NULL if out of memory. */
static json_t *describe_scene(const char *name, HdStatus status, const HdProblems *notes,
                              const HdSceneFile *file, const HdError *error) {
    const HdScene *scene = &file->scene;
    json_t *problems = status == HD_OK ? json_array() : list_problems(error->message, name);
    json_t *described =
        json_pack("{s:o, s:b, s:o, s:o}", "scene", hd_json_device_text(name), "fine",
                  status == HD_OK, "problems", problems, "notes", list_lines(notes->text));
    if (status != HD_OK || described == NULL)
        return described;
    json_t *counts =
        json_pack("{s:i, s:i, s:I, s:o, s:i, s:i}", "solids", scene->solid_count, "meshes",
                  scene->instance_count, "triangles", (json_int_t)hd_scene_triangle_count(scene),
                  "places", hd_mesh_report_json(file, 0), "lights", hd_scene_light_count(scene),
                  "frames", scene->frame_count);
    json_object_update_new(described, counts);
    return described;
}

static void print_fine(const char *name, const HdSceneFile *file, const HdProblems *notes) {
    const HdScene *scene = &file->scene;
    const int lights = hd_scene_light_count(scene);
    char prefix[HD_MAX_PATH + 2];
    printf("%s: fine, %d solid%s, ", name, scene->solid_count, hd_plural(scene->solid_count));
    if (scene->mesh_count > 0)
        printf("%d mesh%s of %" PRId64 " triangles in %d place%s, ", scene->mesh_count,
               scene->mesh_count == 1 ? "" : "es", hd_scene_triangle_count(scene),
               scene->instance_count, hd_plural(scene->instance_count));
    printf("%d light%s, %d frame%s\n", lights, hd_plural(lights), scene->frame_count,
           hd_plural(scene->frame_count));
    snprintf(prefix, sizeof prefix, "%s: ", name);
    hd_mesh_report_print(stdout, prefix, file, 0);
    hd_problems_print(notes, stdout, name, ": note: ");
}

/* Prints the result, or appends it to the list, if given. */
static HdStatus check_scene(const char *operand, const HdScenePlan *plan, json_t **list,
                            HdError *error) {
    HdProblems notes = {.count = 0};
    const HdSceneSource source = {.folder = "",
                                  .changes = plan->changes,
                                  .change_count = plan->change_count,
                                  .is_strict = plan->strict_files,
                                  .loads_files = true,
                                  .notes = &notes,
                                  .file_notes = &notes};
    const char *name = hd_scene_name(operand);
    HdSceneFile file;
    HdStatus status = hd_read_scene(&file, operand, &source, error);
    if (status == HD_OK)
        hd_note_darkness(&file.scene, file.output.style.picture.curve, 0, &notes);
    if (list != NULL)
        *list = hd_json_append(*list, describe_scene(name, status, &notes, &file, error));
    else if (status == HD_OK)
        print_fine(name, &file, &notes);
    if (status == HD_OK)
        hd_scene_file_free(&file);
    return status;
}

/* Each scene has its own message; the last one, which the program prints, counts them. */
static HdStatus check_scenes(const HdOptions *options, json_t **list, HdError *error) {
    HdStatus worst = HD_OK;
    int wrong = 0;
    for (int i = 0; i < options->operand_count; i++) {
        HdStatus status = check_scene(options->operands[i], &options->scene, list, error);
        if (status == HD_OK)
            continue;
        wrong++;
        worst = worst == HD_BAD_INPUT ? worst : status;
        if (options->operand_count == 1)
            return status;
        fflush(stdout);
        if (list == NULL)
            fprintf(stderr, "hedron: %s\n", error->message);
    }
    if (wrong == 0)
        return HD_OK;
    fflush(stdout);
    return hd_fail(error, worst, "%d of %d scenes %s wrong", wrong, options->operand_count,
                   wrong == 1 ? "is" : "are");
}

HdStatus hd_command_check(const HdOptions *options, HdError *error) {
    static HdError unprinted;
    if (options->schema)
        return hd_scene_schema_print(stdout, error);
    if (!options->json)
        return check_scenes(options, NULL, error);
    json_t *list = json_array();
    const HdStatus status = check_scenes(options, &list, error);
    const HdStatus printed =
        hd_json_print(json_pack("{s:o}", "scenes", list), "the report on the scenes", &unprinted);
    if (printed != HD_OK)
        *error = unprinted;
    return printed == HD_OK ? status : printed;
}

/* ---- convert ---- */

/* A scene's texture is relative to the scene's folder, that of a classic input to the current one.
   If the two differ, the name gets the current folder as a prefix. */
static HdStatus keep_texture(HdSceneFile *file, const char *output, HdError *error) {
    char folder[HD_MAX_PATH], name[HD_MAX_PATH];
    memcpy(name, file->texture_path, sizeof name);
    if (output == NULL || strchr(output, '/') == NULL || !hd_texture_path_is_relative(name))
        return HD_OK;
    if (getcwd(folder, sizeof folder) == NULL)
        return hd_fail(error, HD_FAILED, "cannot determine the current folder: %s",
                       strerror(errno));
    if (snprintf(file->texture_path, sizeof file->texture_path, "%s/%s", folder, name) >=
        (int)sizeof file->texture_path)
        return hd_fail(error, HD_BAD_INPUT, "the path of the texture %s is too long", name);
    return HD_OK;
}

/* The classic mode writes any other name in the data format; a scene selects it by the ending. */
static HdStatus keep_output(HdSceneFile *file, HdError *error) {
    static const char ending[] = ".data";
    char *path = file->output.path;
    const HdFormat *format = hd_format_of(path);
    if (format != NULL && !hd_format_is_film(format))
        return HD_OK;
    if (strlen(path) + sizeof ending > HD_MAX_PATH)
        return hd_fail(error, HD_BAD_INPUT, "the output path has %zu bytes, too many for %s",
                       strlen(path), ending);
    memcpy(path + strlen(path), ending, sizeof ending);
    return HD_OK;
}

static HdStatus write_scene(const HdSceneFile *file, const char *name, HdError *error) {
    char path[HD_MAX_PATH];
    HdAtomicFile out;
    HD_TRY(hd_path_expand_home(name, path, error));
    HD_TRY(hd_atomic_file_open(&out, path, error));
    const HdStatus status = hd_scene_file_print(out.stream, file, error);
    if (status == HD_OK)
        return hd_atomic_file_commit(&out, HD_DURABLE, error);
    hd_atomic_file_discard(&out);
    return status;
}

HdStatus hd_command_convert(const HdOptions *options, HdError *error) {
    const char *input = options->operand_count > 0 ? options->operands[0] : "-";
    const char *output = options->store.count > 0 ? options->store.names[0] : NULL;
    HdSceneFile file;
    HD_TRY(hd_read_classic(&file, input, options->scene.variant, error));
    HdStatus status = keep_texture(&file, output, error);
    if (status == HD_OK)
        status = keep_output(&file, error);
    if (status == HD_OK)
        status = output != NULL ? write_scene(&file, output, error)
                                : hd_scene_file_print(stdout, &file, error);
    hd_scene_file_free(&file);
    return status;
}
