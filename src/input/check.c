/* SPDX-License-Identifier: MIT */
#include "input/check.h"

#include <stdio.h>
#include <string.h>

#include "input/fields.h"

/* NaN compares false with everything, so it is outside every range. */
static void check_number(HdSceneChecker *checker, const HdField *field, const char *what,
                         const char *part, double value) {
    const char *unit = field->unit != NULL ? field->unit : "";
    const double low = field->low, high = field->high;
    char expected[96];
    if (hd_field_holds(field, value))
        return;
    if (field->least_but_zero > 0.0)
        snprintf(expected, sizeof expected, "0, or a number from %.15g to %.15g",
                 field->least_but_zero, high);
    else if (field->above_low)
        snprintf(expected, sizeof expected, "more than %.15g and at most %.15g%s", low, high, unit);
    else if (field->below_high)
        snprintf(expected, sizeof expected, "at least %.15g and less than %.15g", low, high);
    else
        snprintf(expected, sizeof expected, "a number from %.15g to %.15g", low, high);
    hd_tell(checker, "%s%s is %.15g, expected %s", what, part, value, expected);
}

static void check_vector(HdSceneChecker *checker, const HdField *field, const char *what,
                         const HdVec3 *value) {
    static const char *const axes[3] = {" x", " y", " z"};
    static const char *const channels[3] = {"'s red", "'s green", "'s blue"};
    const char *const *parts = field->is_light ? channels : axes;
    check_number(checker, field, what, parts[0], value->x);
    check_number(checker, field, what, parts[1], value->y);
    check_number(checker, field, what, parts[2], value->z);
}

static bool check_count(HdSceneChecker *checker, const HdField *field, int count) {
    char what[64];
    snprintf(what, sizeof what, "number of %ss", field->said);
    hd_check_int(checker, what, count, field->least, field->most);
    return count >= field->least && count <= field->most;
}

static void check_vectors(HdSceneChecker *checker, const HdField *field, const HdVec3 *vectors,
                          int count) {
    if (!check_count(checker, field, count))
        return;
    for (int i = 0; i < count; i++) {
        char what[64];
        snprintf(what, sizeof what, "%s %d", field->said, i + 1);
        check_vector(checker, field, what, &vectors[i]);
    }
}

static void check_field(HdSceneChecker *checker, const HdField *field, const void *owner) {
    const void *place = (const char *)owner + field->offset;
    char what[HD_SAID_SIZE];
    hd_field_said(field, what);
    switch (field->type) {
    case HD_FIELD_INTEGER:
        hd_check_int(checker, what, *(const int *)place, (int)field->low, (int)field->high);
        break;
    case HD_FIELD_NUMBER:
        check_number(checker, field, what, "", *(const double *)place);
        break;
    case HD_FIELD_VECTOR:
    case HD_FIELD_FACTOR:
    case HD_FIELD_SCALE:
        check_vector(checker, field, what, place);
        break;
    case HD_FIELD_VECTORS:
        check_vectors(checker, field, place, hd_field_count(field, owner));
        break;
    default: /* has a check of its own, or no wrong value */
        break;
    }
}

/* `without`: a field that has a check of its own; NULL: none. */
static void check_fields(HdSceneChecker *checker, const HdObjectType *type, const void *owner,
                         const char *without) {
    for (int i = 0; i < type->field_count; i++)
        if (hd_field_is_given(&type->fields[i], owner) &&
            (without == NULL || strcmp(type->fields[i].key, without) != 0))
            check_field(checker, &type->fields[i], owner);
}

static const HdObjectType *object_of(const HdObjectType *type, const char *key) {
    return hd_field(type, key)->object;
}

static void check_path(HdSceneChecker *checker, const char *key, const HdPath *path) {
    const HdField *field = hd_field(object_of(&hd_scene_fields, "camera"), key);
    char json[32];
    snprintf(json, sizeof json, "camera.%s", key);
    hd_check_enter(checker, key, json);
    if (path->is_fixed)
        check_vector(checker, field, "point", &path->point);
    else
        check_fields(checker, field->object, path, NULL);
}

static void check_camera(HdSceneChecker *checker, const HdScene *scene) {
    check_fields(checker, object_of(&hd_scene_fields, "camera"), scene, NULL);
    check_path(checker, "eye", &scene->eye);
    check_path(checker, "target", &scene->target);
}

static void check_picture(HdSceneChecker *checker, const HdScene *scene) {
    check_fields(checker, object_of(&hd_scene_fields, "image"), scene, NULL);
    check_vector(checker, hd_field(&hd_scene_fields, "background"), "background",
                 &scene->background);
}

static void check_solid(HdSceneChecker *checker, const HdSolid *solid) {
    hd_check_int(checker, "kind", (int)solid->kind, 0, HD_SOLID_KIND_COUNT - 1);
    check_fields(checker, object_of(&hd_scene_fields, "solids"), solid, NULL);
}

static void check_instance(HdSceneChecker *checker, const HdInstance *instance) {
    const HdMeshEntry entry = {.instance = *instance};
    check_fields(checker, object_of(&hd_scene_fields, "meshes"), &entry, NULL);
}

static void check_corners(HdSceneChecker *checker, const HdFloor *floor) {
    check_vectors(checker, hd_field(object_of(&hd_scene_fields, "floor"), "corners"),
                  floor->corners, 4);
}

void hd_check_values(HdSceneChecker *checker, HdScenePart part, const void *owner) {
    const HdObjectType *solid = object_of(&hd_scene_fields, "solids");
    if (part == HD_PART_CAMERA)
        check_camera(checker, owner);
    else if (part == HD_PART_PICTURE)
        check_picture(checker, owner);
    else if (part == HD_PART_LIGHT)
        check_fields(checker, object_of(&hd_scene_fields, "lights"), owner, NULL);
    else if (part == HD_PART_SOLID)
        check_solid(checker, owner);
    else if (part == HD_PART_EDGE_LIGHTS)
        check_fields(checker, object_of(solid, "edge_lights"), owner, NULL);
    else if (part == HD_PART_FLOOR)
        check_corners(checker, owner);
    else if (part == HD_PART_INSTANCE)
        check_instance(checker, owner);
    else
        check_fields(checker, &hd_material_fields, owner,
                     part == HD_PART_COATING ? "index_of_refraction" : NULL);
}

HdStatus hd_scene_validate(const HdScene *scene, HdError *error) {
    HdProblems problems = {0};
    HdSceneChecker checker = {.problems = &problems, .check_values = hd_check_values};
    hd_check_scene(&checker, scene);
    return hd_problems_first(&problems, error);
}
