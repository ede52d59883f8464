/* SPDX-License-Identifier: MIT */
/* What a face does on either side: inner reflection and transmission, and light from behind. */
#include <math.h>

#include "certify/scene_builder.h"
#include "scene/camera.h"
#include "truth_check.h"
#include "truths.h"

static const double colour = 0.5, diffuse = 0.6, specular = 0.4;
static const double outer_transmission = 0.4, inner_transmission = 0.7;
static const double outer_reflection = 0.1, inner_reflection = 0.25;

static void set_sides(HdMaterial *material) {
    material->colour = grey(colour);
    material->reflection = outer_reflection;
    material->transmission = outer_transmission;
    material->has_inner_side = true;
    material->inner_reflection = inner_reflection;
    material->inner_transmission = inner_transmission;
}

/* One pixel, at the face y = -1 of a cube, from outside or from within. The second cube, of clear
   glass, stands behind the first one, or far away. */
static void build_pixel(HdScene *scene, HdCamera *camera, int depth, bool from_within,
                        bool stands_behind) {
    build_scene(scene, 1, 1, 1, depth, 2, 2);
    scene->background = grey(0.0);
    build_glass(scene, 0, HD_HEXAHEDRON, grey(0.0), sqrt(3.0), 1.0, 0.0);
    set_sides(&scene->solids[0].face);
    build_glass(scene, 1, HD_HEXAHEDRON, hd_vec3(0.0, 3.0, stands_behind ? 0.0 : 300.0), 1.5, 0.9,
                0.8);
    build_camera(camera, hd_vec3(0.25, from_within ? 0.0 : -4.0, 0.125), hd_vec3(0.25, -1.0, 0.125),
                 1.0);
}

static void expect_pixel(Check *check, const char *truth, HdScene *scene, const HdCamera *camera,
                         double expected) {
    HdFrame frame = render_last(check, scene, camera);
    expect(check, truth, 0, 0, red(&frame, 0, 0), expected);
    hd_frame_free(&frame);
}

/* The faces glow; each level of the tree adds its terms. */
static void check_view_rays(Check *check, bool from_within) {
    const double ambient = 0.3, background = 0.8, glow = ambient * colour;
    const double pass_in = colour * outer_transmission, pass_out = colour * inner_transmission;
    const double met_inside = glow + inner_reflection * glow + pass_out * background;
    const double seen[2][3] = {
        {glow, glow + outer_reflection * background + pass_in * glow,
         glow + outer_reflection * background + pass_in * met_inside},
        {glow, met_inside, glow + inner_reflection * met_inside + pass_out * background},
    };
    for (int depth = 0; depth <= 2; depth++) {
        HdScene scene;
        HdCamera camera;
        build_pixel(&scene, &camera, depth, from_within, false);
        scene.background = grey(background);
        scene.solids[0].face.ambient = ambient;
        HdFrame frame = render_last(check, &scene, &camera);
        expect(check, "inner sides", depth, from_within, red(&frame, 0, 0),
               seen[from_within][depth]);
        expect(check, "inner sides, mirrored", depth, from_within, (double)frame.mirrored_rays,
               depth);
        expect(check, "inner sides, transmitted", depth, from_within,
               (double)frame.transmitted_rays, depth);
        hd_frame_free(&frame);
    }
}

/* N.L at the point that the pixel shows. */
static double cosine_to(HdVec3 light) {
    HdVec3 to_light = hd_sub(light, hd_vec3(0.25, -1.0, 0.125));
    return fabs(to_light.y) / hd_length(to_light);
}

/* A face seen from within takes light from outside through the other faces. */
static void check_inner_face_lit(Check *check) {
    const HdVec3 light = hd_vec3(0.5, 9.0, 0.25);
    for (int behind = 0; behind < 2; behind++) {
        HdScene scene;
        HdCamera camera;
        build_pixel(&scene, &camera, 0, true, behind);
        scene.solids[0].face.specular = 0.0;
        scene.solids[0].face.diffuse = diffuse;
        build_light(&scene, 0, light, grey(1.0));
        expect_pixel(check, "inner face, lit through its solid", &scene, &camera,
                     diffuse * colour * cosine_to(light) * colour * inner_transmission *
                         (behind ? 0.72 * 0.72 : 1.0));
    }
}

typedef struct Behind {
    const char *truth;
    bool from_within, stands_behind;
    HdVec3 light;
    double transmittance; /* of the face that is seen and of what is between it and the light */
} Behind;

static void check_behind(Check *check, const Behind *behind, bool is_lit, bool also_in_front) {
    const HdVec3 front = behind->from_within ? hd_vec3(0.0, 0.5, 0.5) : hd_vec3(1.0, -5.0, 2.0);
    HdScene scene;
    HdCamera camera;
    build_pixel(&scene, &camera, 0, behind->from_within, behind->stands_behind);
    HdMaterial *material = &scene.solids[0].face;
    material->diffuse = diffuse;
    material->specular = also_in_front ? 0.0 : specular;
    material->lit_from_behind = is_lit;
    scene.solids[1].face.lit_from_behind = true;
    build_light(&scene, 0, behind->light, grey(1.0));
    double expected = is_lit ? behind->transmittance * cosine_to(behind->light) : 0.0;
    if (also_in_front) {
        build_light(&scene, 1, front, grey(1.0));
        expected += cosine_to(front);
    }
    expect_pixel(check, behind->truth, &scene, &camera, diffuse * colour * expected);
}

static void check_solid_lit_from_behind(Check *check) {
    const Behind list[] = {
        {"lit from behind, through the solid", false, false, hd_vec3(0.5, 9.0, 0.25),
         outer_transmission * colour * inner_transmission},
        {"lit from behind, through two solids", false, true, hd_vec3(0.5, 9.0, 0.25),
         outer_transmission * colour * inner_transmission * 0.72 * 0.72},
        {"lit from behind, by a light inside", false, false, hd_vec3(0.3, 0.2, 0.5),
         outer_transmission},
        {"lit from behind, seen from inside", true, false, hd_vec3(0.5, -3.0, 0.4),
         inner_transmission},
    };
    for (int i = 0; i < 4; i++) {
        check_behind(check, &list[i], true, false);
        check_behind(check, &list[i], true, true);
        check_behind(check, &list[i], false, false);
    }
}

static void turn_floor_over(HdFloor *floor) {
    HdVec3 corner = floor->corners[1];
    floor->corners[1] = floor->corners[3];
    floor->corners[3] = corner;
}

/* A floor seen from above and lit from below, through a cube or not. It is alike on both sides,
   wherever its normal looks. */
static void check_floor_lit_from_behind(Check *check) {
    const HdVec3 target = hd_vec3(0.25, 0.125, -1.0);
    const HdVec3 lights[2] = {hd_vec3(0.5, 0.25, -9.0), hd_vec3(1.0, -1.0, 3.0)};
    for (int shaded = 0; shaded < 2; shaded++) {
        HdScene scene;
        HdCamera camera;
        double cosine[2];
        build_scene(&scene, 1, 1, 1, 0, 1, 2);
        build_glass(&scene, 0, HD_HEXAHEDRON, hd_vec3(0.0, 0.0, shaded ? -4.0 : 400.0), 1.5, 0.9,
                    0.8);
        build_square_floor(&scene, 5.0, -1.0);
        if (shaded)
            turn_floor_over(&scene.floor);
        set_sides(&scene.floor.material);
        scene.floor.material.has_inner_side = false;
        scene.floor.material.diffuse = diffuse;
        scene.floor.material.specular = 0.0;
        scene.floor.material.lit_from_behind = true;
        for (int i = 0; i < 2; i++) {
            HdVec3 to_light = hd_sub(lights[i], target);
            cosine[i] = fabs(to_light.z) / hd_length(to_light);
            build_light(&scene, i, lights[i], grey(1.0));
        }
        build_camera(&camera, hd_vec3(1.0, -3.0, 2.0), target, 1.0);
        expect_pixel(
            check, "floor lit from behind", &scene, &camera,
            diffuse * colour *
                (cosine[1] + cosine[0] * outer_transmission * (shaded ? 0.72 * 0.72 : 1.0)));
    }
}

void check_sides(Check *check) {
    begin(check);
    check_view_rays(check, false);
    check_view_rays(check, true);
    check_inner_face_lit(check);
    check_solid_lit_from_behind(check);
    check_floor_lit_from_behind(check);
}
