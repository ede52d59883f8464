/* SPDX-License-Identifier: MIT */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/trigonometry.h"
#include "scene/camera.h"
#include "scene/contact.h"
#include "scene/nesting.h"
#include "scene/scene.h"

/* Degrees; less was probably given in radians, in which no field of view exceeds pi. */
static const double narrow_field_of_view = 5.0;

/* The cosine between a floor's normal and the z axis; below it the floor is rather a wall. */
static const double steepest_floor = 0.5;

static bool edges_light(const HdEdgeLights *lights) {
    return lights->per_edge > 0 && lights->intensity > 0.0;
}

static bool edges_show(const HdEdgeLights *lights) {
    return lights->per_edge > 0 && lights->disc_radius > 0.0 && lights->disc_radiance > 0.0;
}

static void note_edge_lights(const HdSolid *solid, int index, HdProblems *notes) {
    const HdEdgeLights *lights = &solid->lights;
    HdPlatonic platonic;
    if (lights->per_edge == 0)
        return;
    hd_platonic(solid->kind, &platonic);
    const double gap = platonic.edge_length * solid->circumradius / lights->per_edge;
    if (!edges_light(lights) && !edges_show(lights))
        hd_problem(notes,
                   "solids[%d].edge_lights neither light nor show: they lack an intensity, and a "
                   "disc_radius with a disc_radiance",
                   index);
    else if (edges_show(lights) && 2.0 * lights->disc_radius > gap)
        hd_problem(notes,
                   "solids[%d].edge_lights overlap: their discs are %.3g wide, and from light to "
                   "light it is %.3g",
                   index, 2.0 * lights->disc_radius, gap);
}

static void note_eye_below_floor(const HdScene *scene, HdProblems *notes) {
    const HdVec3 *corner = scene->floor.corners;
    if (!scene->floor.present)
        return;
    HdVec3 normal =
        hd_normalize(hd_cross(hd_sub(corner[2], corner[0]), hd_sub(corner[3], corner[1])));
    if (normal.z < 0.0)
        normal = hd_scale(normal, -1.0);
    const HdVec3 eye = hd_path_point(&scene->eye, 0, scene->frame_count);
    if (normal.z > steepest_floor && hd_dot(normal, hd_sub(eye, corner[0])) < 0.0)
        hd_problem(notes, "camera.eye is below the floor in frame 0");
}

/* Pairs of one kind, of which the first one is named. */
typedef struct Pairs {
    int count, solid;
    char other[32];
} Pairs;

static void count_pairs(Pairs *pairs, int solid, const char *what, int other, int count) {
    pairs->count += count;
    if (pairs->count > count)
        return;
    pairs->solid = solid;
    if (other < 0)
        snprintf(pairs->other, sizeof pairs->other, "%s", what);
    else
        snprintf(pairs->other, sizeof pairs->other, "%s[%d]", what, other);
}

static void count_contact(HdContact contact, int solid, const char *what, int other,
                          Pairs *touching, Pairs *overlapping) {
    if (hd_contact_coincides(contact))
        count_pairs(touching, solid, what, other, 1);
    if (contact == HD_CONTACT_OVERLAPS || contact == HD_CONTACT_SHARES)
        count_pairs(overlapping, solid, what, other, 1);
}

/* Writes and returns ", the first of 3 such pairs". */
static const char *others_of(const Pairs *pairs, char out[48]) {
    snprintf(out, 48, ", the first of %d such pairs", pairs->count);
    return pairs->count > 1 ? out : "";
}

static void note_contacts(const HdScene *scene, HdProblems *notes) {
    Pairs touching = {0}, overlapping = {0};
    char others[48];
    for (int i = 0; i < scene->solid_count; i++) {
        const HdSolid *solid = &scene->solids[i];
        for (int j = 0; j < i; j++)
            if (!hd_solid_holds(&scene->solids[j], solid) &&
                !hd_solid_holds(solid, &scene->solids[j]))
                count_contact(hd_solids_contact(&scene->solids[j], solid), i, "solids", j,
                              &touching, &overlapping);
        if (scene->floor.present)
            count_contact(hd_floor_contact(solid, &scene->floor), i, "the floor", -1, &touching,
                          &overlapping);
        int first, lights = hd_touching_lights(solid, scene->lights, scene->light_count, &first);
        if (lights > 0)
            count_pairs(&touching, i, "lights", first, lights);
    }
    if (touching.count > 0)
        hd_problem(notes,
                   "solids[%d] touches %s%s: it is drawn smaller by a millionth or so, so that "
                   "rounding does not decide which is in front",
                   touching.solid, touching.other, others_of(&touching, others));
    if (overlapping.count > 0)
        hd_problem(notes, "solids[%d] overlaps %s%s: each has all of its faces there",
                   overlapping.solid, overlapping.other, others_of(&overlapping, others));
}

/* ---- nesting ---- */

/* Writes "solids[0]", "meshes[1]" or "a part of meshes[1]". */
static void name_object(const HdScene *scene, HdNestObject object, bool is_part, char out[48]) {
    if (object.is_solid)
        snprintf(out, 48, "solids[%d]", object.number);
    else
        snprintf(out, 48, "%smeshes[%d]", is_part ? "a part of " : "",
                 scene->instances[object.number].entry);
}

static bool has_parts(const HdScene *scene, const HdNesting *nesting, HdNestObject object) {
    return !object.is_solid && nesting->shells[scene->instances[object.number].mesh].count > 1;
}

/* A result that stands for all of its kind. */
typedef struct Nest {
    char object[48], other[48], others[48];
    bool is_closed; /* the object's shell */
    double around;
} Nest;

static Nest describe(const HdScene *scene, const HdNesting *nesting, const HdNested *first,
                     int count) {
    const HdNestObject object = first->object, other = first->other;
    Nest nest = {.is_closed = true, .around = first->around};
    const Pairs pairs = {.count = count};
    name_object(scene, object, first->shell != HD_ALL_SHELLS && has_parts(scene, nesting, object),
                nest.object);
    if (object.is_solid == other.is_solid && object.number == other.number)
        snprintf(nest.other, sizeof nest.other, "another part of it");
    else
        name_object(scene, other, has_parts(scene, nesting, other), nest.other);
    if (count > 1)
        others_of(&pairs, nest.others);
    if (!object.is_solid && first->shell != HD_ALL_SHELLS)
        nest.is_closed =
            nesting->shells[scene->instances[object.number].mesh].shells[first->shell].is_closed;
    return nest;
}

static void note_nest(const Nest *nest, HdNestState state, HdProblems *notes) {
    switch (state) {
    case HD_NEST_WITHIN:
        hd_problem(notes, "%s lies in %s of index %.6g%s: its own index is divided by %.6g",
                   nest->object, nest->other, nest->around, nest->others, nest->around);
        break;
    case HD_NEST_CROSSES:
        hd_problem(notes,
                   "%s and %s intersect or nearly touch%s: light bends at each as if the other "
                   "were not there",
                   nest->object, nest->other, nest->others);
        break;
    case HD_NEST_OPEN:
        hd_problem(notes,
                   "%s lies in %s%s, but %s is not closed, because at an edge a face is missing "
                   "or turned inside out: light bends as if the other were not there",
                   nest->object, nest->other, nest->others,
                   nest->is_closed ? nest->other : nest->object);
        break;
    case HD_NEST_MIXED:
        hd_problem(notes,
                   "%s lies in %s, which has several indices of refraction%s: its own index is "
                   "not divided",
                   nest->object, nest->other, nest->others);
        break;
    case HD_NEST_CAVITY:
        hd_problem(notes,
                   "%s refracts, but is inside out%s, so it counts as a cavity of index 1: faces "
                   "must run counterclockwise as seen from outside",
                   nest->object, nest->others);
        break;
    case HD_NEST_SKIPPED:
        hd_problem(notes,
                   "%s and what follows were not compared with others, which would take too "
                   "long: their indices count as if they lay in nothing",
                   nest->object);
        break;
    case HD_NEST_STATE_COUNT:
        break;
    }
}

/* Notes the first of the results in one state. */
static void note_nested(const HdScene *scene, const HdNesting *nesting, HdNestState state,
                        HdProblems *notes) {
    const HdNested *first = NULL;
    int count = 0;
    for (int i = nesting->count; i-- > 0;)
        if (nesting->list[i].state == state) {
            first = &nesting->list[i];
            count++;
        }
    if (first == NULL)
        return;
    const Nest nest = describe(scene, nesting, first, count);
    note_nest(&nest, state, notes);
}

static void note_nesting(const HdScene *scene, HdProblems *notes) {
    HdNesting nesting;
    HdError ignored;
    if (hd_nesting_find(&nesting, scene, true, &ignored) != HD_OK)
        return;
    for (int state = 0; state < HD_NEST_STATE_COUNT; state++)
        note_nested(scene, &nesting, (HdNestState)state, notes);
    hd_nesting_free(&nesting);
}

/* Smallest visible jump of a path, as a share of the distance between eye and target. */
static const double min_jump = 1e-3;

/* Turns or swings in a film; with fewer, a path is not meant to return to its start. */
static const double min_rounds = 0.9;

static void note_radians(const char *path, const char *key, double angle, HdProblems *notes) {
    if (fabs(angle) > 2.0 * HD_PI)
        hd_problem(notes,
                   "camera.%s.%s is %.6g, which are radians, not degrees: %.6g degrees are %.4g",
                   path, key, angle, angle, angle * (HD_PI / 180.0));
}

static void note_frequency(const char *path, const char *key, double frequency, HdProblems *notes) {
    if (frequency != floor(frequency))
        hd_problem(notes,
                   "camera.%s.%s is %.6g, so the film jumps from its end to its beginning; %.0f or "
                   "%.0f makes it a loop",
                   path, key, frequency, floor(frequency), ceil(frequency));
}

static void note_path(const HdPath *path, const char *name, int frames, double distance,
                      HdProblems *notes) {
    const HdCylinderPath *law = &path->cylinder;
    const double phi = law->phi_frequency;
    const double r = law->r_amplitude != 0.0 ? law->r_frequency : 0.0;
    const double z = law->z_amplitude != 0.0 ? law->z_frequency : 0.0;
    const HdVec3 begin = hd_path_point(path, 0, frames), end = hd_path_point(path, frames, frames);
    if (path->is_fixed)
        return;
    note_radians(name, "phi0", law->phi0, notes);
    note_radians(name, "r_phase", law->r_phase, notes);
    note_radians(name, "z_phase", law->z_phase, notes);
    if (frames == 1 || hd_length(hd_sub(end, begin)) <= min_jump * distance ||
        fmax(fabs(phi), fmax(fabs(r), fabs(z))) < min_rounds)
        return;
    note_frequency(name, "phi_frequency", phi, notes);
    note_frequency(name, "r_frequency", r, notes);
    note_frequency(name, "z_frequency", z, notes);
}

void hd_scene_notes(const HdScene *scene, HdProblems *notes) {
    const int frames = scene->frame_count;
    const double distance = hd_length(
        hd_sub(hd_path_point(&scene->target, 0, frames), hd_path_point(&scene->eye, 0, frames)));
    if (scene->field_of_view_degrees < narrow_field_of_view)
        hd_problem(notes, "camera.field_of_view is %.6g, which are degrees, not radians",
                   scene->field_of_view_degrees);
    note_path(&scene->eye, "eye", frames, distance, notes);
    note_path(&scene->target, "target", frames, distance, notes);
    note_eye_below_floor(scene, notes);
    if (scene->environment.file != NULL && scene->environment.intensity == 0.0)
        hd_problem(notes, "environment.intensity is 0, so nothing shows its picture");
    for (int i = 0; i < scene->solid_count; i++)
        note_edge_lights(&scene->solids[i], i, notes);
    note_contacts(scene, notes);
    note_nesting(scene, notes);
}
