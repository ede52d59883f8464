/* SPDX-License-Identifier: MIT */
#include "input/check.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "input/fields.h"
#include "scene/camera.h"
#include "scene/contact.h"

/* The kernels count half steps of the grid of samples in the picture, as floats. */
_Static_assert(2 * HD_MAX_IMAGE_SIDE * HD_MAX_SAMPLES_PER_SIDE < 1 << 24,
               "every half step of the grid in the largest picture is an exact float");

/* Rounding by which a sum such as 0.7 + 0.3 may exceed 1. */
static const double sum_tolerance = 1e-9;

/* Adds a problem of the checked part: a format, without the place, and its arguments. */
#define report(checker, format, ...)                                                               \
    hd_problem((checker)->problems, "%s" format, (checker)->place, __VA_ARGS__)

/* Places */

/* Sets the prefix of the problems that follow: a part of the scene; "": none. */
static void enter(HdSceneChecker *checker, const char *prose, const char *json) {
    const char *name = checker->naming == HD_NAMING_JSON ? json : prose;
    snprintf(checker->place, sizeof checker->place, "%s%s", name, name[0] != '\0' ? ": " : "");
}

/* Sets the prefix to an element of a list, counted from 0. */
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

/* Removes the prefix. */
static void leave(HdSceneChecker *checker) {
    checker->place[0] = '\0';
}

/* Values */

static void report_number(HdSceneChecker *checker, const char *what, double value,
                          const char *expected) {
    report(checker, "%s is %.15g, expected %s", what, value, expected);
}

static void check_int(HdSceneChecker *checker, const char *what, int value, int low, int high) {
    if (value < low || value > high)
        report(checker, "%s is %d, expected %d to %d", what, value, low, high);
}

static bool check_count(HdSceneChecker *checker, const char *what, int count, int least, int most) {
    check_int(checker, what, count, least, most);
    return count >= least && count <= most;
}

/* NaN compares false with everything, so it is outside every range. */
static void check_number(HdSceneChecker *checker, const HdField *field, const char *what,
                         const char *part, double value) {
    const char *unit = field->unit != NULL ? field->unit : "";
    const double low = field->low, high = field->high;
    char expected[96];
    if (hd_field_holds(field, value) && !(value > 0.0 && value < field->least_but_zero))
        return;
    if (field->least_but_zero > 0.0)
        snprintf(expected, sizeof expected, "0, or a number from %.15g to %.15g",
                 field->least_but_zero, high);
    else if (field->above_low)
        snprintf(expected, sizeof expected, "more than %.15g and at most %.15g%s", low, high, unit);
    else if (field->below_high)
        snprintf(expected, sizeof expected, "at least %.15g and less than %.15g", low, high);
    else
        snprintf(expected, sizeof expected, "a number from %.15g to %.15g%s", low, high,
                 field->has_sign ? ", or its negative" : "");
    report(checker, "%s%s is %.15g, expected %s", what, part, value, expected);
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

static void check_vectors(HdSceneChecker *checker, const HdField *field, const HdVec3 *vectors,
                          int count) {
    char what[64];
    snprintf(what, sizeof what, "number of %ss", field->name);
    if (!check_count(checker, what, count, field->least, field->most))
        return;
    for (int i = 0; i < count; i++) {
        snprintf(what, sizeof what, "%s %d", field->name, i + 1);
        check_vector(checker, field, what, &vectors[i]);
    }
}

static void check_field(HdSceneChecker *checker, const HdField *field, const void *owner) {
    const void *place = (const char *)owner + field->offset;
    char what[HD_FIELD_NAME_SIZE];
    hd_field_name(field, what);
    switch (field->type) {
    case HD_FIELD_INTEGER:
        check_int(checker, what, *(const int *)place, (int)field->low, (int)field->high);
        break;
    case HD_FIELD_RATE:
        check_int(checker, what, ((const HdOutputStyle *)place)->frames_per_second, (int)field->low,
                  (int)field->high);
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
    default: /* checked elsewhere, or has no wrong value */
        break;
    }
}

/* Checks the fields of an object, except `without`, if not NULL. */
static void check_fields(HdSceneChecker *checker, const HdObjectType *type, const void *owner,
                         const char *without) {
    for (int i = 0; i < type->field_count; i++)
        if (hd_field_is_given(&type->fields[i], owner) &&
            (without == NULL || strcmp(type->fields[i].key, without) != 0))
            check_field(checker, &type->fields[i], owner);
}

/* Checks the object at a key of the scene. */
static void check_object(HdSceneChecker *checker, const char *key, const void *owner) {
    check_fields(checker, hd_field(&hd_scene_fields, key)->object, owner, NULL);
}

static void check_path(HdSceneChecker *checker, const char *key, const HdPath *path) {
    const HdField *field = hd_field(hd_field(&hd_scene_fields, "camera")->object, key);
    char json[32];
    snprintf(json, sizeof json, "camera.%s", key);
    enter(checker, key, json);
    if (path->is_fixed)
        check_vector(checker, field, "point", &path->point);
    else
        check_fields(checker, field->object, path, NULL);
}

/* The camera and the picture */

/* Returns the cylinder path; of a fixed point one that does not swing. */
static HdCylinderPath swings_of(const HdPath *path) {
    const HdVec3 aside = hd_vec3(path->point.x, path->point.y, 0.0);
    if (!path->is_fixed)
        return path->cylinder;
    return (HdCylinderPath){.r0 = hd_length(aside), .z0 = path->point.z};
}

/* Returns true for most camera paths, which saves checking millions of frames: their heights or
   their distances from the z axis always differ. */
static bool paths_keep_apart(const HdPath *eye, const HdPath *target) {
    static const double margin = 1e-9;
    const HdCylinderPath a = swings_of(eye), b = swings_of(target);
    const double r_swing = fabs(a.r_amplitude) + fabs(b.r_amplitude);
    const double z_swing = fabs(a.z_amplitude) + fabs(b.z_amplitude);
    const double gap = fmax(fabs(fabs(a.r0) - fabs(b.r0)) - r_swing, fabs(a.z0 - b.z0) - z_swing);
    return gap > margin * (fabs(a.r0) + fabs(b.r0) + r_swing + fabs(a.z0) + fabs(b.z0) + z_swing);
}

/* Reports the first frame without a camera. */
static void check_camera_path(HdSceneChecker *checker, const HdScene *scene) {
    const bool stands_still = scene->eye.is_fixed && scene->target.is_fixed;
    const int frames = stands_still ? 1 : scene->frame_count;
    HdStatus status = HD_OK;
    HdCamera camera;
    HdError error;
    if (checker->is_view_wrong || paths_keep_apart(&scene->eye, &scene->target))
        return;
    for (int frame = 0; status == HD_OK && frame < frames; frame++)
        status = hd_camera_at(&camera, scene, frame, &error);
    if (status != HD_OK)
        report(checker, "%s", error.message);
}

static void check_camera(HdSceneChecker *checker, const HdScene *scene) {
    const int before = checker->problems->count;
    enter(checker, "", "camera");
    check_object(checker, "camera", scene);
    check_path(checker, "eye", &scene->eye);
    check_path(checker, "target", &scene->target);
    leave(checker);
    checker->is_view_wrong |= checker->problems->count != before;
}

static void check_picture(HdSceneChecker *checker, const HdScene *scene) {
    if ((int64_t)scene->width * scene->height > HD_MAX_IMAGE_PIXELS)
        report(checker, "%d x %d pixels are too many, expected at most %d in all", scene->width,
               scene->height, (int)HD_MAX_IMAGE_PIXELS);
    check_object(checker, "image", scene);
    check_vector(checker, hd_field(&hd_scene_fields, "background"), "background",
                 &scene->background);
    enter(checker, "environment", "environment");
    check_object(checker, "environment", &scene->environment);
    leave(checker);
}

/* Materials */

static bool is_share(double value) {
    return value >= 0.0 && value <= 1.0;
}

/* Checks the shares of one side of a material, "" or "inner ". */
static void check_sum(HdSceneChecker *checker, const char *side, double reflection,
                      double transmission) {
    const double sum = reflection + transmission;
    if (is_share(reflection) && is_share(transmission) && sum > 1.0 + sum_tolerance)
        report(checker, "%sreflection + transmission is %.15g, expected at most 1", side, sum);
}

void hd_check_material(HdSceneChecker *checker, const HdMaterial *material, bool may_refract) {
    check_fields(checker, &hd_material_fields, material,
                 may_refract ? NULL : "index_of_refraction");
    check_sum(checker, "", material->reflection, material->transmission);
    if (material->has_inner_side)
        check_sum(checker, "inner ", material->inner_reflection, material->inner_transmission);
    if (!may_refract && material->index_of_refraction != 1.0)
        report_number(checker, "index of refraction", material->index_of_refraction,
                      "1, since only a solid's faces can refract");
}

static void check_opaque(HdSceneChecker *checker, const char *what, double transmission) {
    if (transmission > 0.0)
        report_number(checker, what, transmission, "0, since rims are opaque");
}

static void check_rim_material(HdSceneChecker *checker, const HdMaterial *rim) {
    hd_check_material(checker, rim, false);
    check_opaque(checker, "transmission", rim->transmission);
    if (rim->has_inner_side)
        check_opaque(checker, "inner transmission", rim->inner_transmission);
}

/* Lights and solids */

static void check_falloff(HdSceneChecker *checker, const HdFalloff *falloff) {
    if (falloff->distance > 0.0 && falloff->end > 0.0)
        report(checker, "falloff distance is %.15g and falloff end is %.15g, expected one of them",
               falloff->distance, falloff->end);
}

/* Returns the radius of the circle inscribed in a face of the solid with circumradius 1. */
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
    report_number(checker, "rim width", solid->rim_width, expected);
}

static void check_edge_lights(HdSceneChecker *checker, const HdEdgeLights *lights) {
    if (lights->per_edge == 0)
        return;
    const HdObjectType *solid = hd_field(&hd_scene_fields, "solids")->object;
    check_fields(checker, hd_field(solid, "edge_lights")->object, lights, NULL);
    check_falloff(checker, &lights->falloff);
}

static void check_rim(HdSceneChecker *checker, const HdSolid *solid, int index) {
    HdPlatonic platonic;
    if (!checker->is_solid_wrong[index]) {
        hd_platonic(solid->kind, &platonic);
        check_rim_width(checker, solid, &platonic);
    }
    if (solid->rim_width > 0.0) {
        enter_rim(checker, index);
        check_rim_material(checker, &solid->rim);
        enter_item(checker, "solid", "solids", index);
    }
}

static void check_solid(HdSceneChecker *checker, const HdSolid *solid, int index) {
    const int before = checker->problems->count;
    const bool was_wrong = checker->is_solid_wrong[index];
    enter_item(checker, "solid", "solids", index);
    check_int(checker, "kind", (int)solid->kind, 0, HD_SOLID_KIND_COUNT - 1);
    check_object(checker, "solids", solid);
    checker->is_solid_wrong[index] |= checker->problems->count != before;
    hd_check_material(checker, &solid->face, true);
    if (!was_wrong)
        check_rim(checker, solid, index);
    check_edge_lights(checker, &solid->lights);
    leave(checker);
}

static void check_lights(HdSceneChecker *checker, const HdScene *scene) {
    if (!check_count(checker, "number of lights", scene->light_count, 0, HD_MAX_LIGHTS))
        return;
    for (int i = 0; i < scene->light_count; i++) {
        enter_item(checker, "light", "lights", i);
        check_object(checker, "lights", &scene->lights[i]);
        check_falloff(checker, &scene->lights[i].falloff);
        leave(checker);
    }
}

static void check_solids(HdSceneChecker *checker, const HdScene *scene) {
    if (!check_count(checker, "number of solids", scene->solid_count, 0, HD_MAX_SOLIDS))
        return;
    checker->solid_count = scene->solid_count;
    for (int i = 0; i < checker->solid_count; i++)
        check_solid(checker, &scene->solids[i], i);
}

/* Returns whether the lights of the solid can be counted. */
static bool has_sound_lights(const HdSolid *solid) {
    const int per_edge = solid->lights.per_edge, kind = (int)solid->kind;
    return kind >= 0 && kind < HD_SOLID_KIND_COUNT && per_edge >= 0 && per_edge <= HD_MAX_LIGHTS;
}

/* Returns, and reports, whether the lights of the solid alone are too many. */
static bool check_light_count(HdSceneChecker *checker, int per_edge, int count, int index) {
    const bool is_json = checker->naming == HD_NAMING_JSON;
    if (count <= HD_MAX_LIGHTS)
        return false;
    enter_item(checker, "solid", "solids", index);
    report(checker,
           "%s is %d, which makes %d lights on its %d edges, expected at most %d lights in "
           "the scene",
           is_json ? "edge_lights.per_edge" : "number of lights per edge", per_edge, count,
           count / per_edge, (int)HD_MAX_LIGHTS);
    leave(checker);
    return true;
}

static void check_all_lights(HdSceneChecker *checker, const HdScene *scene) {
    int lights = scene->light_count;
    bool is_reported = scene->light_count > HD_MAX_LIGHTS;
    for (int i = 0; i < checker->solid_count; i++) {
        if (!has_sound_lights(&scene->solids[i]))
            continue;
        const int count = hd_edge_light_count(&scene->solids[i]);
        lights += count;
        is_reported |= check_light_count(checker, scene->solids[i].lights.per_edge, count, i);
    }
    if (!is_reported && lights > HD_MAX_LIGHTS)
        report(checker, "number of lights, those on the edges included, is %d, expected at most %d",
               lights, (int)HD_MAX_LIGHTS);
}

/* The floor */

/* The cross product of the diagonals is normal to both, so two opposite corners are always equally
   high above it. */
static void check_floor_shape(HdSceneChecker *checker, const HdVec3 corner[4]) {
    static const double flatness = 1e-5; /* share of the longer diagonal */
    static const double sharpness = 1e-9;
    const HdVec3 first = hd_sub(corner[2], corner[0]);
    const HdVec3 second = hd_sub(corner[3], corner[1]);
    const double size = fmax(hd_length(first), hd_length(second));
    const HdVec3 normal = hd_cross(first, second);
    const double area = hd_length(normal);
    if (!(size >= HD_MIN_LENGTH && area > sharpness * size * size)) {
        hd_problem(checker->problems,
                   "%sits corners enclose no area or its sides cross, expected the corners of a "
                   "convex quadrilateral in their order around it",
                   checker->place);
        return;
    }
    const double height = fabs(hd_dot(hd_sub(corner[1], corner[0]), normal)) / area;
    if (height > flatness * size) {
        report(checker,
               "its diagonals pass each other %.6g apart, expected four corners in one plane "
               "(at most %.6g apart)",
               height, flatness * size);
        return;
    }
    for (int i = 0; i < 4; i++) {
        const HdVec3 before = hd_sub(corner[i], corner[(i + 3) % 4]);
        const HdVec3 after = hd_sub(corner[(i + 1) % 4], corner[i]);
        if (!(hd_dot(hd_cross(before, after), normal) / area > sharpness * size * size))
            report(checker,
                   "corner %d is not a convex corner, expected the corners of a convex "
                   "quadrilateral in their order around it",
                   i + 1);
    }
}

static void check_floor(HdSceneChecker *checker, const HdFloor *floor) {
    const int before = checker->problems->count;
    if (!floor->present || checker->is_floor_wrong)
        return;
    enter(checker, "floor", "floor");
    const HdObjectType *type = hd_field(&hd_scene_fields, "floor")->object;
    check_vectors(checker, hd_field(type, "corners"), floor->corners, 4);
    if (checker->problems->count == before)
        check_floor_shape(checker, floor->corners);
    checker->is_floor_wrong = checker->problems->count != before;
    hd_check_material(checker, &floor->material, false);
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

/* Mesh instances */

static void check_reach(HdSceneChecker *checker, const char *what, double value, double low) {
    const double high = 2.0 * HD_MAX_NUMBER;
    if (!(value >= low && value <= high))
        report(checker, "%s is %.15g, expected a number from %.15g to %.15g", what, value, low,
               high);
}

/* Checks that a mesh instance is no larger or smaller than valid solids and floors may be: at most
   the diagonal of a box of all coordinates, at least the side whose diagonal is the minimum. */
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
    const HdInstance *instance = &scene->instances[index];
    const HdMeshEntry entry = {.instance = *instance};
    enter_item(checker, "mesh", "meshes", index);
    const int before = checker->problems->count;
    check_int(checker, "number of its mesh", instance->mesh, 0, scene->mesh_count - 1);
    check_object(checker, "meshes", &entry);
    if (checker->problems->count == before)
        check_size(
            checker, &scene->meshes[instance->mesh],
            hd_vec3(fabs(instance->scale.x), fabs(instance->scale.y), fabs(instance->scale.z)));
    if (instance->has_material)
        hd_check_material(checker, &instance->material, true);
    leave(checker);
}

void hd_check_instances(HdSceneChecker *checker, const HdScene *scene) {
    check_int(checker, "number of meshes in their places", scene->instance_count, 0,
              HD_MAX_INSTANCES);
    for (int i = 0; i < scene->instance_count && i < HD_MAX_INSTANCES; i++)
        check_instance(checker, scene, i);
}

/* Overlaps */

/* Writes "solids[1] (cube)". */
static void name_solid(const HdSceneChecker *checker, const HdSolid *solid, int index,
                       char out[48]) {
    const char *kind = hd_solid_kind_name(solid->kind);
    if (checker->naming == HD_NAMING_JSON)
        snprintf(out, 48, "solids[%d] (%s)", index, kind);
    else
        snprintf(out, 48, "solid %d (%s)", index + 1, kind);
}

/* Checks two solids that both let rays pass; `refracts` tells of each whether it bends them. */
static void check_pair(HdSceneChecker *checker, const HdSolid *solids, const bool *refracts,
                       int first, int second) {
    char name[48], other_name[48];
    const HdSolid *a = &solids[first], *b = &solids[second];
    if (!(refracts[first] || refracts[second]) || hd_is_opaque(&a->face) || hd_is_opaque(&b->face))
        return;
    const double depth = hd_solid_overlap(a, b);
    const int subject = refracts[first] ? first : second;
    const int other = first + second - subject;
    if (depth <= 0.0 || hd_solid_holds(a, b) || hd_solid_holds(b, a))
        return;
    name_solid(checker, &solids[subject], subject, name);
    name_solid(checker, &solids[other], other, other_name);
    hd_problem(checker->problems,
               "%s: it refracts and overlaps %s, %.3g deep; move them apart, or one wholly into "
               "the other, clear of its faces",
               name, other_name, depth);
}

/* Returns the index of refraction around a solid. */
static double index_around(const HdSolid *solids, int count, int number) {
    const int around = hd_solid_around(solids, count, number);
    return around >= 0 ? solids[around].face.index_of_refraction : 1.0;
}

/* Checks that of two solids that overlap, and of which one refracts, one is opaque or within the
   other, if all positions and sizes are valid. */
static void check_overlaps(HdSceneChecker *checker, const HdSolid *solids) {
    bool refracts[HD_MAX_SOLIDS];
    for (int i = 0; i < checker->solid_count; i++)
        if (checker->is_solid_wrong[i])
            return;
    for (int i = 0; i < checker->solid_count; i++)
        refracts[i] =
            solids[i].face.index_of_refraction != index_around(solids, checker->solid_count, i);
    for (int i = 0; i < checker->solid_count; i++)
        for (int j = i + 1; j < checker->solid_count; j++)
            check_pair(checker, solids, refracts, i, j);
}

/* Missing parts (rim, edge lights, floor, texture) need no check. */
void hd_check_scene(HdSceneChecker *checker, const HdScene *scene) {
    check_camera(checker, scene);
    check_picture(checker, scene);
    check_lights(checker, scene);
    check_solids(checker, scene);
    check_all_lights(checker, scene);
    check_floor(checker, &scene->floor);
    hd_check_instances(checker, scene);
    enter(checker, "", "camera");
    check_camera_path(checker, scene);
    leave(checker);
    if (!checker->is_any_solid_wrong)
        check_overlaps(checker, scene->solids);
}

HdStatus hd_scene_validate(const HdScene *scene, HdError *error) {
    HdProblems problems = {0};
    HdSceneChecker checker = {.problems = &problems};
    hd_check_scene(&checker, scene);
    return hd_problems_first(&problems, error);
}
