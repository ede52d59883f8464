/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L

#include "input/report.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/text.h"
#include "input/changes.h"

static bool begins_with(const char *text, const char *beginning) {
    return strncmp(text, beginning, strlen(beginning)) == 0;
}

static void note_place(HdSceneReport *report) {
    const char *path = report->path;
    if (strcmp(path, "camera") == 0 || begins_with(path, "camera.eye") ||
        begins_with(path, "camera.target"))
        report->checker->is_view_wrong = true;
    if (begins_with(path, "floor"))
        report->checker->is_floor_wrong = true;
    if (begins_with(path, "solids[")) {
        const unsigned long index = strtoul(path + strlen("solids["), NULL, 10);
        if (index < HD_MAX_SOLIDS)
            report->checker->is_solid_wrong[index] = report->checker->is_any_solid_wrong = true;
    }
}

void hd_report(HdSceneReport *report, const char *format, ...) {
    const HdSceneSource *source = report->source;
    char name[256] = "", text[1024];
    va_list arguments;
    note_place(report);
    if (hd_problems_are_full(report->problems)) {
        report->problems->count++;
        return;
    }
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    for (int i = 0; i < source->change_count; i++)
        if (hd_scene_change_made(source->changes[i], report->path))
            hd_scene_change_name(source->changes[i], name);
    const char *path = report->path[0] != '\0' ? report->path : "the scene";
    hd_problem(report->problems, "%s%s %s", name, path, text);
}

void hd_report_value(HdSceneReport *report, const json_t *value, const char *expected) {
    char words[HD_WORDS_SIZE];
    hd_json_words(value, words);
    hd_report(report, "is %s, expected %s", words, expected);
}

void hd_report_field(HdSceneReport *report, const HdField *field, const json_t *value, int parts) {
    char expected[HD_EXPECTED_SIZE];
    hd_field_expected(field, parts, expected);
    hd_report_value(report, value, expected);
}

static void list_keys(const HdObjectType *type, char out[HD_EXPECTED_SIZE * 2]) {
    size_t used = 0;
    for (int i = 0; i < type->field_count; i++) {
        const char *between = i == 0 ? "" : i + 1 < type->field_count ? ", " : " or ";
        used += (size_t)snprintf(out + used, HD_EXPECTED_SIZE * 2 - used, "%s\"%s\"", between,
                                 type->fields[i].key);
    }
}

void hd_report_mistaken(HdSceneReport *report, const json_t *value, const char *meant) {
    char words[HD_WORDS_SIZE], quoted[HD_WORDS_SIZE];
    hd_json_words(value, words);
    hd_quoted(meant, quoted);
    hd_report(report, "is %s; did you mean %s?", words, quoted);
}

/* What other programs call the things of a scene. A word may mean something else in each place;
 * only one of its names is there. */
static const struct Synonym {
    const char *word, *name;
} synonyms[] = {
    {"fov", "field_of_view"},
    {"position", "eye"},
    {"position", "centre"},
    {"centre", "position"},
    {"center", "position"},
    {"translation", "position"},
    {"translate", "position"},
    {"instances", "meshes"},
    {"models", "meshes"},
    {"objects", "meshes"},
    {"obj", "file"},
    {"model", "file"},
    {"mesh", "file"},
    {"shading", "normals"},
    {"smooth", "normals"},
    {"angle", "crease"},
    {"look_at", "target"},
    {"lookat", "target"},
    {"center", "centre"},
    {"color", "colour"},
    {"colors", "colours"},
    {"ior", "index_of_refraction"},
    {"refraction", "index_of_refraction"},
    {"transparency", "transmission"},
    {"opacity", "transmission"},
    {"emission", "ambient"},
    {"radius", "circumradius"},
    {"radius", "disc_radius"},
    {"size", "circumradius"},
    {"size", "scale"},
    {"type", "kind"},
    {"shape", "kind"},
    {"count", "per_edge"},
    {"lights", "per_edge"},
    {"fps", "frames_per_second"},
    {"gamma", "curve"},
    {"file", "path"},
    {"path", "file"},
    {"hexahedron", "cube"},
};

static bool means(const char *word, const char *name) {
    for (size_t i = 0; i < sizeof synonyms / sizeof synonyms[0]; i++)
        if (strcasecmp(synonyms[i].word, word) == 0 && strcmp(synonyms[i].name, name) == 0)
            return true;
    return strcasecmp(word, name) == 0;
}

/* hd_nearest_offer, but a name that means the word, or is the word but for upper and lower case, is
   nearer than any other. */
static void offer_meant(HdNearest *nearest, const char *name) {
    if (!means(nearest->word, name)) {
        hd_nearest_offer(nearest, name);
        return;
    }
    nearest->name = name;
    nearest->distance = -1;
}

void hd_report_choice(HdSceneReport *report, const HdField *field, const json_t *value) {
    HdNearest nearest = {.word = json_is_string(value) ? json_string_value(value) : ""};
    for (const HdChoice *choice = field->choices; choice->word != NULL; choice++)
        if (!hd_choice_is_number(choice->word))
            offer_meant(&nearest, choice->word);
    if (nearest.name != NULL)
        hd_report_mistaken(report, value, nearest.name);
    else
        hd_report_field(report, field, value, 0);
}

static void offer_keys(HdNearest *nearest, const HdObjectType *type) {
    for (int i = 0; i < type->field_count; i++)
        offer_meant(nearest, type->fields[i].key);
}

/* At the top people also write what belongs into one of the objects there. */
static bool find_in_part(const HdObjectType *type, const char *key, char path[64]) {
    for (int i = 0; i < type->field_count; i++) {
        const HdField *part = &type->fields[i];
        HdNearest nearest = {.word = key};
        if (part->type != HD_FIELD_OBJECT || hd_field_may_be_absent(part))
            continue;
        offer_keys(&nearest, part->object);
        if (nearest.name == NULL || nearest.distance > 0)
            continue;
        snprintf(path, 64, "%s.%s", part->key, nearest.name);
        return true;
    }
    return false;
}

static void report_unknown_key(HdSceneReport *report, const HdObjectType *type, const char *key) {
    char keys[HD_EXPECTED_SIZE * 2], path[64];
    HdNearest nearest = {.word = key};
    offer_keys(&nearest, type);
    if (nearest.name == NULL && type == &hd_scene_fields && find_in_part(type, key, path))
        nearest.name = path;
    const size_t length = hd_json_path_key(report->path, key);
    if (nearest.name != NULL) {
        hd_report(report, "is an unknown key; did you mean \"%s\"?", nearest.name);
    } else {
        list_keys(type, keys);
        hd_report(report, "is an unknown key, expected %s", keys);
    }
    report->path[length] = '\0';
}

static void report_comment(HdSceneReport *report, const json_t *value) {
    const size_t length = hd_json_path_key(report->path, HD_COMMENT_KEY);
    hd_report_value(report, value, "a string");
    report->path[length] = '\0';
}

void hd_report_unknown_keys(HdSceneReport *report, const HdObjectType *type, const json_t *json) {
    const char *key;
    json_t *value;
    json_object_foreach((json_t *)json, key, value) {
        const bool is_comment = strcmp(key, HD_COMMENT_KEY) == 0;
        if (hd_field(type, key) != NULL || (is_comment && json_is_string(value)))
            continue;
        if (is_comment)
            report_comment(report, value);
        else if (hd_problems_are_full(report->problems))
            report->problems->count++;
        else
            report_unknown_key(report, type, key);
    }
}
