/* SPDX-License-Identifier: MIT */
#include "input/load.h"

#include <jansson.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "input/builtin.h"
#include "input/changes.h"
#include "input/classic.h"
#include "input/json/text.h"
#include "input/meshes.h"
#include "input/notes.h"
#include "input/read.h"
#include "system/path.h"

static HdStatus fail_syntax(const json_error_t *found, const char *text_read, size_t size,
                            const char *name, HdError *error) {
    char text[JSON_ERROR_TEXT_LENGTH * 2];
    hd_escape(found->text, text, sizeof text);
    const size_t used = strlen(text);
    if (json_error_code(found) == json_error_out_of_memory)
        return hd_fail(error, HD_FAILED, "%s: out of memory: no room for the scene", name);
    if (json_error_code(found) == json_error_null_character)
        snprintf(text, sizeof text, "a string has the character \\u0000, expected text without it");
    if (json_error_code(found) == json_error_numeric_overflow)
        snprintf(text + used, sizeof text - used, ", expected a number that a double can hold");
    const bool is_inside = found->position >= 0 && (size_t)found->position <= size;
    const char *hint = is_inside ? hd_json_hint(text_read, (size_t)found->position) : NULL;
    return hd_fail(error, HD_BAD_INPUT, "%s:%d:%d: %s%s%s", name, found->line, found->column, text,
                   hint != NULL ? "; " : "", hint != NULL ? hint : "");
}

static bool is_mesh(const char *name) {
    static const char *const endings[] = {".obj", ".stl", ".ply", ".gltf", ".glb"};
    for (size_t i = 0; i < sizeof endings / sizeof endings[0]; i++)
        if (hd_path_has_ending(name, endings[i]))
            return true;
    return false;
}

/* Messages quote what they are about, which of a file that is no scene is nobody's business. */
static bool may_be_scene(const char *text, size_t size, const char *name) {
    size_t start = 0;
    while (start < size && strchr(" \t\r\n", text[start]) != NULL)
        start++;
    return hd_path_has_ending(name, ".json") || start == size || text[start] == '{';
}

static HdStatus check_text(const char *text, size_t size, const char *name, HdError *error) {
    if (size > HD_MAX_SCENE_BYTES)
        return hd_fail(error, HD_BAD_INPUT, "%s has %zu bytes, expected at most %d", name, size,
                       (int)HD_MAX_SCENE_BYTES);
    if (is_mesh(name))
        return hd_fail(error, HD_BAD_INPUT,
                       "%s is no scene by its name: a mesh, as Wavefront OBJ, is part of one; see "
                       "\"meshes\" in 'hedron help scene'",
                       name);
    if (size == 0)
        return hd_fail(error, HD_BAD_INPUT, "%s is empty, expected a scene in JSON", name);
    /* JSON text has no zero bytes, and the parser takes one for the end of a token. */
    const char *zero = memchr(text, 0, size);
    if (zero != NULL)
        return hd_json_fail_at(text, (size_t)(zero - text), name,
                               "there is a zero byte, expected JSON text", error);
    if (hd_classic_may_be(text, size))
        return hd_fail(error, HD_BAD_INPUT,
                       "%s: this looks like a classic input, which 'hedron convert FILE -o "
                       "scene.json' makes a scene of",
                       name);
    if (!may_be_scene(text, size, name))
        return hd_fail(error, HD_BAD_INPUT,
                       "%s is no scene: neither has it the ending .json nor does it begin with {",
                       name);
    return hd_json_check_limits(text, size, name, error);
}

static HdStatus parse_json(json_t **root, const char *text, size_t size, const char *name,
                           HdError *error) {
    static const char mark[] = "\xef\xbb\xbf"; /* the byte order mark of UTF-8 */
    json_error_t found;
    if (size >= strlen(mark) && memcmp(text, mark, strlen(mark)) == 0) {
        text += strlen(mark);
        size -= strlen(mark);
    }
    HdStatus status = check_text(text, size, name, error);
    if (status != HD_OK)
        return status;
    *root = json_loadb(text, size, HD_JSON_FLAGS, &found);
    return *root != NULL ? HD_OK : fail_syntax(&found, text, size, name, error);
}

/* Only memory and a signal are failures of their own here. */
static HdStatus load_files(HdSceneFile *file, const HdSceneSource *source, HdProblems *problems,
                           HdError *error) {
    HdStatus status = hd_scene_file_load_texture(file, error);
    if (status == HD_BAD_INPUT)
        hd_problem(problems, "floor.texture.file: %s", error->message);
    else if (status != HD_OK)
        return status;
    return hd_scene_file_load_meshes(file, problems, source->file_notes, error);
}

static HdStatus build(HdSceneFile *file, json_t *root, const HdSceneSource *source,
                      HdError *error) {
    HdProblems problems = {.count = 0};
    for (int i = 0; i < source->change_count; i++)
        hd_scene_change_apply(root, source->changes[i], &problems);
    HdStatus status = hd_scene_from_json(file, root, source, &problems, error);
    if (status == HD_OK && source->loads_files)
        status = load_files(file, source, &problems, error);
    if (status == HD_OK && source->notes != NULL)
        hd_scene_check_output(file, &problems);
    if (status == HD_OK)
        status = hd_problems_status(&problems, source->name, error);
    if (status == HD_OK && source->notes != NULL)
        hd_scene_notes(file, source->notes);
    return status;
}

HdStatus hd_scene_file_parse(HdSceneFile *file, const char *text, size_t size,
                             const HdSceneSource *source, HdError *error) {
    json_t *root = NULL;
    *file = (HdSceneFile){.schema = ""};
    hd_json_memory_watch();
    HdStatus status = parse_json(&root, text, size, source->name, error);
    if (status == HD_OK)
        status = build(file, root, source, error);
    json_decref(root);
    if (status == HD_BAD_INPUT && hd_json_memory_failed())
        status =
            hd_fail(error, HD_FAILED, "%s: out of memory: no room for the scene", source->name);
    if (status != HD_OK)
        hd_scene_file_free(file);
    return status;
}

HdStatus hd_scene_file_read(HdSceneFile *file, const char *path, const HdSceneSource *source,
                            HdError *error) {
    char folder[HD_MAX_PATH] = "";
    unsigned char *bytes = NULL;
    size_t size = 0;
    HdSceneSource placed = *source;
    *file = (HdSceneFile){.schema = ""};
    const char *slash = strrchr(path, '/');
    HdStatus status = hd_file_read(path, "scene", HD_MAX_SCENE_BYTES, &bytes, &size, error);
    if (status == HD_OK && slash != NULL)
        snprintf(folder, sizeof folder, "%.*s", (int)(slash - path) + 1, path);
    placed.name = path;
    placed.folder = folder;
    if (status == HD_OK)
        status = hd_scene_file_parse(file, (const char *)bytes, size, &placed, error);
    free(bytes);
    return status;
}
