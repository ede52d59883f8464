/* SPDX-License-Identifier: MIT */
#include "input/changes.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "input/fields.h"
#include "input/json/text.h"

/* One step of a path: a key, or, where that is empty, an index. */
typedef struct Step {
    char key[HD_MAX_PATH];
    size_t index;
} Step;

typedef struct Walk {
    HdSceneChange change;
    const char *at;       /* what is left of the path */
    const char *end;      /* the sign = */
    HdProblems *problems; /* NULL where nothing is told */
} Walk;

void hd_scene_change_name(HdSceneChange change, char out[256]) {
    char quoted[HD_WORDS_SIZE];
    hd_quoted(change, quoted);
    const int inner = (int)strlen(quoted) - 2;
    snprintf(out, 256, "%s %.*s: ", HD_CHANGE_OPTION, inner, quoted + 1);
}

#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
static void
complain(const Walk *walk, const char *format, ...) {
    char name[256], text[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    hd_scene_change_name(walk->change, name);
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

/* A key in quotes may have any character but a quote. */
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

/* The sign = that ends the path, not one in a quoted key; NULL where there is none. */
static const char *find_end(HdSceneChange change) {
    const char *c = change;
    while (*c != '\0' && *c != '=') {
        const bool begins_key = c == change || c[-1] == '.';
        const char *close = begins_key && *c == '"' ? strchr(c + 1, '"') : NULL;
        c = close != NULL ? close + 1 : c + 1;
    }
    return *c == '=' ? c : NULL;
}

/* The next step, which begins the path or follows a dot, or is an index; false where there is none.
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

/* Complains unless `parent`, which the first `length` bytes name, can hold the step: an object for
   a key, an array for an index of it. */
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

static void complain_of_missing(const Walk *walk, json_t *parent, const char *missing) {
    const int length = (int)(walk->at - walk->change);
    char quoted[HD_WORDS_SIZE];
    HdNearest nearest = {.word = missing};
    const char *key;
    json_t *ignored;
    json_object_foreach(parent, key, ignored) {
        hd_nearest_offer(&nearest, key);
    }
    if (nearest.name == NULL) {
        complain(walk, "%.*s is missing, expected it in the scene", length, walk->change);
        return;
    }
    hd_quoted(nearest.name, quoted);
    complain(walk, "%.*s is missing; did you mean %s?", length, walk->change, quoted);
}

static json_t *find_child(const Walk *walk, json_t *parent, const Step *step, bool is_first) {
    if (step->key[0] == '\0')
        return json_array_get(parent, step->index);
    json_t *child = json_object_get(parent, step->key);
    if (child == NULL && may_be_made(step, is_first)) {
        json_object_set_new(parent, step->key, json_object());
        child = json_object_get(parent, step->key);
    }
    if (child == NULL)
        complain_of_missing(walk, parent, step->key);
    return child;
}

/* The value, a string where it is no JSON; NULL, and complains, where it is neither. */
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
        parent = find_child(&walk, parent, &step, length == 0);
    }
}

/* Spells the path of a change as messages do; false where it is not understood. */
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

bool hd_scene_change_made(HdSceneChange change, const char *path) {
    char changed[HD_JSON_PATH_SIZE];
    if (!spell_path(change, changed) || strncmp(changed, path, strlen(changed)) != 0)
        return false;
    const char after = path[strlen(changed)];
    return after == '\0' || after == '.' || after == '[';
}
