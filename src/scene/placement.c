/* SPDX-License-Identifier: MIT */
#include "scene/placement.h"

#include <math.h>

const HdMesh *hd_mesh_of(const HdScene *scene, int instance) {
    return &scene->meshes[scene->instances[instance].mesh];
}

void hd_invert_columns(const HdVec3 to[3], HdVec3 back[3]) {
    HdVec3 rows[3];
    for (int i = 0; i < 3; i++)
        rows[i] = hd_scale(to[i], 1.0 / hd_dot(to[i], to[i]));
    back[0] = hd_vec3(rows[0].x, rows[1].x, rows[2].x);
    back[1] = hd_vec3(rows[0].y, rows[1].y, rows[2].y);
    back[2] = hd_vec3(rows[0].z, rows[1].z, rows[2].z);
}

HdVec3 hd_placed_half(const HdPlacement *to, HdVec3 half) {
    const HdVec3 *c = to->columns;
    return hd_vec3(fabs(c[0].x) * half.x + fabs(c[1].x) * half.y + fabs(c[2].x) * half.z,
                   fabs(c[0].y) * half.x + fabs(c[1].y) * half.y + fabs(c[2].y) * half.z,
                   fabs(c[0].z) * half.x + fabs(c[1].z) * half.y + fabs(c[2].z) * half.z);
}

HdVec3 hd_placed_mesh_half(const HdMesh *mesh, const HdPlacement *to) {
    const HdVec3 sides = hd_sub(mesh->upper, mesh->lower);
    return hd_placed_half(to, hd_scale(sides, 0.5 / hd_mesh_half_side(mesh)));
}

/* Computes the columns of the matrix that turns a mesh upright and rotates it. */
static void rotation_of(const HdInstance *instance, HdVec3 columns[3]) {
    columns[0] = hd_vec3(1.0, 0.0, 0.0);
    columns[1] = hd_vec3(0.0, 1.0, 0.0);
    columns[2] = hd_vec3(0.0, 0.0, 1.0);
    hd_rotate_points(columns, 3, instance->rotation_degrees);
    if (instance->up == HD_UP_Z)
        return;
    const HdVec3 back = columns[1];
    columns[1] = columns[2];
    columns[2] = hd_scale(back, -1.0);
}

static HdPlacement place(const HdInstance *instance, const HdMesh *mesh) {
    HdVec3 middle = hd_mesh_centre(mesh);
    HdPlacement to;
    rotation_of(instance, to.columns);
    to.columns[0] = hd_scale(to.columns[0], instance->scale.x);
    to.columns[1] = hd_scale(to.columns[1], instance->scale.y);
    to.columns[2] = hd_scale(to.columns[2], instance->scale.z);
    to.start = instance->position;
    to.start = hd_add(to.start, hd_scale(to.columns[0], middle.x));
    to.start = hd_add(to.start, hd_scale(to.columns[1], middle.y));
    to.start = hd_add(to.start, hd_scale(to.columns[2], middle.z));
    for (int i = 0; i < 3; i++)
        to.columns[i] = hd_scale(to.columns[i], hd_mesh_half_side(mesh));
    return to;
}

HdPlacement hd_placement_of(const HdScene *scene, int instance) {
    return place(&scene->instances[instance], hd_mesh_of(scene, instance));
}

/* Returns how far a placed mesh reaches from its middle along a direction of the world. */
static double reach(const HdMesh *mesh, const HdPlacement *to, HdVec3 along) {
    return hd_mesh_reach(mesh, hd_vec3(hd_dot(along, to->columns[0]), hd_dot(along, to->columns[1]),
                                       hd_dot(along, to->columns[2])));
}

void hd_instance_fit(HdInstance *instance, const HdMesh *mesh, double size) {
    const HdVec3 sides = hd_sub(mesh->upper, mesh->lower), scale = instance->scale;
    const double longest =
        fmax(fabs(sides.x * scale.x), fmax(fabs(sides.y * scale.y), fabs(sides.z * scale.z)));
    const HdVec3 stand = instance->position;
    instance->scale = hd_scale(scale, size / longest);
    instance->position = hd_vec3(0.0, 0.0, 0.0);
    const HdPlacement to = place(instance, mesh);
    const double below = reach(mesh, &to, hd_vec3(0.0, 0.0, -1.0));
    instance->position = hd_sub(stand, hd_sub(to.start, hd_vec3(0.0, 0.0, below)));
}

void hd_instance_box(const HdScene *scene, int instance, HdVec3 *lower, HdVec3 *upper) {
    const HdPlacement to = hd_placement_of(scene, instance);
    const HdMesh *mesh = hd_mesh_of(scene, instance);
    const HdVec3 back = hd_vec3(reach(mesh, &to, hd_vec3(-1.0, 0.0, 0.0)),
                                reach(mesh, &to, hd_vec3(0.0, -1.0, 0.0)),
                                reach(mesh, &to, hd_vec3(0.0, 0.0, -1.0)));
    const HdVec3 forth =
        hd_vec3(reach(mesh, &to, hd_vec3(1.0, 0.0, 0.0)), reach(mesh, &to, hd_vec3(0.0, 1.0, 0.0)),
                reach(mesh, &to, hd_vec3(0.0, 0.0, 1.0)));
    *lower = hd_sub(to.start, back);
    *upper = hd_add(to.start, forth);
}

/* Computes inward normals of the planes through the eye and the edges of the picture, then that of
   the plane through the eye along the picture. */
static void planes_of(const HdScene *scene, const HdCamera *camera, HdVec3 inwards[5]) {
    const bool is_cropped = scene->crop.whole_width > 0;
    const double width = is_cropped ? scene->crop.whole_width : scene->width;
    const double height = is_cropped ? scene->crop.whole_height : scene->height;
    const HdVec3 across = hd_scale(camera->forward, camera->tangent_of_half_fov);
    const HdVec3 upright = hd_scale(across, height / width);
    inwards[0] = hd_add(across, camera->right);
    inwards[1] = hd_sub(across, camera->right);
    inwards[2] = hd_add(upright, camera->up);
    inwards[3] = hd_sub(upright, camera->up);
    inwards[4] = camera->forward;
}

HdSight hd_instance_sight(const HdScene *scene, int instance, const HdCamera *camera) {
    const HdPlacement to = hd_placement_of(scene, instance);
    const HdMesh *mesh = hd_mesh_of(scene, instance);
    const HdVec3 from_eye = hd_sub(to.start, camera->eye);
    HdSight sight = HD_SIGHT_WHOLE;
    HdVec3 inwards[5];
    planes_of(scene, camera, inwards);
    for (int i = 0; i < 5; i++) {
        const double middle = hd_dot(inwards[i], from_eye);
        if (middle + reach(mesh, &to, inwards[i]) <= 0.0)
            return HD_SIGHT_NONE;
        if (middle - reach(mesh, &to, hd_scale(inwards[i], -1.0)) < 0.0)
            sight = HD_SIGHT_PART;
    }
    return sight;
}
