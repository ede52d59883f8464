/* SPDX-License-Identifier: MIT */
#include "scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image.h"

/* The kernels count positions in the picture in half samples, as floats. */
_Static_assert(2 * HD_MAX_IMAGE_SIDE * HD_MAX_SAMPLES_PER_SIDE < 1 << 24,
               "every half sample of the largest picture is an exact float");

/* What a sum such as 0.7 + 0.3 may exceed 1 by. */
static const double sum_tolerance = 1e-9;

/* The first failure; later checks pass through. It lets a list of checks read as a list. */
typedef struct Checker {
    HdError *error;
    HdStatus status;
    char where[48]; /* "solid 2: ", or nothing */
} Checker;

static const char *const axes[3] = {" x", " y", " z"};
static const char *const channels[3] = {"'s red", "'s green", "'s blue"};

static void fail_value(Checker *checker, const char *what, const char *part, double value,
                       const char *expected) {
    checker->status = hd_fail(checker->error, HD_BAD_INPUT, "%s%s%s is %.15g, expected %s",
                              checker->where, what, part, value, expected);
}

/* NaN compares false with everything, so it is outside every range. */
static void check_part(Checker *checker, const char *what, const char *part, double value,
                       double low, double high) {
    if (checker->status != HD_OK || (value >= low && value <= high))
        return;
    char expected[80];
    snprintf(expected, sizeof expected, "a number from %.15g to %.15g", low, high);
    fail_value(checker, what, part, value, expected);
}

static void check_range(Checker *checker, const char *what, double value, double low, double high) {
    check_part(checker, what, "", value, low, high);
}

static void check_int(Checker *checker, const char *what, int value, int low, int high) {
    if (checker->status != HD_OK || (value >= low && value <= high))
        return;
    checker->status = hd_fail(checker->error, HD_BAD_INPUT, "%s%s is %d, expected %d to %d",
                              checker->where, what, value, low, high);
}

static void check_vector(Checker *checker, const char *what, HdVec3 value,
                         const char *const parts[3], double low, double high) {
    check_part(checker, what, parts[0], value.x, low, high);
    check_part(checker, what, parts[1], value.y, low, high);
    check_part(checker, what, parts[2], value.z, low, high);
}

static void check_number(Checker *checker, const char *what, double value) {
    check_range(checker, what, value, -HD_MAX_NUMBER, HD_MAX_NUMBER);
}

static void check_position(Checker *checker, const char *what, HdVec3 value) {
    check_vector(checker, what, value, axes, -HD_MAX_NUMBER, HD_MAX_NUMBER);
}

static void check_light(Checker *checker, const char *what, HdVec3 value) {
    check_vector(checker, what, value, channels, 0.0, HD_MAX_NUMBER);
}

/* "No falloff" is 0 itself: a distance that only a double can tell from 0 would become it. */
static void check_falloff(Checker *checker, double distance) {
    if (distance != 0.0)
        check_range(checker, "falloff distance", distance, HD_MIN_LENGTH, HD_MAX_NUMBER);
}

static void check_path(Checker *checker, const char *name, const HdCylinderPath *path) {
    snprintf(checker->where, sizeof checker->where, "%s: ", name);
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
    checker->where[0] = '\0';
}

static void check_picture(Checker *checker, const HdScene *scene) {
    check_int(checker, "frame count", scene->frame_count, 1, HD_MAX_FRAMES);
    check_int(checker, "width", scene->width, 1, HD_MAX_IMAGE_SIDE);
    check_int(checker, "height", scene->height, 1, HD_MAX_IMAGE_SIDE);
    check_int(checker, "samples per side", scene->samples_per_side, 1, HD_MAX_SAMPLES_PER_SIDE);
    check_int(checker, "depth", scene->depth, 0, HD_MAX_DEPTH);
    const double view = scene->field_of_view_degrees;
    if (checker->status == HD_OK && !(view > 0.0 && view <= HD_MAX_FIELD_OF_VIEW))
        fail_value(checker, "field of view", "", view, "more than 0 and at most 179 degrees");
    if (checker->status == HD_OK && !(scene->cutoff >= 0.0 && scene->cutoff < 1.0))
        fail_value(checker, "cutoff", "", scene->cutoff, "at least 0 and less than 1");
    if (checker->status == HD_OK && !(scene->exposure > 0.0 && scene->exposure <= HD_MAX_EXPOSURE))
        fail_value(checker, "exposure", "", scene->exposure, "more than 0 and at most 1000000");
    check_light(checker, "background", scene->background);
}

/* `part` is "", "rim " and the like. */
static void check_material(Checker *checker, const char *part, const HdMaterial *material) {
    char outer[sizeof checker->where];
    memcpy(outer, checker->where, sizeof outer);
    const size_t length = strlen(outer);
    snprintf(checker->where + length, sizeof checker->where - length, "%s", part);
    check_vector(checker, "colour", material->colour, channels, 0.0, 1.0);
    check_vector(checker, "mirror tint", material->mirror_tint, channels, 0.0, 1.0);
    check_range(checker, "ambient", material->ambient, 0.0, HD_MAX_COEFFICIENT);
    check_range(checker, "diffuse", material->diffuse, 0.0, HD_MAX_COEFFICIENT);
    check_range(checker, "specular", material->specular, 0.0, HD_MAX_COEFFICIENT);
    check_int(checker, "shininess", material->shininess, 1, HD_MAX_SHININESS);
    check_range(checker, "reflection", material->reflection, 0.0, 1.0);
    check_range(checker, "transmission", material->transmission, 0.0, 1.0);
    const double sum = material->reflection + material->transmission;
    if (checker->status == HD_OK && !(sum <= 1.0 + sum_tolerance))
        fail_value(checker, "reflection + transmission", "", sum, "at most 1");
    memcpy(checker->where, outer, sizeof outer);
}

/* The radius of the circle inscribed in a face of the solid with circumradius 1. */
static double face_inradius(const HdPlatonic *platonic) {
    const double half_edge = platonic->edge_length / 2.0;
    return sqrt(1.0 - half_edge * half_edge - platonic->inradius * platonic->inradius);
}

static void check_rim(Checker *checker, const HdSolid *solid, const HdPlatonic *platonic) {
    const double limit = solid->circumradius * face_inradius(platonic);
    if (checker->status == HD_OK && !(solid->rim_width >= 0.0 && solid->rim_width < limit)) {
        char expected[96];
        snprintf(expected, sizeof expected,
                 "at least 0 and less than the radius of the circle in a face, %.6g", limit);
        fail_value(checker, "rim width", "", solid->rim_width, expected);
    }
    if (solid->rim_width > 0.0)
        check_material(checker, "rim ", &solid->rim);
    if (checker->status == HD_OK && solid->rim_width > 0.0 && solid->rim.transmission > 0.0)
        fail_value(checker, "rim transmission", "", solid->rim.transmission,
                   "0, since rims are opaque");
}

static void check_edge_lights(Checker *checker, const HdEdgeLights *lights) {
    check_int(checker, "number of lights per edge", lights->per_edge, 0, HD_MAX_LIGHTS);
    check_range(checker, "edge lights' intensity", lights->intensity, 0.0, HD_MAX_NUMBER);
    check_falloff(checker, lights->falloff.distance);
    check_range(checker, "edge lights' disc radius", lights->disc_radius, 0.0, HD_MAX_NUMBER);
    check_range(checker, "edge lights' disc radiance", lights->disc_radiance, 0.0, HD_MAX_NUMBER);
}

/* Returns the number of its edge lights. */
static int64_t check_solid(Checker *checker, const HdSolid *solid, int number) {
    HdPlatonic platonic;
    snprintf(checker->where, sizeof checker->where, "solid %d: ", number);
    check_int(checker, "kind", (int)solid->kind, 0, HD_SOLID_KIND_COUNT - 1);
    if (checker->status != HD_OK)
        return 0;
    hd_platonic(solid->kind, &platonic);
    check_position(checker, "centre", solid->centre);
    check_range(checker, "radius", solid->circumradius, HD_MIN_LENGTH, HD_MAX_NUMBER);
    check_material(checker, "", &solid->face);
    check_rim(checker, solid, &platonic);
    check_edge_lights(checker, &solid->lights);
    checker->where[0] = '\0';
    return (int64_t)platonic.edge_count * solid->lights.per_edge;
}

static void check_point_lights(Checker *checker, const HdScene *scene) {
    check_int(checker, "number of lights", scene->light_count, 0, HD_MAX_LIGHTS);
    for (int i = 0; checker->status == HD_OK && i < scene->light_count; i++) {
        snprintf(checker->where, sizeof checker->where, "light %d: ", i + 1);
        check_position(checker, "position", scene->lights[i].position);
        check_light(checker, "intensity", scene->lights[i].intensity);
        check_falloff(checker, scene->lights[i].falloff.distance);
        checker->where[0] = '\0';
    }
}

static void check_solids_and_lights(Checker *checker, const HdScene *scene) {
    check_int(checker, "number of solids", scene->solid_count, 0, HD_MAX_SOLIDS);
    check_point_lights(checker, scene);
    int64_t lights = scene->light_count;
    for (int i = 0; checker->status == HD_OK && i < scene->solid_count; i++)
        lights += check_solid(checker, &scene->solids[i], i + 1);
    if (checker->status == HD_OK && lights > HD_MAX_LIGHTS)
        fail_value(checker, "number of lights, those on the edges included,", "", (double)lights,
                   "at most 100000");
}

/* Convex and flat, with room inside. The cross product of the diagonals is normal to both, so two
   opposite corners are always equally high above it. */
static void check_floor_shape(Checker *checker, const HdVec3 corner[4]) {
    static const double flatness = 1e-5; /* of the longer diagonal */
    static const double sharpness = 1e-9;
    const HdVec3 first = hd_sub(corner[2], corner[0]);
    const HdVec3 second = hd_sub(corner[3], corner[1]);
    const double size = fmax(hd_length(first), hd_length(second));
    const HdVec3 normal = hd_cross(first, second);
    const double area = hd_length(normal);
    if (!(size >= HD_MIN_LENGTH && area > sharpness * size * size)) {
        checker->status = hd_fail(checker->error, HD_BAD_INPUT,
                                  "floor: its corners enclose no area or its sides cross, expected "
                                  "the corners of a convex quadrilateral in their order around it");
        return;
    }
    const double height = fabs(hd_dot(hd_sub(corner[1], corner[0]), normal)) / area;
    if (height > flatness * size) {
        checker->status =
            hd_fail(checker->error, HD_BAD_INPUT,
                    "floor: its diagonals pass each other %.6g apart, expected four corners in one "
                    "plane (at most %.6g apart)",
                    height, flatness * size);
        return;
    }
    for (int i = 0; i < 4 && checker->status == HD_OK; i++) {
        const HdVec3 before = hd_sub(corner[i], corner[(i + 3) % 4]);
        const HdVec3 after = hd_sub(corner[(i + 1) % 4], corner[i]);
        if (!(hd_dot(hd_cross(before, after), normal) / area > sharpness * size * size))
            checker->status =
                hd_fail(checker->error, HD_BAD_INPUT,
                        "floor: corner %d is not a convex corner, expected the corners of a convex "
                        "quadrilateral in their order around it",
                        i + 1);
    }
}

static void check_floor(Checker *checker, const HdFloor *floor) {
    static const char *const names[4] = {"corner 1", "corner 2", "corner 3", "corner 4"};
    if (!floor->present || checker->status != HD_OK)
        return;
    snprintf(checker->where, sizeof checker->where, "floor: ");
    for (int i = 0; i < 4; i++)
        check_position(checker, names[i], floor->corners[i]);
    check_material(checker, "", &floor->material);
    if (floor->texture.width != 0) {
        check_int(checker, "texture width", floor->texture.width, 1, HD_MAX_TEXTURE_SIDE);
        check_int(checker, "texture height", floor->texture.height, 1, HD_MAX_TEXTURE_SIDE);
    }
    if (checker->status == HD_OK)
        check_floor_shape(checker, floor->corners);
    checker->where[0] = '\0';
}

/* What is not there (no rim, no floor, no texture) is not checked. */
HdStatus hd_scene_validate(const HdScene *scene, HdError *error) {
    Checker checker = {.error = error, .status = HD_OK, .where = ""};
    check_picture(&checker, scene);
    check_path(&checker, "eye", &scene->eye.cylinder);
    check_path(&checker, "target", &scene->target.cylinder);
    check_solids_and_lights(&checker, scene);
    check_floor(&checker, &scene->floor);
    return checker.status;
}

void hd_scene_check(const HdScene *scene, HdNaming naming, HdProblems *problems) {
    static HdError error;
    (void)naming;
    if (hd_scene_validate(scene, &error) != HD_OK)
        hd_problem(problems, "%s", error.message);
}

void hd_scene_free(HdScene *scene) {
    free(scene->solids);
    free(scene->lights);
    hd_texture_clear(&scene->floor.texture);
    *scene = (HdScene){0};
}
