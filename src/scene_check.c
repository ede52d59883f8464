/* SPDX-License-Identifier: MIT */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "camera.h"
#include "scene.h"
#include "solid_overlap.h"

/* The kernels count positions in the picture in half samples, as floats. */
_Static_assert(2 * HD_MAX_IMAGE_SIDE * HD_MAX_SAMPLES_PER_SIDE < 1 << 24,
               "every half sample of the largest picture is an exact float");

/* What a sum such as 0.7 + 0.3 may exceed 1 by. */
static const double sum_tolerance = 1e-9;

/* A check that builds on other values is left out where these are wrong, so that each mistake is
   told once. */
typedef struct Checker {
    HdProblems *problems;
    HdNaming naming;
    char place[48]; /* "solid 2: ", or nothing */
    bool camera_is_sound;
    bool floor_is_sound; /* its shape and place are; also false where there is none */
    int solid_count;     /* 0 where the scene's is wrong */
    bool solid_is_sound[HD_MAX_SOLIDS]; /* its shape and place are */
} Checker;

static const char *const axes[3] = {" x", " y", " z"};
static const char *const channels[3] = {"'s red", "'s green", "'s blue"};

static void enter(Checker *checker, const char *prose, const char *json) {
    const char *name = checker->naming == HD_NAMING_JSON ? json : prose;
    snprintf(checker->place, sizeof checker->place, "%s%s", name, name[0] != '\0' ? ": " : "");
}

static void leave(Checker *checker) {
    checker->place[0] = '\0';
}

static void enter_item(Checker *checker, const char *prose, const char *json, int index) {
    if (checker->naming == HD_NAMING_JSON)
        snprintf(checker->place, sizeof checker->place, "%s[%d]: ", json, index);
    else
        snprintf(checker->place, sizeof checker->place, "%s %d: ", prose, index + 1);
}

static void enter_rim(Checker *checker, int index) {
    if (checker->naming == HD_NAMING_JSON)
        snprintf(checker->place, sizeof checker->place, "solids[%d].rim: ", index);
    else
        snprintf(checker->place, sizeof checker->place, "solid %d: rim ", index + 1);
}

static void add_value(Checker *checker, const char *what, const char *part, double value,
                      const char *expected) {
    hd_problem(checker->problems, "%s%s%s is %.15g, expected %s", checker->place, what, part, value,
               expected);
}

/* NaN compares false with everything, so it is outside every range. */
static void check_part(Checker *checker, const char *what, const char *part, double value,
                       double low, double high) {
    char expected[80];
    if (value >= low && value <= high)
        return;
    snprintf(expected, sizeof expected, "a number from %.15g to %.15g", low, high);
    add_value(checker, what, part, value, expected);
}

static void check_range(Checker *checker, const char *what, double value, double low, double high) {
    check_part(checker, what, "", value, low, high);
}

static void check_int(Checker *checker, const char *what, int value, int low, int high) {
    if (value < low || value > high)
        hd_problem(checker->problems, "%s%s is %d, expected %d to %d", checker->place, what, value,
                   low, high);
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

static void check_colour(Checker *checker, const char *what, HdVec3 value) {
    check_vector(checker, what, value, channels, 0.0, 1.0);
}

/* "No falloff" is 0 itself: a distance that only a double can tell from 0 would become it. */
static void check_falloff(Checker *checker, const HdFalloff *falloff) {
    if (falloff->distance != 0.0)
        check_range(checker, "falloff distance", falloff->distance, HD_MIN_LENGTH, HD_MAX_NUMBER);
    if (falloff->end != 0.0)
        check_range(checker, "falloff end", falloff->end, HD_MIN_LENGTH, HD_MAX_NUMBER);
    if (falloff->distance > 0.0 && falloff->end > 0.0)
        hd_problem(checker->problems,
                   "%sfalloff distance is %.15g and falloff end is %.15g, expected one of them",
                   checker->place, falloff->distance, falloff->end);
}

static void check_cylinder(Checker *checker, const HdCylinderPath *path) {
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

static void check_path(Checker *checker, const HdPath *path) {
    if (path->is_fixed)
        check_position(checker, "point", path->point);
    else
        check_cylinder(checker, &path->cylinder);
}

/* More than 0, and at most the limit. */
static void check_positive(Checker *checker, const char *what, double value, double most,
                           const char *unit) {
    char expected[80];
    if (value > 0.0 && value <= most)
        return;
    snprintf(expected, sizeof expected, "more than 0 and at most %.15g%s", most, unit);
    add_value(checker, what, "", value, expected);
}

static void check_camera(Checker *checker, const HdScene *scene) {
    const int before = checker->problems->count;
    check_int(checker, "frame count", scene->frame_count, 1, HD_MAX_FRAMES);
    enter(checker, "", "camera");
    check_positive(checker, "field of view", scene->field_of_view_degrees, HD_MAX_FIELD_OF_VIEW,
                   " degrees");
    enter(checker, "eye", "camera.eye");
    check_path(checker, &scene->eye);
    enter(checker, "target", "camera.target");
    check_path(checker, &scene->target);
    leave(checker);
    checker->camera_is_sound = checker->problems->count == before;
}

static void check_picture(Checker *checker, const HdScene *scene) {
    check_int(checker, "width", scene->width, 1, HD_MAX_IMAGE_SIDE);
    check_int(checker, "height", scene->height, 1, HD_MAX_IMAGE_SIDE);
    if ((int64_t)scene->width * scene->height > HD_MAX_IMAGE_PIXELS)
        hd_problem(checker->problems, "%s%d x %d pixels are too many, expected at most %d in all",
                   checker->place, scene->width, scene->height, (int)HD_MAX_IMAGE_PIXELS);
    check_int(checker, "samples per side", scene->samples_per_side, 1, HD_MAX_SAMPLES_PER_SIDE);
    check_int(checker, "depth", scene->depth, 0, HD_MAX_DEPTH);
    if (!(scene->cutoff >= 0.0 && scene->cutoff < 1.0))
        add_value(checker, "cutoff", "", scene->cutoff, "at least 0 and less than 1");
    check_positive(checker, "exposure", scene->exposure, HD_MAX_EXPOSURE, "");
    check_light(checker, "background", scene->background);
}

/* `side` is "" or "inner ". */
static void check_shares(Checker *checker, const char *side, double reflection,
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

static void check_material(Checker *checker, const HdMaterial *material) {
    check_colour(checker, "colour", material->colour);
    check_colour(checker, "mirror tint", material->mirror_tint);
    check_range(checker, "ambient", material->ambient, 0.0, HD_MAX_COEFFICIENT);
    check_range(checker, "diffuse", material->diffuse, 0.0, HD_MAX_COEFFICIENT);
    check_range(checker, "specular", material->specular, 0.0, HD_MAX_COEFFICIENT);
    check_int(checker, "shininess", material->shininess, 1, HD_MAX_SHININESS);
    check_shares(checker, "", material->reflection, material->transmission);
    if (material->has_inner_side)
        check_shares(checker, "inner ", material->inner_reflection, material->inner_transmission);
}

static void check_no_refraction(Checker *checker, const HdMaterial *material) {
    if (material->index_of_refraction != 1.0)
        add_value(checker, "index of refraction", "", material->index_of_refraction,
                  "1, since only a solid's faces can refract");
}

static void check_opaque(Checker *checker, const char *what, double transmission) {
    if (transmission > 0.0)
        add_value(checker, what, "", transmission, "0, since rims are opaque");
}

static void check_rim_material(Checker *checker, const HdMaterial *rim) {
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

static void check_rim_width(Checker *checker, const HdSolid *solid, const HdPlatonic *platonic) {
    const double limit = solid->circumradius * face_inradius(platonic);
    char expected[96];
    if (solid->rim_width >= 0.0 && solid->rim_width < limit)
        return;
    snprintf(expected, sizeof expected,
             "at least 0 and less than the radius of the circle in a face, %.6g", limit);
    add_value(checker, "rim width", "", solid->rim_width, expected);
}

static void check_edge_colours(Checker *checker, const HdEdgeLights *lights) {
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

static void check_edge_lights(Checker *checker, const HdEdgeLights *lights) {
    check_int(checker, "number of lights per edge", lights->per_edge, 0, HD_MAX_LIGHTS);
    if (lights->per_edge == 0)
        return;
    check_edge_colours(checker, lights);
    check_range(checker, "edge lights' intensity", lights->intensity, 0.0, HD_MAX_NUMBER);
    check_falloff(checker, &lights->falloff);
    check_range(checker, "edge lights' disc radius", lights->disc_radius, 0.0, HD_MAX_NUMBER);
    check_range(checker, "edge lights' disc radiance", lights->disc_radiance, 0.0, HD_MAX_NUMBER);
}

static void check_solid_shape(Checker *checker, const HdSolid *solid) {
    check_int(checker, "kind", (int)solid->kind, 0, HD_SOLID_KIND_COUNT - 1);
    check_position(checker, "centre", solid->centre);
    check_range(checker, "radius", solid->circumradius, HD_MIN_LENGTH, HD_MAX_NUMBER);
    check_vector(checker, "rotation", solid->rotation_degrees, axes, -HD_MAX_ROTATION,
                 HD_MAX_ROTATION);
}

static void check_solid(Checker *checker, const HdSolid *solid, int index) {
    const int before = checker->problems->count;
    enter_item(checker, "solid", "solids", index);
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
        enter_item(checker, "solid", "solids", index);
    }
    check_edge_lights(checker, &solid->lights);
    leave(checker);
}

static void check_point_light(Checker *checker, const HdLight *light, int index) {
    enter_item(checker, "light", "lights", index);
    check_position(checker, "position", light->position);
    check_light(checker, "intensity", light->intensity);
    check_falloff(checker, &light->falloff);
    leave(checker);
}

static void check_lights(Checker *checker, const HdScene *scene) {
    check_int(checker, "number of lights", scene->light_count, 0, HD_MAX_LIGHTS);
    if (scene->light_count > HD_MAX_LIGHTS)
        return;
    for (int i = 0; i < scene->light_count; i++)
        check_point_light(checker, &scene->lights[i], i);
}

static void check_solids(Checker *checker, const HdScene *scene) {
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

static void check_all_lights(Checker *checker, const HdScene *scene) {
    int lights = scene->light_count;
    for (int i = 0; i < checker->solid_count; i++)
        if (checker->solid_is_sound[i] && has_sound_number(&scene->solids[i].lights))
            lights += hd_edge_light_count(&scene->solids[i]);
    if (scene->light_count <= HD_MAX_LIGHTS && lights > HD_MAX_LIGHTS)
        hd_problem(checker->problems,
                   "%snumber of lights, those on the edges included, is %d, expected at most %d",
                   checker->place, lights, (int)HD_MAX_LIGHTS);
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
        hd_problem(checker->problems,
                   "%sits corners enclose no area or its sides cross, expected the corners of a "
                   "convex quadrilateral in their order around it",
                   checker->place);
        return;
    }
    const double height = fabs(hd_dot(hd_sub(corner[1], corner[0]), normal)) / area;
    if (height > flatness * size) {
        hd_problem(checker->problems,
                   "%sits diagonals pass each other %.6g apart, expected four corners in one plane "
                   "(at most %.6g apart)",
                   checker->place, height, flatness * size);
        return;
    }
    for (int i = 0; i < 4; i++) {
        const HdVec3 before = hd_sub(corner[i], corner[(i + 3) % 4]);
        const HdVec3 after = hd_sub(corner[(i + 1) % 4], corner[i]);
        if (!(hd_dot(hd_cross(before, after), normal) / area > sharpness * size * size))
            hd_problem(checker->problems,
                       "%scorner %d is not a convex corner, expected the corners of a convex "
                       "quadrilateral in their order around it",
                       checker->place, i + 1);
    }
}

static void check_floor(Checker *checker, const HdFloor *floor) {
    static const char *const names[4] = {"corner 1", "corner 2", "corner 3", "corner 4"};
    const int before = checker->problems->count;
    if (!floor->present)
        return;
    enter(checker, "floor", "floor");
    for (int i = 0; i < 4; i++)
        check_position(checker, names[i], floor->corners[i]);
    if (checker->problems->count == before)
        check_floor_shape(checker, floor->corners);
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
    leave(checker);
}

typedef struct Range {
    double low, high;
} Range;

static Range range_about(double middle, double amplitude) {
    return (Range){middle - fabs(amplitude), middle + fabs(amplitude)};
}

static Range heights_of(const HdPath *path) {
    if (path->is_fixed)
        return range_about(path->point.z, 0.0);
    return range_about(path->cylinder.z0, path->cylinder.z_amplitude);
}

/* Distances from the z axis: r may be negative. */
static Range distances_of(const HdPath *path) {
    if (path->is_fixed)
        return range_about(hd_length(hd_vec3(path->point.x, path->point.y, 0.0)), 0.0);
    const Range r = range_about(path->cylinder.r0, path->cylinder.r_amplitude);
    return (Range){fmax(0.0, fmax(r.low, -r.high)), fmax(-r.low, r.high)};
}

static double gap_between(Range a, Range b) {
    return fmax(a.low - b.high, b.low - a.high);
}

static double size_of(Range range) {
    return fmax(fabs(range.low), fabs(range.high));
}

/* True for most flights, and then it saves a look at millions of frames. */
static bool paths_keep_apart(const HdPath *eye, const HdPath *target) {
    static const double margin = 1e-9;
    const Range heights[2] = {heights_of(eye), heights_of(target)};
    const Range distances[2] = {distances_of(eye), distances_of(target)};
    const double size = fmax(fmax(size_of(heights[0]), size_of(heights[1])),
                             fmax(size_of(distances[0]), size_of(distances[1])));
    const double gap =
        fmax(gap_between(heights[0], heights[1]), gap_between(distances[0], distances[1]));
    return gap > margin * size;
}

/* Tells the first frame that has no camera. */
static void check_flight(Checker *checker, const HdScene *scene) {
    const bool stands_still = scene->eye.is_fixed && scene->target.is_fixed;
    const int frames = stands_still ? 1 : scene->frame_count;
    HdStatus status = HD_OK;
    HdCamera camera;
    HdError error;
    if (!checker->camera_is_sound || paths_keep_apart(&scene->eye, &scene->target))
        return;
    for (int frame = 0; status == HD_OK && frame < frames; frame++)
        status = hd_camera_at(&camera, scene, frame, &error);
    enter(checker, "", "camera");
    if (status != HD_OK)
        hd_problem(checker->problems, "%s%s", checker->place, error.message);
    leave(checker);
}

static bool refracts(const HdSolid *solid) {
    return solid->face.index_of_refraction != 1.0;
}

static void add_overlap(Checker *checker, int refracting, const char *other, double depth) {
    enter_item(checker, "solid", "solids", refracting);
    hd_problem(checker->problems,
               "%sit refracts and overlaps %s, %.6g deep, expected a refracting solid to overlap "
               "nothing",
               checker->place, other, depth);
    leave(checker);
}

static void check_pair(Checker *checker, const HdSolid *solids, int first, int second) {
    char name[32];
    if (!checker->solid_is_sound[second] ||
        !(refracts(&solids[first]) || refracts(&solids[second])))
        return;
    const double depth = hd_solid_overlap(&solids[first], &solids[second]);
    const int subject = refracts(&solids[first]) ? first : second;
    const int other = first + second - subject;
    if (checker->naming == HD_NAMING_JSON)
        snprintf(name, sizeof name, "solids[%d]", other);
    else
        snprintf(name, sizeof name, "solid %d", other + 1);
    if (depth > 0.0)
        add_overlap(checker, subject, name, depth);
}

static void check_overlaps(Checker *checker, const HdScene *scene) {
    for (int i = 0; i < checker->solid_count; i++) {
        const HdSolid *solid = &scene->solids[i];
        if (!checker->solid_is_sound[i])
            continue;
        for (int j = i + 1; j < checker->solid_count; j++)
            check_pair(checker, scene->solids, i, j);
        if (!checker->floor_is_sound || !refracts(solid))
            continue;
        const double depth = hd_floor_overlap(solid, &scene->floor);
        if (depth > 0.0)
            add_overlap(checker, i, "the floor", depth);
    }
}

/* What is not there (no rim, no edge lights, no floor, no texture) is not checked. */
void hd_scene_check(const HdScene *scene, HdNaming naming, HdProblems *problems) {
    Checker checker = {.problems = problems, .naming = naming};
    check_camera(&checker, scene);
    check_picture(&checker, scene);
    check_lights(&checker, scene);
    check_solids(&checker, scene);
    check_all_lights(&checker, scene);
    check_floor(&checker, &scene->floor);
    check_flight(&checker, scene);
    check_overlaps(&checker, scene);
}

HdStatus hd_scene_validate(const HdScene *scene, HdError *error) {
    HdProblems problems = {0};
    hd_scene_check(scene, HD_NAMING_PROSE, &problems);
    if (problems.count == 0)
        return HD_OK;
    return hd_fail(error, HD_BAD_INPUT, "%.*s", (int)strcspn(problems.text, "\n"), problems.text);
}
