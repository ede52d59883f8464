/* SPDX-License-Identifier: MIT */
#include "input/check_geometry.h"

#include <math.h>
#include <stdio.h>

#include "input/fields.h"
#include "scene/camera.h"
#include "scene/overlap.h"

/* The cross product of the diagonals is normal to both, so two opposite corners are always equally
   high above it. */
void hd_check_floor_shape(HdSceneChecker *checker, const HdVec3 corner[4]) {
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
        hd_tell(checker,
                "its diagonals pass each other %.6g apart, expected four corners in one plane "
                "(at most %.6g apart)",
                height, flatness * size);
        return;
    }
    for (int i = 0; i < 4; i++) {
        const HdVec3 before = hd_sub(corner[i], corner[(i + 3) % 4]);
        const HdVec3 after = hd_sub(corner[(i + 1) % 4], corner[i]);
        if (!(hd_dot(hd_cross(before, after), normal) / area > sharpness * size * size))
            hd_tell(checker,
                    "corner %d is not a convex corner, expected the corners of a convex "
                    "quadrilateral in their order around it",
                    i + 1);
    }
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

void hd_check_flight(HdSceneChecker *checker, const HdScene *scene) {
    const bool stands_still = scene->eye.is_fixed && scene->target.is_fixed;
    const int frames = stands_still ? 1 : scene->frame_count;
    HdStatus status = HD_OK;
    HdCamera camera;
    HdError error;
    if (!checker->camera_is_sound || paths_keep_apart(&scene->eye, &scene->target))
        return;
    for (int frame = 0; status == HD_OK && frame < frames; frame++)
        status = hd_camera_at(&camera, scene, frame, &error);
    if (status != HD_OK)
        hd_tell(checker, "%s", error.message);
}

static bool refracts(const HdSolid *solid) {
    return solid->face.index_of_refraction != 1.0;
}

/* "solids[1] (cube)" */
static void name_solid(const HdSceneChecker *checker, const HdSolid *solid, int index,
                       char out[48]) {
    const HdObjectType *type = hd_field(&hd_scene_fields, "solids")->object;
    const char *kind = hd_field_choice(hd_field(type, "kind"), (int)solid->kind);
    if (checker->naming == HD_NAMING_JSON)
        snprintf(out, 48, "solids[%d] (%s)", index, kind);
    else
        snprintf(out, 48, "solid %d (%s)", index + 1, kind);
}

static void add_overlap(HdSceneChecker *checker, const char *refracting, const char *other,
                        double depth) {
    const bool is_json = checker->naming == HD_NAMING_JSON;
    hd_problem(checker->problems,
               "%s: it refracts and overlaps %s, %.3g deep; move them apart or give it %s",
               refracting, other, depth,
               is_json ? "index_of_refraction 1" : "an index of refraction of 1");
}

static void check_pair(HdSceneChecker *checker, const HdSolid *solids, int first, int second) {
    char name[48], other_name[48];
    if (!checker->solid_is_sound[second] ||
        !(refracts(&solids[first]) || refracts(&solids[second])))
        return;
    const double depth = hd_solid_overlap(&solids[first], &solids[second]);
    const int subject = refracts(&solids[first]) ? first : second;
    const int other = first + second - subject;
    if (depth <= 0.0)
        return;
    name_solid(checker, &solids[subject], subject, name);
    name_solid(checker, &solids[other], other, other_name);
    add_overlap(checker, name, other_name, depth);
}

static void check_above_floor(HdSceneChecker *checker, const HdScene *scene, int index) {
    char name[48];
    if (!checker->floor_is_sound || !refracts(&scene->solids[index]))
        return;
    const double depth = hd_floor_overlap(&scene->solids[index], &scene->floor);
    if (depth <= 0.0)
        return;
    name_solid(checker, &scene->solids[index], index, name);
    add_overlap(checker, name, "the floor", depth);
}

void hd_check_overlaps(HdSceneChecker *checker, const HdScene *scene) {
    for (int i = 0; i < checker->solid_count; i++) {
        if (!checker->solid_is_sound[i])
            continue;
        for (int j = i + 1; j < checker->solid_count; j++)
            check_pair(checker, scene->solids, i, j);
        check_above_floor(checker, scene, i);
    }
}
