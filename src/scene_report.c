/* SPDX-License-Identifier: MIT */
#include "scene_report.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "json_words.h"
#include "nearest_name.h"
#include "scene_changes.h"

static bool begins_with(const char *text, const char *beginning) {
    return strncmp(text, beginning, strlen(beginning)) == 0;
}

static void note_place(HdSceneReport *report) {
    const char *path = report->path;
    if (strcmp(path, "camera") == 0 || begins_with(path, "camera.eye") ||
        begins_with(path, "camera.target"))
        report->is_view_wrong = true;
    if (begins_with(path, "floor"))
        report->is_floor_wrong = true;
    if (begins_with(path, "solids[")) {
        const unsigned long index = strtoul(path + strlen("solids["), NULL, 10);
        if (index < HD_MAX_SOLIDS)
            report->is_solid_wrong[index] = true;
    }
}

void hd_report(HdSceneReport *report, const char *format, ...) {
    const HdSceneSource *source = report->source;
    char name[256] = "", text[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    note_place(report);
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

void hd_report_field(HdSceneReport *report, const HdField *field, const json_t *value,
                     bool is_part) {
    char expected[HD_EXPECTED_SIZE];
    hd_field_expected(field, is_part, expected);
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

void hd_report_unknown_keys(HdSceneReport *report, const HdObjectType *type, const json_t *json) {
    const char *key;
    json_t *value;
    json_object_foreach((json_t *)json, key, value) {
        if (hd_field(type, key) != NULL)
            continue;
        HdNearest nearest = {.word = key};
        for (int i = 0; i < type->field_count; i++)
            hd_nearest_offer(&nearest, type->fields[i].key);
        char keys[HD_EXPECTED_SIZE * 2];
        snprintf(keys, sizeof keys, "\"%s\"", nearest.name != NULL ? nearest.name : "");
        if (nearest.name == NULL)
            list_keys(type, keys);
        const size_t length = hd_json_path_key(report->path, key);
        hd_report(report, "is an unknown key, expected %s", keys);
        report->path[length] = '\0';
    }
}
