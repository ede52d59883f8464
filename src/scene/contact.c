/* SPDX-License-Identifier: MIT */
#include "scene/contact.h"

#include <math.h>

#include "scene/overlap.h"

/* Of the radii and the distance of two solids: by how much they are drawn apart, and from which
   distance on they count as apart already. Half a step is twice what the float kernels need to tell
   faces apart. */
static const double step_share = 0x1p-20, near_share = 0x1p-21;
static const double most_inset_share = 0x1p-10; /* of the inradius */

static double scale_of(const HdSolid *a, HdVec3 b_centre, double b_radius) {
    return fmax(hd_length(hd_sub(a->centre, b_centre)), fmax(a->circumradius, b_radius));
}

/* Of the circle about a face. */
static double face_radius(const HdSolid *solid, const HdPlatonic *shape) {
    return solid->circumradius * sqrt(1.0 - shape->inradius * shape->inradius);
}

static HdVec3 middle_of_face(const HdSolid *solid, const HdPlatonic *shape, int face) {
    return hd_add(solid->centre,
                  hd_scale(shape->face_normal[face], shape->inradius * solid->circumradius));
}

/* Whether the face lies in the plane, which may be turned over. */
static bool is_in_plane(const HdSolid *solid, const HdPlatonic *shape, int face, HdVec3 point,
                        HdVec3 normal, double near) {
    const HdVec3 middle = middle_of_face(solid, shape, face);
    const double tilt = hd_length(hd_cross(shape->face_normal[face], normal));
    return fabs(hd_dot(hd_sub(middle, point), normal)) <= near &&
           tilt * face_radius(solid, shape) <= near;
}

/* By the circles about the faces: some that only lie beside each other count too, which costs a
   step and nothing else. */
static bool faces_coincide(const HdSolid *a, const HdSolid *b, double near) {
    const HdPlatonic shape_a = hd_solid_shape(a), shape_b = hd_solid_shape(b);
    const double reach = face_radius(a, &shape_a) + face_radius(b, &shape_b);
    for (int i = 0; i < shape_a.face_count; i++) {
        const HdVec3 middle = middle_of_face(a, &shape_a, i);
        for (int j = 0; j < shape_b.face_count; j++)
            if (hd_length(hd_sub(middle_of_face(b, &shape_b, j), middle)) <= reach &&
                is_in_plane(b, &shape_b, j, middle, shape_a.face_normal[i], near))
                return true;
    }
    return false;
}

HdContact hd_solids_contact(const HdSolid *a, const HdSolid *b) {
    const double near = near_share * scale_of(a, b->centre, b->circumradius);
    const double depth = hd_solid_depth(a, b, -near);
    if (depth <= -near)
        return HD_CONTACT_NONE;
    if (depth <= near)
        return HD_CONTACT_TOUCHES;
    return faces_coincide(a, b, near) ? HD_CONTACT_SHARES : HD_CONTACT_OVERLAPS;
}

/* A flat floor that a solid lies in shares no face with it. */
HdContact hd_floor_contact(const HdSolid *solid, const HdFloor *floor) {
    const double near = near_share * scale_of(solid, hd_floor_centre(floor), 0.0);
    const double depth = hd_floor_depth(solid, floor, -near);
    if (depth <= -near)
        return HD_CONTACT_NONE;
    return depth <= near ? HD_CONTACT_TOUCHES : HD_CONTACT_OVERLAPS;
}

int hd_touching_lights(const HdSolid *solid, const HdLight *lights, int count, int *first) {
    const HdPlatonic shape = hd_solid_shape(solid);
    const double near = near_share * solid->circumradius;
    const double inradius = shape.inradius * solid->circumradius;
    int touching = 0;
    for (int i = 0; i < count; i++) {
        const HdVec3 place = hd_sub(lights[i].position, solid->centre);
        const double distance = hd_length(place);
        if (distance < inradius - near || distance > solid->circumradius + near)
            continue;
        double farthest = -distance;
        for (int f = 0; f < shape.face_count; f++)
            farthest = fmax(farthest, hd_dot(place, shape.face_normal[f]));
        if (fabs(farthest - inradius) <= near && touching++ == 0)
            *first = i;
    }
    return touching;
}

bool hd_contact_coincides(HdContact contact) {
    return contact == HD_CONTACT_TOUCHES || contact == HD_CONTACT_SHARES;
}

/* ---- drawing apart ---- */

typedef struct Parting {
    const HdScene *scene;
    int level[HD_MAX_SOLIDS];   /* steps that a solid shrinks by */
    double step[HD_MAX_SOLIDS]; /* the greatest of all that touch each other, in turn */
    int group[HD_MAX_SOLIDS];   /* those have one number */
} Parting;

static void join_groups(Parting *parting, int count, int from, int to) {
    const double step = fmax(parting->step[from], parting->step[to]);
    const int old = parting->group[from], joined = parting->group[to];
    for (int i = 0; i < count; i++) {
        if (parting->group[i] == old)
            parting->group[i] = joined;
        if (parting->group[i] == joined)
            parting->step[i] = fmax(parting->step[i], step);
    }
}

static void raise_step(Parting *parting, int solid, double scale) {
    parting->step[solid] = fmax(parting->step[solid], step_share * scale);
}

/* What does not move touches it: 0 is taken. */
static bool touches_fixed(Parting *parting, int index) {
    const HdScene *scene = parting->scene;
    const HdSolid *solid = &scene->solids[index];
    bool touches = false;
    if (scene->floor.present && hd_contact_coincides(hd_floor_contact(solid, &scene->floor))) {
        raise_step(parting, index, scale_of(solid, hd_floor_centre(&scene->floor), 0.0));
        touches = true;
    }
    int first;
    if (hd_touching_lights(solid, scene->lights, scene->light_count, &first) > 0) {
        raise_step(parting, index, solid->circumradius);
        touches = true;
    }
    return touches;
}

static void place_solid(Parting *parting, int index) {
    const HdSolid *solids = parting->scene->solids;
    bool taken[HD_MAX_SOLIDS + 1] = {false};
    parting->group[index] = index;
    taken[0] = touches_fixed(parting, index);
    for (int i = 0; i < index; i++) {
        if (!hd_contact_coincides(hd_solids_contact(&solids[i], &solids[index])))
            continue;
        taken[parting->level[i]] = true;
        raise_step(parting, index,
                   scale_of(&solids[index], solids[i].centre, solids[i].circumradius));
        join_groups(parting, index + 1, i, index);
    }
    while (taken[parting->level[index]])
        parting->level[index]++;
}

void hd_scene_part_contacts(HdScene *scene) {
    Parting parting = {.scene = scene};
    for (int i = 0; i < scene->solid_count; i++)
        place_solid(&parting, i);
    for (int i = 0; i < scene->solid_count; i++) {
        HdSolid *solid = &scene->solids[i];
        HdPlatonic shape;
        hd_platonic(solid->kind, &shape);
        const double share =
            parting.level[i] * parting.step[i] / (shape.inradius * solid->circumradius);
        if (share <= most_inset_share)
            solid->circumradius *= 1.0 - share;
    }
}
