/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L

#include "input/report.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/text.h"

/* Changes */

/* A step of a path: a key, or, if that is empty, an index. */
typedef struct Step {
    char key[HD_MAX_PATH];
    size_t index;
} Step;

typedef struct Walk {
    HdSceneChange change;
    const char *at;       /* rest of the path */
    const char *end;      /* its sign = */
    HdProblems *problems; /* NULL: silent */
} Walk;

/* Writes the prefix of messages about a change: "--set image.width=0: ". */
static void name_change(HdSceneChange change, char out[256]) {
    char quoted[HD_WORDS_SIZE];
    hd_quoted(change, quoted);
    const int inner = (int)strlen(quoted) - 2;
    snprintf(out, 256, "--set %.*s: ", inner, quoted + 1);
}

#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
static void
complain(const Walk *walk, const char *format, ...) {
    char name[256], text[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    name_change(walk->change, name);
    hd_problem(walk->problems, "%s%s", name, text);
}

static bool read_index(Walk *walk, Step *step) {
    const char *digits = walk->at + 1;
    const size_t count = strspn(digits, "0123456789");
    const bool has_zero_in_front = count > 1 && digits[0] == '0';
    if (count == 0 || count > 9 || has_zero_in_front || digits[count] != ']')
        return false;
    step->key[0] = '\0';
    step->index = strtoul(digits, NULL, 10);
    walk->at = digits + count + 1;
    return true;
}

/* Reads a key; one in quotes may have any character but a quote. */
static bool read_key(Walk *walk, Step *step) {
    const bool is_quoted = *walk->at == '"';
    const char *key = walk->at + is_quoted;
    const size_t length = strcspn(key, is_quoted ? "\"" : ".[=");
    if (length == 0 || length >= sizeof step->key || (is_quoted && key[length] != '"'))
        return false;
    memcpy(step->key, key, length);
    step->key[length] = '\0';
    walk->at = key + length + is_quoted;
    return true;
}

/* Returns the = that ends the path, which is not in a quoted key, or NULL. */
static const char *find_end(HdSceneChange change) {
    const char *c = change;
    while (*c != '\0' && *c != '=') {
        const bool begins_key = c == change || c[-1] == '.';
        const char *close = begins_key && *c == '"' ? strchr(c + 1, '"') : NULL;
        c = close != NULL ? close + 1 : c + 1;
    }
    return *c == '=' ? c : NULL;
}

/* Reads the next step: the first key, one after a dot, or an index. Returns false if there is none.
 */
static bool read_step(Walk *walk, Step *step) {
    const bool is_first = walk->at == walk->change;
    bool is_read = false;
    if (!is_first && *walk->at == '[')
        is_read = read_index(walk, step);
    else if (is_first || *walk->at == '.') {
        walk->at += !is_first;
        is_read = read_key(walk, step);
    }
    return is_read && walk->at <= walk->end;
}

static bool may_be_made(const Step *step, bool is_first) {
    const HdField *field = is_first ? hd_field(&hd_scene_fields, step->key) : NULL;
    return field != NULL && field->type == HD_FIELD_OBJECT && !hd_field_may_be_absent(field);
}

/* Checks that `parent`, named by the first `length` bytes, is an object for a key or an array with
   that index. */
static bool check_parent(const Walk *walk, const json_t *parent, const Step *step, int length) {
    static const char root[] = "the scene";
    char words[HD_WORDS_SIZE], expected[64] = "an object";
    const bool is_index = step->key[0] == '\0';
    if (is_index ? step->index < json_array_size(parent) : json_is_object(parent))
        return true;
    if (is_index)
        snprintf(expected, sizeof expected, "an array with an element %zu", step->index);
    hd_json_words(parent, words);
    if (!is_index && json_is_array(parent) && step->key[strspn(step->key, "0123456789")] == '\0') {
        complain(walk, "%.*s is %s; write %.*s[%s]", length, walk->change, words, length,
                 walk->change, step->key);
        return false;
    }
    complain(walk, "%.*s is %s, expected %s", length > 0 ? length : (int)sizeof root,
             length > 0 ? walk->change : root, words, expected);
    return false;
}

/* `is_named`: the keys of `parent` are names that the author chose. */
static void complain_of_missing(const Walk *walk, json_t *parent, const char *missing,
                                bool is_named) {
    const int length = (int)(walk->at - walk->change);
    char quoted[HD_WORDS_SIZE];
    HdNearest nearest = {.word = missing};
    const char *key;
    json_t *ignored;
    json_object_foreach(parent, key, ignored) {
        hd_nearest_offer(&nearest, key);
    }
    if (nearest.name == NULL) {
        char keys[HD_KEYS_SIZE];
        hd_json_list_keys(parent, keys);
        is_named = is_named && keys[0] != '\0';
        complain(walk, "%.*s is missing, expected %s%s", length, walk->change,
                 is_named ? "one of " : "it in the scene", is_named ? keys : "");
        return;
    }
    hd_quoted(nearest.name, quoted);
    complain(walk, "%.*s is missing; did you mean %s?", length, walk->change, quoted);
}

/* `length`: bytes of the path before the step. */
static json_t *find_child(const Walk *walk, json_t *parent, const Step *step, int length) {
    static const char names[] = "materials";
    const bool is_named =
        length == (int)sizeof names - 1 && strncmp(walk->change, names, sizeof names - 1) == 0;
    if (step->key[0] == '\0')
        return json_array_get(parent, step->index);
    json_t *child = json_object_get(parent, step->key);
    if (child == NULL && may_be_made(step, length == 0)) {
        json_object_set_new(parent, step->key, json_object());
        child = json_object_get(parent, step->key);
    }
    if (child == NULL)
        complain_of_missing(walk, parent, step->key, is_named);
    return child;
}

/* Parses the value as JSON, or else takes it as a string; reports it and returns NULL if it is
   neither. */
static json_t *read_value(const Walk *walk) {
    const char *text = walk->end + 1;
    json_error_t found;
    json_t *value = json_loadb(text, strlen(text), HD_JSON_FLAGS | JSON_DECODE_ANY, &found);
    if (value != NULL)
        return value;
    if (json_error_code(&found) == json_error_numeric_overflow) {
        complain(walk, "the value is too large, expected a number that a double can hold");
        return NULL;
    }
    value = json_string(text);
    if (value == NULL)
        complain(walk, "the value is not UTF-8, expected JSON or text");
    return value;
}

static void put(const Walk *walk, json_t *parent, const Step *step) {
    json_t *value = read_value(walk);
    if (value == NULL)
        return;
    const int failed = step->key[0] == '\0' ? json_array_set_new(parent, step->index, value)
                                            : json_object_set_new(parent, step->key, value);
    if (failed)
        complain(walk, "%.*s cannot be changed, expected a key in UTF-8 and enough memory",
                 (int)(walk->end - walk->change), walk->change);
}

void hd_scene_change_apply(json_t *root, HdSceneChange change, HdProblems *problems) {
    Walk walk = {.change = change, .at = change, .end = find_end(change), .problems = problems};
    Step step;
    if (walk.end == NULL) {
        complain(&walk, "there is no sign =, expected PATH=VALUE");
        return;
    }
    for (json_t *parent = root; parent != NULL;) {
        const int length = (int)(walk.at - walk.change);
        if (!read_step(&walk, &step)) {
            complain(&walk, "the path is not understood, expected one such as camera.field_of_view "
                            "or solids[0].circumradius");
            return;
        }
        if (!check_parent(&walk, parent, &step, length))
            return;
        if (walk.at == walk.end) {
            put(&walk, parent, &step);
            return;
        }
        parent = find_child(&walk, parent, &step, length);
    }
}

/* Writes the path of a change as messages spell it; returns false if it is malformed. */
static bool spell_path(HdSceneChange change, char path[HD_JSON_PATH_SIZE]) {
    Walk walk = {.change = change, .at = change, .end = find_end(change)};
    Step step;
    path[0] = '\0';
    while (walk.end != NULL && walk.at != walk.end) {
        if (!read_step(&walk, &step))
            return false;
        if (step.key[0] == '\0')
            hd_json_path_index(path, step.index);
        else
            hd_json_path_key(path, step.key);
    }
    return path[0] != '\0';
}

/* Returns whether the change set the value at `path`, spelled as in json/text.h. */
static bool change_made(HdSceneChange change, const char *path) {
    char changed[HD_JSON_PATH_SIZE];
    if (!spell_path(change, changed) || strncmp(changed, path, strlen(changed)) != 0)
        return false;
    const char after = path[strlen(changed)];
    return after == '\0' || after == '.' || after == '[';
}

/* Problems */

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
        if (change_made(source->changes[i], report->path))
            name_change(source->changes[i], name);
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

/* Names of scene objects in other programs. A word may have several meanings; each place has at
   most one of them. */
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

/* Wraps hd_nearest_offer, but prefers a synonym, or the word in another case, to any other name. */
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

/* Finds a key that belongs in one of the top-level objects. */
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

void hd_report_unknown_keys(HdSceneReport *report, const HdObjectType *type, const json_t *json) {
    const char *key;
    json_t *value;
    json_object_foreach((json_t *)json, key, value) {
        const bool is_comment = strcmp(key, HD_COMMENT_KEY) == 0;
        if (hd_field(type, key) != NULL || (is_comment && json_is_string(value)))
            continue;
        if (is_comment) {
            const size_t length = hd_json_path_key(report->path, key);
            hd_report_value(report, value, "a string");
            report->path[length] = '\0';
        } else if (hd_problems_are_full(report->problems))
            report->problems->count++;
        else
            report_unknown_key(report, type, key);
    }
}
