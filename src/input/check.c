/* SPDX-License-Identifier: MIT */
#include "input/check.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "input/fields.h"

/* The kernels count positions in the picture in half samples, as floats. */
_Static_assert(2 * HD_MAX_IMAGE_SIDE * HD_MAX_SAMPLES_PER_SIDE < 1 << 24,
               "every half sample of the largest picture is an exact float");

/* What a sum such as 0.7 + 0.3 may exceed 1 by. */
static const double sum_tolerance = 1e-9;

/* Places */

/* Names the part of the scene that is checked from now on, in front of its problems; "": none. */
static void enter(HdSceneChecker *checker, const char *prose, const char *json) {
    const char *name = checker->naming == HD_NAMING_JSON ? json : prose;
    snprintf(checker->place, sizeof checker->place, "%s%s", name, name[0] != '\0' ? ": " : "");
}

/* The same for an element of a list, counted from 0. */
static void enter_item(HdSceneChecker *checker, const char *prose, const char *json, int index) {
    if (checker->naming == HD_NAMING_JSON)
        snprintf(checker->place, sizeof checker->place, "%s[%d]: ", json, index);
    else
        snprintf(checker->place, sizeof checker->place, "%s %d: ", prose, index + 1);
}

static void enter_rim(HdSceneChecker *checker, int index) {
    if (checker->naming == HD_NAMING_JSON)
        snprintf(checker->place, sizeof checker->place, "solids[%d].rim: ", index);
    else
        snprintf(checker->place, sizeof checker->place, "solid %d: rim ", index + 1);
}

/* Back to the scene as a whole. */
static void leave(HdSceneChecker *checker) {
    checker->place[0] = '\0';
}

/* Values of the table */

static const HdField *scene_field(const char *key) {
    return hd_field(&hd_scene_fields, key);
}

static void add_value(HdSceneChecker *checker, const char *what, const char *part, double value,
                      const char *expected) {
    hd_tell(checker, "%s%s is %.15g, expected %s", what, part, value, expected);
}

/* NaN compares false with everything, so it is outside every range. */
static bool is_allowed(const HdField *field, double value) {
    return hd_field_holds(field, value) && (value == 0.0 || fabs(value) >= field->least_but_zero);
}

static void check_number(HdSceneChecker *checker, const HdField *field, const char *what,
                         const char *part, double value) {
    const char *unit = field->unit != NULL ? field->unit : "";
    const double low = field->low, high = field->high;
    char expected[96];
    if (is_allowed(field, value))
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
    add_value(checker, what, part, value, expected);
}

static void check_int(HdSceneChecker *checker, const char *what, int value, int low, int high) {
    if (value < low || value > high)
        hd_tell(checker, "%s is %d, expected %d to %d", what, value, low, high);
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
    const char *name = field->said != NULL ? field->said : field->key;
    char what[64];
    snprintf(what, sizeof what, "number of %s%s", name, field->type == HD_FIELD_LIST ? "" : "s");
    check_int(checker, what, count, field->least, field->most);
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
        check_int(checker, what, *(const int *)place, (int)field->low, (int)field->high);
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

static void check_fields(HdSceneChecker *checker, const HdObjectType *type, const void *owner) {
    for (int i = 0; i < type->field_count; i++)
        if (hd_field_is_given(&type->fields[i], owner))
            check_field(checker, &type->fields[i], owner);
}

/* Parts of a scene */

static void check_falloff(HdSceneChecker *checker, const HdFalloff *falloff) {
    if (falloff->distance > 0.0 && falloff->end > 0.0)
        hd_tell(checker, "falloff distance is %.15g and falloff end is %.15g, expected one of them",
                falloff->distance, falloff->end);
}

static void check_path(HdSceneChecker *checker, const char *key, const HdPath *path) {
    const HdField *field = hd_field(scene_field("camera")->object, key);
    char json[32];
    snprintf(json, sizeof json, "camera.%s", key);
    enter(checker, key, json);
    if (path->is_fixed)
        check_vector(checker, field, "point", &path->point);
    else
        check_fields(checker, field->object, path);
}

static void check_camera(HdSceneChecker *checker, const HdScene *scene) {
    const int before = checker->problems->count;
    enter(checker, "", "camera");
    check_fields(checker, scene_field("camera")->object, scene);
    check_path(checker, "eye", &scene->eye);
    check_path(checker, "target", &scene->target);
    leave(checker);
    checker->camera_is_sound = checker->problems->count == before;
}

static void check_picture(HdSceneChecker *checker, const HdScene *scene) {
    if ((int64_t)scene->width * scene->height > HD_MAX_IMAGE_PIXELS)
        hd_tell(checker, "%d x %d pixels are too many, expected at most %d in all", scene->width,
                scene->height, (int)HD_MAX_IMAGE_PIXELS);
    check_fields(checker, scene_field("image")->object, scene);
    check_vector(checker, scene_field("background"), "background", &scene->background);
}

/* Of one side of a material, "" or "inner ". */
static void check_sum(HdSceneChecker *checker, const HdField *field, const char *side,
                      double reflection, double transmission) {
    const double sum = reflection + transmission;
    char what[48];
    snprintf(what, sizeof what, "%sreflection + transmission", side);
    if (hd_field_holds(field, reflection) && hd_field_holds(field, transmission) &&
        sum > 1.0 + sum_tolerance)
        add_value(checker, what, "", sum, "at most 1");
}

static void check_refraction(HdSceneChecker *checker, const HdField *field,
                             const HdMaterial *material, bool may_refract) {
    if (may_refract)
        check_field(checker, field, material);
    else if (material->index_of_refraction != 1.0)
        add_value(checker, "index of refraction", "", material->index_of_refraction,
                  "1, since only a solid's faces can refract");
}

static void check_material(HdSceneChecker *checker, const HdMaterial *material, bool may_refract) {
    for (int i = 0; i < hd_material_fields.field_count; i++) {
        const HdField *field = &hd_material_fields.fields[i];
        if (!hd_field_is_given(field, material))
            continue;
        if (field->offset == offsetof(HdMaterial, index_of_refraction))
            check_refraction(checker, field, material, may_refract);
        else
            check_field(checker, field, material);
        if (field->offset == offsetof(HdMaterial, transmission))
            check_sum(checker, field, "", material->reflection, material->transmission);
        if (field->offset == offsetof(HdMaterial, inner_transmission))
            check_sum(checker, field, "inner ", material->inner_reflection,
                      material->inner_transmission);
    }
}

void hd_material_check(const HdMaterial *material, const char *place, HdProblems *problems) {
    HdSceneChecker checker = {.problems = problems};
    snprintf(checker.place, sizeof checker.place, "%s", place);
    check_material(&checker, material, true);
}

static void check_opaque(HdSceneChecker *checker, const char *what, double transmission) {
    if (transmission > 0.0)
        add_value(checker, what, "", transmission, "0, since rims are opaque");
}

static void check_rim_material(HdSceneChecker *checker, const HdMaterial *rim) {
    check_material(checker, rim, false);
    check_opaque(checker, "transmission", rim->transmission);
    if (rim->has_inner_side)
        check_opaque(checker, "inner transmission", rim->inner_transmission);
}

/* The radius of the circle inscribed in a face of the solid with circumradius 1. */
static double face_inradius(const HdPlatonic *platonic) {
    const double half_edge = platonic->edge_length / 2.0;
    return sqrt(1.0 - half_edge * half_edge - platonic->inradius * platonic->inradius);
}

static void check_rim_width(HdSceneChecker *checker, const HdSolid *solid,
                            const HdPlatonic *platonic) {
    const double limit = solid->circumradius * face_inradius(platonic);
    char expected[96];
    if (solid->rim_width >= 0.0 && solid->rim_width < limit)
        return;
    snprintf(expected, sizeof expected,
             "at least 0 and less than the radius of the circle in a face, %.6g", limit);
    add_value(checker, "rim width", "", solid->rim_width, expected);
}

static void check_edge_lights(HdSceneChecker *checker, const HdEdgeLights *lights) {
    const HdObjectType *solid = scene_field("solids")->object;
    if (lights->per_edge == 0)
        return;
    check_fields(checker, hd_field(solid, "edge_lights")->object, lights);
    check_falloff(checker, &lights->falloff);
}

static void check_solid(HdSceneChecker *checker, const HdSolid *solid, int index) {
    const int before = checker->problems->count;
    enter_item(checker, "solid", "solids", index);
    check_int(checker, "kind", (int)solid->kind, 0, HD_SOLID_KIND_COUNT - 1);
    check_fields(checker, scene_field("solids")->object, solid);
    checker->solid_is_sound[index] = checker->problems->count == before;
    check_material(checker, &solid->face, true);
    if (checker->solid_is_sound[index]) {
        HdPlatonic platonic;
        hd_platonic(solid->kind, &platonic);
        check_rim_width(checker, solid, &platonic);
    }
    if (solid->rim_width > 0.0) {
        enter_rim(checker, index);
        check_rim_material(checker, &solid->rim);
        enter_item(checker, "solid", "solids", index);
    }
    check_edge_lights(checker, &solid->lights);
    leave(checker);
}

static void check_lights(HdSceneChecker *checker, const HdScene *scene) {
    const HdField *field = scene_field("lights");
    if (!check_count(checker, field, scene->light_count))
        return;
    for (int i = 0; i < scene->light_count; i++) {
        enter_item(checker, "light", "lights", i);
        check_fields(checker, field->object, &scene->lights[i]);
        check_falloff(checker, &scene->lights[i].falloff);
        leave(checker);
    }
}

static void check_solids(HdSceneChecker *checker, const HdScene *scene) {
    if (!check_count(checker, scene_field("solids"), scene->solid_count))
        return;
    checker->solid_count = scene->solid_count;
    for (int i = 0; i < checker->solid_count; i++)
        check_solid(checker, &scene->solids[i], i);
}

static bool has_sound_number(const HdEdgeLights *lights) {
    return lights->per_edge >= 0 && lights->per_edge <= HD_MAX_LIGHTS;
}

/* Whether the solid's lights alone are too many, which it then tells. */
static bool check_light_count(HdSceneChecker *checker, const HdSolid *solid, int index) {
    const int count = hd_edge_light_count(solid), per_edge = solid->lights.per_edge;
    const bool is_json = checker->naming == HD_NAMING_JSON;
    if (count <= HD_MAX_LIGHTS)
        return false;
    enter_item(checker, "solid", "solids", index);
    hd_tell(checker,
            "%s is %d, which makes %d lights on its %d edges, expected at most %d lights in "
            "the scene",
            is_json ? "edge_lights.per_edge" : "number of lights per edge", per_edge, count,
            count / per_edge, (int)HD_MAX_LIGHTS);
    leave(checker);
    return true;
}

static void check_all_lights(HdSceneChecker *checker, const HdScene *scene) {
    int lights = scene->light_count;
    bool is_told = scene->light_count > HD_MAX_LIGHTS;
    for (int i = 0; i < checker->solid_count; i++) {
        if (!checker->solid_is_sound[i] || !has_sound_number(&scene->solids[i].lights))
            continue;
        lights += hd_edge_light_count(&scene->solids[i]);
        is_told |= check_light_count(checker, &scene->solids[i], i);
    }
    if (!is_told && lights > HD_MAX_LIGHTS)
        hd_tell(checker,
                "number of lights, those on the edges included, is %d, expected at most %d", lights,
                (int)HD_MAX_LIGHTS);
}

static void check_floor(HdSceneChecker *checker, const HdFloor *floor) {
    const int before = checker->problems->count;
    if (!floor->present)
        return;
    enter(checker, "floor", "floor");
    check_vectors(checker, hd_field(scene_field("floor")->object, "corners"), floor->corners, 4);
    if (checker->problems->count == before)
        hd_check_floor_shape(checker, floor->corners);
    checker->floor_is_sound = checker->problems->count == before;
    check_material(checker, &floor->material, false);
    if (floor->material.has_inner_side)
        hd_problem(
            checker->problems,
            "%sits material has an inner side, expected none: a floor is alike on both sides",
            checker->place);
    if (floor->texture.width != 0) {
        check_int(checker, "texture width", floor->texture.width, 1, HD_MAX_TEXTURE_SIDE);
        check_int(checker, "texture height", floor->texture.height, 1, HD_MAX_TEXTURE_SIDE);
    }
    leave(checker);
}

static void check_reach(HdSceneChecker *checker, const char *what, double value, double low) {
    const HdField reach = {.low = low, .high = 2.0 * HD_MAX_NUMBER};
    check_number(checker, &reach, what, "", value);
}

/* As large or small as the triangles of any valid solid or floor may be: from corner to corner of a
   box that fits all coordinates, and from a side that the least length is the diagonal of. */
static void check_size(HdSceneChecker *checker, const HdMesh *mesh, HdVec3 scale) {
    const HdVec3 sides = hd_sub(mesh->upper, mesh->lower);
    const HdVec3 far = hd_vec3(fmax(fabs(mesh->lower.x), fabs(mesh->upper.x)) * scale.x,
                               fmax(fabs(mesh->lower.y), fabs(mesh->upper.y)) * scale.y,
                               fmax(fabs(mesh->lower.z), fabs(mesh->upper.z)) * scale.z);
    check_reach(checker, "longest side of its mesh, scaled,",
                fmax(sides.x * scale.x, fmax(sides.y * scale.y, sides.z * scale.z)),
                HD_MIN_LENGTH / 2.0);
    check_reach(checker, "farthest coordinate of its mesh, scaled,",
                fmax(far.x, fmax(far.y, far.z)), 0.0);
}

static void check_instance(HdSceneChecker *checker, const HdScene *scene, int index) {
    const HdMeshEntry entry = {.instance = scene->instances[index]};
    const HdInstance *instance = &entry.instance;
    enter_item(checker, "mesh", "meshes", index);
    const int before = checker->problems->count;
    check_int(checker, "number of its mesh", instance->mesh, 0, scene->mesh_count - 1);
    check_fields(checker, scene_field("meshes")->object, &entry);
    if (checker->problems->count == before)
        check_size(checker, &scene->meshes[instance->mesh], instance->scale);
    if (instance->has_material)
        check_material(checker, &instance->material, true);
    leave(checker);
}

static void check_instances(HdSceneChecker *checker, const HdScene *scene) {
    const HdField *field = scene_field("meshes");
    check_count(checker, field, scene->instance_count);
    for (int i = 0; i < scene->instance_count && i < field->most; i++)
        check_instance(checker, scene, i);
}

void hd_scene_check_instances(const HdScene *scene, HdNaming naming, HdProblems *problems) {
    HdSceneChecker checker = {.problems = problems, .naming = naming};
    check_instances(&checker, scene);
}

/* What is not there (no rim, no edge lights, no floor, no texture) is not checked. */
void hd_scene_check(const HdScene *scene, HdNaming naming, HdProblems *problems) {
    HdSceneChecker checker = {.problems = problems, .naming = naming};
    check_camera(&checker, scene);
    check_picture(&checker, scene);
    check_lights(&checker, scene);
    check_solids(&checker, scene);
    check_all_lights(&checker, scene);
    check_floor(&checker, &scene->floor);
    check_instances(&checker, scene);
    enter(&checker, "", "camera");
    hd_check_flight(&checker, scene);
    leave(&checker);
    hd_check_overlaps(&checker, scene);
}

HdStatus hd_scene_validate(const HdScene *scene, HdError *error) {
    HdProblems problems = {0};
    hd_scene_check(scene, HD_NAMING_PROSE, &problems);
    return hd_problems_first(&problems, error);
}
