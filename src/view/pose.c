/* SPDX-License-Identifier: MIT */
#include "view/pose.h"

#include <math.h>

#include "base/text.h"
#include "base/trigonometry.h"
#include "scene/camera.h"

/* From the horizon to here the eye may climb. */
#define STEEPEST (HD_PI / 2.0 - 0.01)

/* Farther and nearer nothing can be seen. */
static const double farthest = 1e6, nearest = 1e-3;

HdPose hd_pose_of_flight(const HdScene *scene, int frame) {
    return (HdPose){hd_path_point(&scene->eye, frame, scene->frame_count),
                    hd_path_point(&scene->target, frame, scene->frame_count)};
}

void hd_pose_orbit(HdPose *pose, double right, double up) {
    const HdVec3 away = hd_sub(pose->eye, pose->target);
    const double distance = hd_length(away);
    const double azimuth = atan2(away.y, away.x) + right;
    double height = asin(fmax(-1.0, fmin(1.0, away.z / distance))) + up;
    height = fmax(-STEEPEST, fmin(STEEPEST, height));
    const HdVec3 turned = {cos(height) * cos(azimuth), cos(height) * sin(azimuth), sin(height)};
    pose->eye = hd_add(pose->target, hd_scale(turned, distance));
}

void hd_pose_pan(HdPose *pose, double right, double up) {
    const HdVec3 view = hd_sub(pose->target, pose->eye);
    const double distance = hd_length(view);
    const HdVec3 forward = hd_scale(view, 1.0 / distance);
    const HdVec3 sideways = hd_cross(forward, hd_vec3(0.0, 0.0, 1.0));
    const double size = hd_length(sideways);
    const HdVec3 to_right = size > 1e-9 ? hd_scale(sideways, 1.0 / size) : hd_vec3(1.0, 0.0, 0.0);
    const HdVec3 upwards = hd_cross(to_right, forward);
    const HdVec3 step =
        hd_add(hd_scale(to_right, right * distance), hd_scale(upwards, up * distance));
    pose->eye = hd_add(pose->eye, step);
    pose->target = hd_add(pose->target, step);
}

void hd_pose_dolly(HdPose *pose, double factor) {
    const HdVec3 away = hd_sub(pose->eye, pose->target);
    const double distance = hd_length(away);
    const double wanted = fmax(nearest, fmin(farthest, distance * factor));
    pose->eye = hd_add(pose->target, hd_scale(away, wanted / distance));
}

void hd_pose_apply(const HdPose *pose, HdScene *scene) {
    scene->frame_count = 1;
    scene->eye = (HdPath){.is_fixed = true, .point = pose->eye};
    scene->target = (HdPath){.is_fixed = true, .point = pose->target};
}

static void print_point(FILE *out, const char *key, HdVec3 point) {
    char x[HD_NUMBER_SIZE], y[HD_NUMBER_SIZE], z[HD_NUMBER_SIZE];
    hd_exact_number(point.x, x);
    hd_exact_number(point.y, y);
    hd_exact_number(point.z, z);
    fprintf(out, ", \"%s\": [%s, %s, %s]", key, x, y, z);
}

void hd_pose_print(FILE *out, const HdPose *pose, double field_of_view_degrees) {
    char angle[HD_NUMBER_SIZE];
    hd_exact_number(field_of_view_degrees, angle);
    fprintf(out, "\"camera\": {\"field_of_view\": %s, \"frames\": 1", angle);
    print_point(out, "eye", pose->eye);
    print_point(out, "target", pose->target);
    fputs("}\n", out);
}
