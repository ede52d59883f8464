/* SPDX-License-Identifier: MIT */
#include "view/motion.h"

#include <math.h>
#include <stdbool.h>

#include "base/minmax.h"
#include "base/text.h"
#include "base/trigonometry.h"
#include "scene/camera.h"

/* Largest elevation of the eye above the horizon. */
#define STEEPEST (HD_PI / 2.0 - 0.01)

/* Limits of the distance; nothing is visible beyond them. */
static const double farthest = 1e6, nearest = 1e-3;

HdPose hd_pose_on_path(const HdScene *scene, int frame) {
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

/* Estimate before any measurement: a common scene on two cores. */
#define USUAL_SECONDS 2e-6

/* Below this width a picture is unrecognisable: its ray depth decreases instead, and grows again
   once the picture is much wider. */
enum { MIN_WIDTH = 128, DEEPER_WIDTH = 256, MIN_DEPTH = 2 };

static double sample_count(const HdDetail *detail) {
    return (double)detail->width * detail->height * detail->samples * detail->sample_rows;
}

/* A picture that took too long counts at once, a quick one gradually. */
void hd_pace_note(HdPace *pace, const HdDetail *detail, double seconds) {
    const double now = seconds / sample_count(detail), before = pace->seconds_per_sample;
    const double weight = now > before ? 0.6 : 0.2;
    pace->seconds_per_sample = before > 0.0 ? before + weight * (now - before) : now;
}

/* One step at a time: the effect of a step is known only after a measurement. */
static void adapt_depth(HdPace *pace, const HdDetail *full, double width) {
    const int depth = pace->depth > 0 && pace->depth < full->depth ? pace->depth : full->depth;
    const bool is_whole = width >= full->width;
    if (width < MIN_WIDTH && !is_whole && depth > MIN_DEPTH)
        pace->depth = depth - 1;
    else if (is_whole || width >= DEEPER_WIDTH)
        pace->depth = depth < full->depth ? depth + 1 : 0;
}

HdDetail hd_pace_choose(HdPace *pace, const HdDetail *full) {
    const double each = pace->seconds_per_sample > 0.0 ? pace->seconds_per_sample : USUAL_SECONDS;
    const double share = HD_MOVING_SECONDS / each / ((double)full->width * full->height);
    const double side = sqrt(share);
    HdDetail detail = *full;
    adapt_depth(pace, full, side * full->width);
    if (pace->depth > 0 && pace->depth < full->depth)
        detail.depth = pace->depth;
    if (share < 1.0) {
        const double kept = fmax(side, fmin(1.0, (double)MIN_WIDTH / full->width));
        detail.width = hd_max((int)(full->width * kept), 1);
        detail.height = hd_max((int)(full->height * kept), 1);
        detail.samples = detail.sample_rows = 1;
    } else if (side < full->samples) {
        detail.samples = (int)side;
        detail.sample_rows = hd_min(detail.samples, full->sample_rows);
    }
    return detail;
}
