/* SPDX-License-Identifier: MIT */
#include "input/scene_paths.h"

#include <jansson.h>
#include <stdio.h>
#include <string.h>

#include "input/builtin.h"
#include "input/changes.h"
#include "input/fields.h"
#include "input/json/words.h"

typedef struct Walk {
    const char *typed;
    HdOffer *offer;
    const void *taker;
    char path[HD_JSON_PATH_SIZE];
} Walk;

static void walk_object(Walk *walk, const HdObjectType *type, const json_t *json);

static bool begins_with(const char *text, const char *beginning) {
    return strncmp(text, beginning, strlen(beginning)) == 0;
}

/* The path stands at something that has parts. */
static void enter(Walk *walk, const char *about, const HdObjectType *type, const json_t *json) {
    const size_t length = strlen(walk->path);
    if (length + 2 > sizeof walk->path)
        return;
    memcpy(walk->path + length, ".", 2);
    if (begins_with(walk->path, walk->typed) && strlen(walk->typed) <= length)
        walk->offer(walk->taker, walk->path, about);
    walk->path[length] = '\0';
    if (begins_with(walk->typed, walk->path) && walk->typed[length] == '.')
        walk_object(walk, type, json);
}

/* Goes on to a key, spelled as changes spell it. Returns the length to go back to. */
static size_t append_key(Walk *walk, const char *key) {
    const size_t length = strlen(walk->path);
    snprintf(walk->path + length, sizeof walk->path - length, "%s%s", length > 0 ? "." : "", key);
    return length;
}

static void enter_list(Walk *walk, const HdField *field, const json_t *json) {
    const size_t length = strlen(walk->path);
    for (size_t i = 0; i < json_array_size(json); i++) {
        snprintf(walk->path + length, sizeof walk->path - length, "[%zu]", i);
        enter(walk, field->about, field->object, json_array_get(json, i));
    }
    walk->path[length] = '\0';
}

static void enter_materials(Walk *walk, const HdField *field, const json_t *json) {
    const char *name;
    json_t *material;
    json_object_foreach((json_t *)json, name, material) {
        if (strpbrk(name, ".=[]") != NULL) /* no change reaches it */
            continue;
        const size_t length = append_key(walk, name);
        enter(walk, field->about, field->object, material);
        walk->path[length] = '\0';
    }
}

/* The path stands at a value. */
static void offer_value(Walk *walk, const HdField *field) {
    const size_t length = strlen(walk->path);
    char text[HD_JSON_PATH_SIZE + 64];
    snprintf(text, sizeof text, "%s=", walk->path);
    if (strlen(walk->typed) <= length || field->choices == NULL) {
        walk->offer(walk->taker, text, field->about);
        return;
    }
    for (const HdChoice *choice = field->choices; choice->word != NULL; choice++) {
        snprintf(text, sizeof text, "%s=%s", walk->path, choice->word);
        walk->offer(walk->taker, text, "");
    }
}

/* Of a part that the scene lacks nothing can be changed, unless it has one by default. */
static void walk_field(Walk *walk, const HdField *field, const json_t *json) {
    if (field->type == HD_FIELD_LIST)
        enter_list(walk, field, json);
    else if (field->type == HD_FIELD_MATERIALS)
        enter_materials(walk, field, json);
    else if (field->type != HD_FIELD_OBJECT)
        offer_value(walk, field);
    else if (json != NULL || !hd_field_may_be_absent(field))
        enter(walk, field->about, field->object, json);
}

static void walk_object(Walk *walk, const HdObjectType *type, const json_t *json) {
    for (int i = 0; i < type->field_count; i++) {
        const HdField *field = &type->fields[i];
        if (field->type == HD_FIELD_TEXT && field->key[0] == '$') /* not of the scene */
            continue;
        const size_t length = append_key(walk, field->key);
        walk_field(walk, field, json_object_get(json, field->key));
        walk->path[length] = '\0';
    }
}

void hd_offer_scene_paths(const char *scene, const char *typed, HdOffer *offer, const void *taker) {
    Walk walk = {.typed = typed, .offer = offer, .taker = taker, .path = ""};
    size_t size;
    const char *built_in = hd_default_scene_text(&size);
    json_t *root = scene != NULL ? json_load_file(scene, HD_JSON_FLAGS, NULL) : NULL;
    if (root == NULL)
        root = json_loadb(built_in, size, HD_JSON_FLAGS, NULL);
    walk_object(&walk, &hd_scene_fields, root);
    json_decref(root);
}
