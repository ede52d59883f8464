/* SPDX-License-Identifier: MIT */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/trigonometry.h"
#include "scene/camera.h"
#include "scene/contact.h"
#include "scene/placement.h"
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
            count_contact(hd_solids_contact(&scene->solids[j], solid), i, "solids", j, &touching,
                          &overlapping);
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

/* Notes solids within refracting ones, which let rays pass. */
static void note_nesting(const HdScene *scene, HdProblems *notes) {
    Pairs nested = {0};
    char others[48];
    double around_first = 1.0;
    for (int i = 0; i < scene->solid_count; i++) {
        const HdSolid *solid = &scene->solids[i];
        const double around = hd_index_around(scene->solids, scene->solid_count, solid);
        if (around == 1.0 || hd_is_opaque(&solid->face))
            continue;
        if (nested.count == 0)
            around_first = around;
        count_pairs(&nested, i, "solids", i, 1);
    }
    if (nested.count > 0)
        hd_problem(notes,
                   "solids[%d] lies within a solid that refracts%s: its index_of_refraction, "
                   "also one of 1, counts against that one's %.6g",
                   nested.solid, others_of(&nested, others), around_first);
}

static bool is_glass(const HdMaterial *material) {
    return material->index_of_refraction != 1.0 && !hd_is_opaque(material);
}

static bool instance_is_glass(const HdScene *scene, const HdInstance *instance) {
    const HdMesh *mesh = &scene->meshes[instance->mesh];
    bool found = instance->has_material && is_glass(&instance->material);
    for (int i = 0; i < mesh->material_count && !instance->has_material; i++)
        found |= is_glass(&mesh->materials[i].material);
    return found;
}

/* A ball about an object that refracts. */
typedef struct Ball {
    const char *what;
    int number;
    HdVec3 centre;
    double radius;
} Ball;

static Ball ball_of_instance(const HdScene *scene, int number) {
    const HdInstance *instance = &scene->instances[number];
    const HdMesh *mesh = hd_mesh_of(scene, number);
    const HdVec3 scale = instance->scale, half = hd_sub(mesh->upper, hd_mesh_centre(mesh));
    return (Ball){"meshes", instance->entry, hd_placement_of(scene, number).start,
                  hd_length(hd_vec3(half.x * scale.x, half.y * scale.y, half.z * scale.z))};
}

/* Comparing more would take long; a note on some is enough. */
enum { MAX_BALLS = 1000 };

static void note_glass_meshes(const HdScene *scene, HdProblems *notes) {
    Ball balls[MAX_BALLS];
    int count = 0;
    for (int i = 0; i < scene->solid_count; i++)
        if (is_glass(&scene->solids[i].face))
            balls[count++] =
                (Ball){"solids", i, scene->solids[i].centre, scene->solids[i].circumradius};
    for (int i = 0; i < scene->instance_count && count < MAX_BALLS; i++) {
        if (!instance_is_glass(scene, &scene->instances[i]))
            continue;
        const Ball ball = ball_of_instance(scene, i);
        for (int j = 0; j < count; j++)
            if (hd_length(hd_sub(balls[j].centre, ball.centre)) < balls[j].radius + ball.radius) {
                hd_problem(notes,
                           "meshes[%d] refracts and may be within %s[%d] or overlap it: a mesh "
                           "counts its index_of_refraction against 1, so give one that lies "
                           "within glass its index divided by the glass's",
                           ball.number, balls[j].what, balls[j].number);
                return;
            }
        balls[count++] = ball;
    }
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
    note_glass_meshes(scene, notes);
}
