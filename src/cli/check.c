/* SPDX-License-Identifier: MIT */
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "cli/commands.h"
#include "cli/load_scene.h"
#include "input/json/json_device_text.h"
#include "input/write.h"

static void print_meshes(const HdScene *scene) {
    if (scene->mesh_count > 0)
        printf("%d mesh%s of %" PRId64 " triangles in %d place%s, ", scene->mesh_count,
               scene->mesh_count == 1 ? "" : "es", hd_scene_triangle_count(scene),
               scene->instance_count, hd_plural(scene->instance_count));
}

/* The lines of a text, each without what it is indented by. */
static json_t *list_lines(const char *text) {
    char line[sizeof((HdError *)NULL)->message];
    json_t *list = json_array();
    while (*text != '\0') {
        text += strspn(text, " \n");
        const size_t length = strcspn(text, "\n");
        snprintf(line, sizeof line, "%.*s", (int)length, text);
        if (length > 0 && json_array_append_new(list, hd_json_device_text(line)) != 0) {
            json_decref(list);
            return NULL;
        }
        text += length;
    }
    return list;
}

/* A message is "NAME: what is wrong", or "NAME: 3 problems" and a line for each. */
static json_t *list_problems(const char *message, const char *name) {
    const char *several = strchr(message, '\n');
    if (several == NULL && strncmp(message, name, strlen(name)) == 0)
        message += strlen(name) + strspn(message + strlen(name), ": ");
    return list_lines(several != NULL ? several : message);
}

/* NULL where there is no memory. */
static json_t *describe_scene(const char *name, HdStatus status, const HdProblems *notes,
                              const HdScene *scene, const HdError *error) {
    json_t *problems = status == HD_OK ? json_array() : list_problems(error->message, name);
    json_t *told =
        json_pack("{s:o, s:b, s:o, s:o}", "scene", hd_json_device_text(name), "fine",
                  status == HD_OK, "problems", problems, "notes", list_lines(notes->text));
    if (status != HD_OK || told == NULL)
        return told;
    json_t *counts =
        json_pack("{s:i, s:i, s:I, s:i, s:i}", "solids", scene->solid_count, "meshes",
                  scene->instance_count, "triangles", (json_int_t)hd_scene_triangle_count(scene),
                  "lights", hd_scene_light_count(scene), "frames", scene->frame_count);
    json_object_update_new(told, counts);
    return told;
}

static void print_fine(const char *name, const HdScene *scene, const HdProblems *notes) {
    int lights = hd_scene_light_count(scene);
    printf("%s: fine, %d solid%s, ", name, scene->solid_count, hd_plural(scene->solid_count));
    print_meshes(scene);
    printf("%d light%s, %d frame%s\n", lights, hd_plural(lights), scene->frame_count,
           hd_plural(scene->frame_count));
    hd_problems_print(notes, stdout, name, ": note: ");
}

/* Prints what it finds, or appends it to `list`. */
static HdStatus check_scene(const char *operand, json_t *list, HdError *error) {
    HdProblems notes = {.count = 0};
    const HdSceneSource source = {.loads_files = true, .notes = &notes, .file_notes = &notes};
    const char *name = hd_operand_name(operand);
    HdSceneFile file;
    HdStatus status = hd_read_scene_file(&file, operand, &source, error);
    if (list != NULL)
        json_array_append_new(list, describe_scene(name, status, &notes, &file.scene, error));
    else if (status == HD_OK)
        print_fine(name, &file.scene, &notes);
    if (status == HD_OK)
        hd_scene_file_free(&file);
    return status;
}

static HdStatus print_list(json_t *list, int scenes, HdError *error) {
    const bool is_whole = json_array_size(list) == (size_t)scenes;
    if (!is_whole)
        json_decref(list);
    return hd_json_print(is_whole ? json_pack("{s:o}", "scenes", list) : NULL,
                         "what is told of the scenes", error);
}

/* Of several scenes each has its message; the last one, which the program prints, counts them. */
static HdStatus check_scenes(const HdOptions *options, json_t *list, HdError *error) {
    HdStatus worst = HD_OK;
    int wrong = 0;
    for (int i = 0; i < options->operand_count; i++) {
        HdStatus status = check_scene(options->operands[i], list, error);
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
    json_t *list = options->json ? json_array() : NULL;
    const HdStatus status = check_scenes(options, list, error);
    if (!options->json)
        return status;
    const HdStatus printed = print_list(list, options->operand_count, &unprinted);
    if (printed == HD_OK)
        return status;
    *error = unprinted;
    return printed;
}
