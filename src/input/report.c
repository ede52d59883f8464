/* SPDX-License-Identifier: MIT */
#include "input/report.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "input/changes.h"
#include "input/json/words.h"
#include "input/synonyms.h"

/* The longest word, with room. */
enum { HD_CHOICE_SIZE = 32 };

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

void hd_report_mistaken(HdSceneReport *report, const json_t *value, const char *meant) {
    char words[HD_WORDS_SIZE], quoted[HD_WORDS_SIZE];
    hd_json_words(value, words);
    hd_quoted(meant, quoted);
    hd_report(report, "is %s; did you mean %s?", words, quoted);
}

void hd_report_choice(HdSceneReport *report, const HdField *field, const json_t *value) {
    char words[16][HD_CHOICE_SIZE];
    HdNearest nearest = {.word = json_is_string(value) ? json_string_value(value) : ""};
    for (int i = 0; i < 16 && field->choices[i].json != NULL; i++) {
        const char *json = field->choices[i].json;
        if (json[0] != '"')
            continue;
        snprintf(words[i], sizeof words[i], "%.*s", (int)strlen(json) - 2, json + 1);
        hd_synonym_offer(&nearest, words[i]);
    }
    if (nearest.name != NULL)
        hd_report_mistaken(report, value, nearest.name);
    else
        hd_report_field(report, field, value, false);
}

static void offer_keys(HdNearest *nearest, const HdObjectType *type) {
    for (int i = 0; i < type->field_count; i++)
        hd_synonym_offer(nearest, type->fields[i].key);
}

/* At the top people also write what belongs into one of the objects there. */
static bool find_in_part(const HdObjectType *type, const char *key, char path[64]) {
    for (int i = 0; i < type->field_count; i++) {
        const HdField *part = &type->fields[i];
        HdNearest nearest = {.word = key};
        if (part->type != HD_FIELD_OBJECT || part->is_given != NULL)
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

void hd_report_unknown_keys(HdSceneReport *report, const HdObjectType *type, const json_t *json) {
    const char *key;
    json_t *value;
    json_object_foreach((json_t *)json, key, value) {
        if (hd_field(type, key) != NULL)
            continue;
        if (hd_problems_are_full(report->problems))
            report->problems->count++;
        else
            report_unknown_key(report, type, key);
    }
}
