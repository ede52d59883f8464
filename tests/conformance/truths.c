/* SPDX-License-Identifier: MIT */
#include "truths.h"

#include <math.h>
#include <stdio.h>

#include "verify/scene_builder.h"

HdFrame render(const Check *check, const HdScene *scene, const HdCamera *camera) {
    return render_scene(check->target, scene, camera, "truths");
}

HdFrame render_last(const Check *check, HdScene *scene, const HdCamera *camera) {
    HdFrame frame = render(check, scene, camera);
    hd_scene_free(scene);
    return frame;
}

void expect(Check *check, const char *truth, int x, int y, double found, double expected) {
    check->checked++;
    if (fabs(found - expected) <= check->tolerance * (fabs(expected) + 1e-3))
        return;
    check->failed++;
    if (check->failed_truth != truth)
        printf("UNTRUE %s at (%d, %d): %.9g, expected %.9g on %s\n", truth, x, y, found, expected,
               check->target->label);
    check->failed_truth = truth;
}

void expect_compared(Check *check, const char *truth, int compared, int at_least) {
    check->checked++;
    if (compared >= at_least)
        return;
    check->failed++;
    printf("UNTRUE %s: %d pixels say something, expected at least %d on %s\n", truth, compared,
           at_least, check->target->label);
}

double channel_of(const HdFrame *frame, int x, int y, int channel) {
    return (double)frame->rgb[3 * (y * frame->width + x) + channel];
}

double red(const HdFrame *frame, int x, int y) {
    return channel_of(frame, x, y, 0);
}

HdVec3 direction_at(const HdScene *scene, const HdCamera *camera, double x, double y) {
    double step = 2.0 * camera->tangent_of_half_fov / scene->width;
    HdVec3 right = hd_scale(camera->right, (x - 0.5 * scene->width) * step);
    HdVec3 down = hd_scale(camera->up, -(y - 0.5 * scene->height) * step);
    return hd_normalize(hd_add(camera->forward, hd_add(right, down)));
}

HdVec3 grey(double value) {
    return hd_vec3(value, value, value);
}

HdPlatonic shape_of(const HdSolid *solid) {
    HdPlatonic shape;
    hd_platonic(solid->kind, &shape);
    hd_platonic_rotate(&shape, solid->rotation_degrees);
    return shape;
}

HdMaterial glowing(double radiance) {
    HdMaterial material = build_material(grey(radiance), 0.0, 0.0);
    material.ambient = 1.0;
    material.diffuse = material.specular = 0.0;
    return material;
}

void check_truths(const Target *target, int *checked, int *failed) {
    Check check = {.target = target,
                   .tolerance = target->precision == HD_PRECISION_FLOAT ? 3e-5 : 3e-7};
    check_first_hits(&check);
    check_geometry(&check);
    check_refraction(&check);
    check_invariance(&check);
    *checked += check.checked;
    *failed += check.failed;
}
