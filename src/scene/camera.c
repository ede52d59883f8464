/* SPDX-License-Identifier: MIT */
#include "scene/camera.h"

#include <math.h>

#include "base/trigonometry.h"

/* Frame `frame_count` gets exactly the double 2 pi. */
static double path_time(int frame, int frame_count) {
    return 2.0 * HD_PI * ((double)frame / (double)frame_count);
}

/* Returns the horizontal unit vector away from the z axis at the path's angle phi. */
static HdVec3 outward_on_cylinder(const HdCylinderPath *path, double t) {
    HdVec3 outward = {0.0, 0.0, 0.0};
    hd_sine_cosine(path->phi0 + path->phi_frequency * t, &outward.y, &outward.x);
    return outward;
}

static HdVec3 outward_at(const HdPath *path, double t) {
    if (!path->is_fixed)
        return outward_on_cylinder(&path->cylinder, t);
    const double size = fmax(fabs(path->point.x), fabs(path->point.y));
    if (!(size > 0.0))
        return hd_vec3(1.0, 0.0, 0.0);
    return hd_normalize(hd_vec3(path->point.x / size, path->point.y / size, 0.0));
}

HdVec3 hd_path_point(const HdPath *path, int frame, int frame_count) {
    const HdCylinderPath *law = &path->cylinder;
    if (path->is_fixed)
        return path->point;
    const double t = path_time(frame, frame_count);
    double r_swing, z_swing, unused;
    hd_sine_cosine(law->r_frequency * t + law->r_phase, &r_swing, &unused);
    hd_sine_cosine(law->z_frequency * t + law->z_phase, &z_swing, &unused);
    const HdVec3 outward = outward_on_cylinder(law, t);
    const double r = law->r0 + law->r_amplitude * r_swing;
    return hd_vec3(r * outward.x, r * outward.y, law->z0 + law->z_amplitude * z_swing);
}

static bool is_finite(HdVec3 a) {
    return isfinite(a.x) && isfinite(a.y) && isfinite(a.z);
}

/* Sets the view basis; `path` supplies phi if the view is vertical, which leaves the roll open. */
static void set_basis(HdCamera *camera, HdVec3 view, const HdPath *path, double t) {
    static const double vertical = 1e-9;
    /* Scaled to about 1 first, so that the squares neither overflow nor vanish. */
    const double size = hd_largest(view);
    camera->forward = hd_normalize(hd_vec3(view.x / size, view.y / size, view.z / size));
    const HdVec3 sideways = hd_cross(camera->forward, hd_vec3(0.0, 0.0, 1.0));
    if (hd_length(sideways) >= vertical) {
        camera->right = hd_normalize(sideways);
        camera->up = hd_cross(camera->right, camera->forward);
        return;
    }
    const double sign = camera->forward.z > 0.0 ? 1.0 : -1.0;
    camera->forward = hd_vec3(0.0, 0.0, sign);
    camera->up = hd_scale(outward_at(path, t), sign);
    camera->right = hd_cross(camera->forward, camera->up);
}

HdStatus hd_camera_at(HdCamera *camera, const HdScene *scene, int frame, HdError *error) {
    /* An eye and a target closer than this part of their coordinates differ by rounding only. */
    static const double same_place = 1e-13;
    const HdVec3 eye = hd_path_point(&scene->eye, frame, scene->frame_count);
    const HdVec3 target = hd_path_point(&scene->target, frame, scene->frame_count);
    const HdVec3 view = hd_sub(target, eye);
    if (!is_finite(eye) || !is_finite(target) || !is_finite(view))
        return hd_fail(error, HD_BAD_INPUT,
                       "frame %d: the coordinates of the eye or the target are too large", frame);
    const double scale = fmax(hd_largest(eye), hd_largest(target));
    if (hd_largest(view) <= same_place * scale)
        return hd_fail(error, HD_BAD_INPUT,
                       "frame %d: the eye is at the target (%.15g, %.15g, %.15g), "
                       "expected two different points",
                       frame, eye.x, eye.y, eye.z);

    double sine, cosine;
    hd_sine_cosine(scene->field_of_view_degrees * (HD_PI / 360.0), &sine, &cosine);
    camera->eye = eye;
    camera->tangent_of_half_fov = sine / cosine;
    set_basis(camera, view, &scene->eye, path_time(frame, scene->frame_count));
    return HD_OK;
}
