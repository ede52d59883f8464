/* SPDX-License-Identifier: MIT */
/* Total reflection. */
#include <math.h>

#include "scene/camera.h"
#include "truths.h"
#include "verify/scene_builder.h"

/* Builds a cube with no emission of its own. */
static void build_clear_cube(HdScene *scene, int width, int height, int depth, HdVec3 rotation,
                             double index, double background) {
    build_scene(scene, width, height, 1, depth, 1, 0);
    scene->background = grey(background);
    build_glass(scene, 0, HD_HEXAHEDRON, grey(0.0), sqrt(3.0), 1.0, 1.0);
    scene->solids[0].rotation_degrees = rotation;
    scene->solids[0].face.index_of_refraction = index;
}

/* Checks one ray that hits a face at the critical angle plus `excess`, from the denser side. */
static void check_critical_angle(Check *check, HdVec3 rotation, int face, double index,
                                 double excess) {
    const double glow = 0.2, background = 0.5;
    const bool inside = index > 1.0;
    HdScene scene;
    HdCamera camera;
    build_clear_cube(&scene, 1, 1, 1, rotation, index, background);
    HdMaterial *material = &scene.solids[0].face;
    material->ambient = glow;
    material->reflection = 0.3;
    material->transmission = 0.6;
    material->has_inner_side = true;
    material->inner_reflection = 0.15;
    material->inner_transmission = 0.65;
    HdVec3 normal = shape_of(&scene.solids[0]).face_normal[face];
    HdVec3 along = hd_normalize(hd_cross(normal, hd_vec3(0.3, 0.5, 0.8)));
    double angle = asin(inside ? 1.0 / index : index) + excess;
    HdVec3 eye = hd_scale(normal, inside ? 0.7 : 1.3);
    HdVec3 d =
        hd_add(hd_scale(normal, inside ? cos(angle) : -cos(angle)), hd_scale(along, sin(angle)));
    build_camera(&camera, eye, hd_add(eye, d), 1.0);
    HdFrame frame = render_last(check, &scene, &camera);

    double reflection = inside ? 0.15 : 0.3, transmission = inside ? 0.65 : 0.6;
    double mirror = inside ? glow : background, through = inside ? background : glow;
    double expected = excess > 0.0 ? glow + (reflection + transmission) * mirror
                                   : glow + reflection * mirror + transmission * through;
    expect(check, "critical angle", face, inside, red(&frame, 0, 0), expected);
    expect(check, "critical angle, mirrored", face, inside, (double)frame.mirrored_rays, 1.0);
    expect(check, "critical angle, transmitted", face, inside, (double)frame.transmitted_rays,
           excess > 0.0 ? 0.0 : 1.0);
    hd_frame_free(&frame);
}

static void check_critical_angles(Check *check, HdVec3 rotation) {
    const double indices[] = {1.2, 1.5, 2.4, 0.9, 0.5};
    const double excess = check->target->precision == HD_PRECISION_FLOAT ? 1e-5 : 1e-11;
    for (int i = 0; i < 5; i++)
        for (int face = 0; face < 6; face++) {
            check_critical_angle(check, rotation, face, indices[i], excess);
            check_critical_angle(check, rotation, face, indices[i], -excess);
        }
}

/* Without losses, a clear solid before a white background is white: light that does not pass is
   reflected, totally or not. Two partial reflections leave less than is visible. */
static void check_nothing_lost(Check *check, double index) {
    HdScene scene;
    HdCamera camera;
    build_clear_cube(&scene, 32, 24, 8, hd_vec3(20.0, 30.0, 40.0), index, 1.0);
    scene.solids[0].face.reflection = 0.0002;
    scene.solids[0].face.transmission = 0.9998;
    build_camera(&camera, hd_vec3(1.6, -2.4, 1.9), grey(0.0), 60.0);
    HdFrame frame = render_last(check, &scene, &camera);
    for (int y = 0; y < frame.height; y++)
        for (int x = 0; x < frame.width; x++)
            expect(check, "nothing is lost", x, y, red(&frame, x, y), 1.0);
    hd_frame_free(&frame);
}

void check_refraction(Check *check) {
    check_critical_angles(check, grey(0.0));
    check_critical_angles(check, hd_vec3(20.0, 30.0, 40.0));
    check_nothing_lost(check, 1.5);
    check_nothing_lost(check, 0.7);
}
