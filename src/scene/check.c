/* SPDX-License-Identifier: MIT */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "scene/checker.h"
#include "scene/scene.h"

/* The kernels count positions in the picture in half samples, as floats. */
_Static_assert(2 * HD_MAX_IMAGE_SIDE * HD_MAX_SAMPLES_PER_SIDE < 1 << 24,
               "every half sample of the largest picture is an exact float");

/* What a sum such as 0.7 + 0.3 may exceed 1 by. */
static const double sum_tolerance = 1e-9;

static const char *const axes[3] = {" x", " y", " z"};
static const char *const channels[3] = {"'s red", "'s green", "'s blue"};

static void enter_rim(HdSceneChecker *checker, int index) {
    if (checker->naming == HD_NAMING_JSON)
        snprintf(checker->place, sizeof checker->place, "solids[%d].rim: ", index);
    else
        snprintf(checker->place, sizeof checker->place, "solid %d: rim ", index + 1);
}

static void add_value(HdSceneChecker *checker, const char *what, const char *part, double value,
                      const char *expected) {
    hd_problem(checker->problems, "%s%s%s is %.15g, expected %s", checker->place, what, part, value,
               expected);
}

/* NaN compares false with everything, so it is outside every range. */
static void check_part(HdSceneChecker *checker, const char *what, const char *part, double value,
                       double low, double high) {
    char expected[80];
    if (value >= low && value <= high)
        return;
    snprintf(expected, sizeof expected, "a number from %.15g to %.15g", low, high);
    add_value(checker, what, part, value, expected);
}

static void check_range(HdSceneChecker *checker, const char *what, double value, double low,
                        double high) {
    check_part(checker, what, "", value, low, high);
}

static void check_int(HdSceneChecker *checker, const char *what, int value, int low, int high) {
    if (value < low || value > high)
        hd_problem(checker->problems, "%s%s is %d, expected %d to %d", checker->place, what, value,
                   low, high);
}

static void check_vector(HdSceneChecker *checker, const char *what, HdVec3 value,
                         const char *const parts[3], double low, double high) {
    check_part(checker, what, parts[0], value.x, low, high);
    check_part(checker, what, parts[1], value.y, low, high);
    check_part(checker, what, parts[2], value.z, low, high);
}

static void check_number(HdSceneChecker *checker, const char *what, double value) {
    check_range(checker, what, value, -HD_MAX_NUMBER, HD_MAX_NUMBER);
}

static void check_position(HdSceneChecker *checker, const char *what, HdVec3 value) {
    check_vector(checker, what, value, axes, -HD_MAX_NUMBER, HD_MAX_NUMBER);
}

static void check_light(HdSceneChecker *checker, const char *what, HdVec3 value) {
    check_vector(checker, what, value, channels, 0.0, HD_MAX_NUMBER);
}

static void check_colour(HdSceneChecker *checker, const char *what, HdVec3 value) {
    check_vector(checker, what, value, channels, 0.0, 1.0);
}

/* "No falloff" is 0 itself: a distance that only a double can tell from 0 would become it. */
static void check_falloff(HdSceneChecker *checker, const HdFalloff *falloff) {
    if (falloff->distance != 0.0)
        check_range(checker, "falloff distance", falloff->distance, HD_MIN_LENGTH, HD_MAX_NUMBER);
    if (falloff->end != 0.0)
        check_range(checker, "falloff end", falloff->end, HD_MIN_LENGTH, HD_MAX_NUMBER);
    if (falloff->distance > 0.0 && falloff->end > 0.0)
        hd_problem(checker->problems,
                   "%sfalloff distance is %.15g and falloff end is %.15g, expected one of them",
                   checker->place, falloff->distance, falloff->end);
}

static void check_cylinder(HdSceneChecker *checker, const HdCylinderPath *path) {
    check_number(checker, "r0", path->r0);
    check_number(checker, "z0", path->z0);
    check_number(checker, "phi0", path->phi0);
    check_number(checker, "r amplitude", path->r_amplitude);
    check_number(checker, "z amplitude", path->z_amplitude);
    check_number(checker, "r frequency", path->r_frequency);
    check_number(checker, "z frequency", path->z_frequency);
    check_number(checker, "phi frequency", path->phi_frequency);
    check_number(checker, "r phase", path->r_phase);
    check_number(checker, "z phase", path->z_phase);
}

static void check_path(HdSceneChecker *checker, const HdPath *path) {
    if (path->is_fixed)
        check_position(checker, "point", path->point);
    else
        check_cylinder(checker, &path->cylinder);
}

/* More than 0, and at most the limit. */
static void check_positive(HdSceneChecker *checker, const char *what, double value, double most,
                           const char *unit) {
    char expected[80];
    if (value > 0.0 && value <= most)
        return;
    snprintf(expected, sizeof expected, "more than 0 and at most %.15g%s", most, unit);
    add_value(checker, what, "", value, expected);
}

static void check_camera(HdSceneChecker *checker, const HdScene *scene) {
    const int before = checker->problems->count;
    check_int(checker, "frame count", scene->frame_count, 1, HD_MAX_FRAMES);
    hd_checker_enter(checker, "", "camera");
    check_positive(checker, "field of view", scene->field_of_view_degrees, HD_MAX_FIELD_OF_VIEW,
                   " degrees");
    hd_checker_enter(checker, "eye", "camera.eye");
    check_path(checker, &scene->eye);
    hd_checker_enter(checker, "target", "camera.target");
    check_path(checker, &scene->target);
    hd_checker_leave(checker);
    checker->camera_is_sound = checker->problems->count == before;
}

static void check_picture(HdSceneChecker *checker, const HdScene *scene) {
    check_int(checker, "width", scene->width, 1, HD_MAX_IMAGE_SIDE);
    check_int(checker, "height", scene->height, 1, HD_MAX_IMAGE_SIDE);
    if ((int64_t)scene->width * scene->height > HD_MAX_IMAGE_PIXELS)
        hd_problem(checker->problems, "%s%d x %d pixels are too many, expected at most %d in all",
                   checker->place, scene->width, scene->height, (int)HD_MAX_IMAGE_PIXELS);
    check_int(checker, "samples per side", scene->samples_per_side, 1, HD_MAX_SAMPLES_PER_SIDE);
    check_int(checker, "depth", scene->depth, 0, HD_MAX_DEPTH);
    if (!(scene->cutoff >= 0.0 && scene->cutoff < 1.0))
        add_value(checker, "cutoff", "", scene->cutoff, "at least 0 and less than 1");
    if (!(scene->max_error == 0.0 ||
          (scene->max_error >= HD_LEAST_ERROR && scene->max_error <= HD_MAX_ERROR)))
        add_value(checker, "max_error", "", scene->max_error, "0, or a number from 0.001 to 255");
    check_positive(checker, "exposure", scene->exposure, HD_MAX_EXPOSURE, "");
    check_light(checker, "background", scene->background);
}

/* `side` is "" or "inner ". */
static void check_side(HdSceneChecker *checker, const char *side, double reflection,
                       double transmission) {
    const int before = checker->problems->count;
    const double sum = reflection + transmission;
    char what[48];
    snprintf(what, sizeof what, "%sreflection", side);
    check_range(checker, what, reflection, 0.0, 1.0);
    snprintf(what, sizeof what, "%stransmission", side);
    check_range(checker, what, transmission, 0.0, 1.0);
    snprintf(what, sizeof what, "%sreflection + transmission", side);
    if (checker->problems->count == before && sum > 1.0 + sum_tolerance)
        add_value(checker, what, "", sum, "at most 1");
}

static void check_shares(HdSceneChecker *checker, const HdMaterial *material) {
    check_side(checker, "", material->reflection, material->transmission);
    if (material->has_inner_side)
        check_side(checker, "inner ", material->inner_reflection, material->inner_transmission);
}

void hd_material_check_shares(const HdMaterial *material, const char *place, HdProblems *problems) {
    HdSceneChecker checker = {.problems = problems};
    snprintf(checker.place, sizeof checker.place, "%s", place);
    check_shares(&checker, material);
}

static void check_material(HdSceneChecker *checker, const HdMaterial *material) {
    check_colour(checker, "colour", material->colour);
    check_colour(checker, "mirror tint", material->mirror_tint);
    check_range(checker, "ambient", material->ambient, 0.0, HD_MAX_COEFFICIENT);
    check_range(checker, "diffuse", material->diffuse, 0.0, HD_MAX_COEFFICIENT);
    check_range(checker, "specular", material->specular, 0.0, HD_MAX_COEFFICIENT);
    check_int(checker, "shininess", material->shininess, 1, HD_MAX_SHININESS);
    check_shares(checker, material);
}

static void check_no_refraction(HdSceneChecker *checker, const HdMaterial *material) {
    if (material->index_of_refraction != 1.0)
        add_value(checker, "index of refraction", "", material->index_of_refraction,
                  "1, since only a solid's faces can refract");
}

static void check_opaque(HdSceneChecker *checker, const char *what, double transmission) {
    if (transmission > 0.0)
        add_value(checker, what, "", transmission, "0, since rims are opaque");
}

static void check_rim_material(HdSceneChecker *checker, const HdMaterial *rim) {
    check_material(checker, rim);
    check_no_refraction(checker, rim);
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

static void check_edge_colours(HdSceneChecker *checker, const HdEdgeLights *lights) {
    const int before = checker->problems->count;
    check_int(checker, "number of edge lights' colours", lights->colour_count, 1,
              HD_MAX_EDGE_COLOURS);
    if (checker->problems->count != before)
        return;
    for (int i = 0; i < lights->colour_count; i++) {
        char what[48];
        snprintf(what, sizeof what, "edge lights' colour %d", i + 1);
        check_colour(checker, what, lights->colours[i]);
    }
}

static void check_edge_lights(HdSceneChecker *checker, const HdEdgeLights *lights) {
    check_int(checker, "number of lights per edge", lights->per_edge, 0, HD_MAX_LIGHTS);
    if (lights->per_edge == 0)
        return;
    check_edge_colours(checker, lights);
    check_range(checker, "edge lights' intensity", lights->intensity, 0.0, HD_MAX_NUMBER);
    check_falloff(checker, &lights->falloff);
    check_range(checker, "edge lights' disc radius", lights->disc_radius, 0.0, HD_MAX_NUMBER);
    check_range(checker, "edge lights' disc radiance", lights->disc_radiance, 0.0, HD_MAX_NUMBER);
}

static void check_solid_shape(HdSceneChecker *checker, const HdSolid *solid) {
    check_int(checker, "kind", (int)solid->kind, 0, HD_SOLID_KIND_COUNT - 1);
    check_position(checker, "centre", solid->centre);
    check_range(checker, "radius", solid->circumradius, HD_MIN_LENGTH, HD_MAX_NUMBER);
    check_vector(checker, "rotation", solid->rotation_degrees, axes, -HD_MAX_ROTATION,
                 HD_MAX_ROTATION);
}

static void check_solid(HdSceneChecker *checker, const HdSolid *solid, int index) {
    const int before = checker->problems->count;
    hd_checker_enter_item(checker, "solid", "solids", index);
    check_solid_shape(checker, solid);
    checker->solid_is_sound[index] = checker->problems->count == before;
    check_material(checker, &solid->face);
    check_range(checker, "index of refraction", solid->face.index_of_refraction,
                HD_MIN_INDEX_OF_REFRACTION, HD_MAX_INDEX_OF_REFRACTION);
    if (checker->solid_is_sound[index]) {
        HdPlatonic platonic;
        hd_platonic(solid->kind, &platonic);
        check_rim_width(checker, solid, &platonic);
    }
    if (solid->rim_width > 0.0) {
        enter_rim(checker, index);
        check_rim_material(checker, &solid->rim);
        hd_checker_enter_item(checker, "solid", "solids", index);
    }
    check_edge_lights(checker, &solid->lights);
    hd_checker_leave(checker);
}

static void check_point_light(HdSceneChecker *checker, const HdLight *light, int index) {
    hd_checker_enter_item(checker, "light", "lights", index);
    check_position(checker, "position", light->position);
    check_light(checker, "intensity", light->intensity);
    check_falloff(checker, &light->falloff);
    hd_checker_leave(checker);
}

static void check_lights(HdSceneChecker *checker, const HdScene *scene) {
    check_int(checker, "number of lights", scene->light_count, 0, HD_MAX_LIGHTS);
    if (scene->light_count > HD_MAX_LIGHTS)
        return;
    for (int i = 0; i < scene->light_count; i++)
        check_point_light(checker, &scene->lights[i], i);
}

static void check_solids(HdSceneChecker *checker, const HdScene *scene) {
    check_int(checker, "number of solids", scene->solid_count, 0, HD_MAX_SOLIDS);
    if (scene->solid_count > HD_MAX_SOLIDS)
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
    hd_checker_enter_item(checker, "solid", "solids", index);
    hd_problem(checker->problems,
               "%s%s is %d, which makes %d lights on its %d edges, expected at most %d lights in "
               "the scene",
               checker->place, is_json ? "edge_lights.per_edge" : "number of lights per edge",
               per_edge, count, count / per_edge, (int)HD_MAX_LIGHTS);
    hd_checker_leave(checker);
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
        hd_problem(checker->problems,
                   "%snumber of lights, those on the edges included, is %d, expected at most %d",
                   checker->place, lights, (int)HD_MAX_LIGHTS);
}

static void check_floor(HdSceneChecker *checker, const HdFloor *floor) {
    static const char *const names[4] = {"corner 1", "corner 2", "corner 3", "corner 4"};
    const int before = checker->problems->count;
    if (!floor->present)
        return;
    hd_checker_enter(checker, "floor", "floor");
    for (int i = 0; i < 4; i++)
        check_position(checker, names[i], floor->corners[i]);
    if (checker->problems->count == before)
        hd_check_floor_shape(checker, floor->corners);
    checker->floor_is_sound = checker->problems->count == before;
    check_material(checker, &floor->material);
    check_no_refraction(checker, &floor->material);
    if (floor->material.has_inner_side)
        hd_problem(
            checker->problems,
            "%sits material has an inner side, expected none: a floor is alike on both sides",
            checker->place);
    if (floor->texture.width != 0) {
        check_int(checker, "texture width", floor->texture.width, 1, HD_MAX_TEXTURE_SIDE);
        check_int(checker, "texture height", floor->texture.height, 1, HD_MAX_TEXTURE_SIDE);
    }
    hd_checker_leave(checker);
}

/* As large or small as the triangles of any valid solid or floor may be: from corner to corner of a
   box that fits all coordinates, and from a side that the least length is the diagonal of. */
static void check_size(HdSceneChecker *checker, const HdMesh *mesh, HdVec3 scale) {
    const HdVec3 sides = hd_sub(mesh->upper, mesh->lower);
    const HdVec3 far = hd_vec3(fmax(fabs(mesh->lower.x), fabs(mesh->upper.x)) * scale.x,
                               fmax(fabs(mesh->lower.y), fabs(mesh->upper.y)) * scale.y,
                               fmax(fabs(mesh->lower.z), fabs(mesh->upper.z)) * scale.z);
    check_range(checker, "longest side of its mesh, scaled,",
                fmax(sides.x * scale.x, fmax(sides.y * scale.y, sides.z * scale.z)),
                HD_MIN_LENGTH / 2.0, 2.0 * HD_MAX_NUMBER);
    check_range(checker, "farthest coordinate of its mesh, scaled,",
                fmax(far.x, fmax(far.y, far.z)), 0.0, 2.0 * HD_MAX_NUMBER);
}

static void check_instance(HdSceneChecker *checker, const HdScene *scene, int index) {
    const HdInstance *instance = &scene->instances[index];
    hd_checker_enter_item(checker, "mesh", "meshes", index);
    const int before = checker->problems->count;
    check_int(checker, "number of its mesh", instance->mesh, 0, scene->mesh_count - 1);
    check_position(checker, "position", instance->position);
    check_vector(checker, "rotation", instance->rotation_degrees, axes, -HD_MAX_ROTATION,
                 HD_MAX_ROTATION);
    check_vector(checker, "scale", instance->scale, axes, HD_MIN_LENGTH, HD_MAX_NUMBER);
    if (checker->problems->count == before)
        check_size(checker, &scene->meshes[instance->mesh], instance->scale);
    if (instance->has_material) {
        check_material(checker, &instance->material);
        check_range(checker, "index of refraction", instance->material.index_of_refraction,
                    HD_MIN_INDEX_OF_REFRACTION, HD_MAX_INDEX_OF_REFRACTION);
    }
    hd_checker_leave(checker);
}

static void check_instances(HdSceneChecker *checker, const HdScene *scene) {
    check_int(checker, "number of meshes in their places", scene->instance_count, 0,
              HD_MAX_INSTANCES);
    for (int i = 0; i < scene->instance_count && i < HD_MAX_INSTANCES; i++)
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
    hd_check_flight(&checker, scene);
    hd_check_overlaps(&checker, scene);
}

HdStatus hd_scene_validate(const HdScene *scene, HdError *error) {
    HdProblems problems = {0};
    hd_scene_check(scene, HD_NAMING_PROSE, &problems);
    if (problems.count == 0)
        return HD_OK;
    return hd_fail(error, HD_BAD_INPUT, "%.*s", (int)strcspn(problems.text, "\n"), problems.text);
}
