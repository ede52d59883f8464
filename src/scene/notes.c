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
static void name_object(const HdScene *scene, const HdNesting *nesting, HdNestObject object,
                        char out[48]) {
    if (object.is_solid) {
        snprintf(out, 48, "solids[%d]", object.number);
        return;
    }
    const HdInstance *instance = &scene->instances[object.number];
    snprintf(out, 48, "%smeshes[%d]",
             nesting->shells[instance->mesh].count > 1 ? "a part of " : "", instance->entry);
}

/* Notes the first of the results in one state. */
static void note_nested(const HdScene *scene, const HdNesting *nesting, HdNestState state,
                        HdProblems *notes) {
    static const char *const texts[] = {
        [HD_NEST_WITHIN] = "%s lies within %s, which refracts%s: its index_of_refraction, also one "
                           "of 1, counts against that one's %.6g",
        [HD_NEST_CROSSES] = "%s and %s cross or nearly touch%s: the index_of_refraction of each "
                            "counts as if the other were not there",
        [HD_NEST_OPEN] = "%s lies within %s, but one of them is not closed%s: its "
                         "index_of_refraction counts as if the other were not there",
        [HD_NEST_MIXED] = "%s lies within %s, which has several indices of refraction%s: its own "
                          "counts against 1"};
    Pairs pairs = {0};
    const HdNested *first = NULL;
    char object[48], other[48], others[48];
    for (int i = nesting->count; i-- > 0;)
        if (nesting->list[i].state == state) {
            first = &nesting->list[i];
            pairs.count++;
        }
    if (first == NULL)
        return;
    name_object(scene, nesting, first->object, object);
    if (first->object.is_solid == first->other.is_solid &&
        first->object.number == first->other.number)
        snprintf(other, sizeof other, "another part of it");
    else
        name_object(scene, nesting, first->other, other);
    hd_problem(notes, texts[state], object, other, others_of(&pairs, others), first->around);
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
    for (int i = 0; i < scene->solid_count; i++)
        note_edge_lights(&scene->solids[i], i, notes);
    note_contacts(scene, notes);
    note_nesting(scene, notes);
}
