/* SPDX-License-Identifier: MIT */
#include "verify/golden_scenes.h"

#include "verify/golden_mesh_scenes.h"
#include "verify/scene_builder.h"

static void two_lights(HdScene *scene) {
    build_light(scene, 0, hd_vec3(3.0, -2.0, 5.0), hd_vec3(1.0, 0.9, 0.8));
    build_light(scene, 1, hd_vec3(-4.0, -1.0, 3.0), hd_vec3(0.3, 0.4, 0.7));
}

static void one_solid(HdScene *scene, HdCamera *camera, HdSolidKind kind) {
    build_scene(scene, 64, 48, 2, 5, 1, 2);
    two_lights(scene);
    build_solid(scene, 0, kind, hd_vec3(0.1, 0.2, 0.05), 1.2, hd_vec3(0.9, 0.6, 0.3), 3);
    build_square_floor(scene, 4.0, -1.3);
    build_texture(&scene->floor.texture, 16, 12);
    build_camera(camera, hd_vec3(2.3, -2.9, 1.4), hd_vec3(0.0, 0.0, 0.0), 50.0);
}

static void tetrahedron(HdScene *scene, HdCamera *camera) {
    one_solid(scene, camera, HD_TETRAHEDRON);
}
static void hexahedron(HdScene *scene, HdCamera *camera) {
    one_solid(scene, camera, HD_HEXAHEDRON);
}
static void octahedron(HdScene *scene, HdCamera *camera) {
    one_solid(scene, camera, HD_OCTAHEDRON);
}
static void dodecahedron(HdScene *scene, HdCamera *camera) {
    one_solid(scene, camera, HD_DODECAHEDRON);
}
static void icosahedron(HdScene *scene, HdCamera *camera) {
    one_solid(scene, camera, HD_ICOSAHEDRON);
}

static void three_solids(HdScene *scene, HdCamera *camera, double spacing) {
    build_scene(scene, 80, 48, 2, 6, 3, 2);
    two_lights(scene);
    build_solid(scene, 0, HD_TETRAHEDRON, hd_vec3(-spacing, 0.1, 0.0), 1.1, hd_vec3(1.0, 0.3, 0.2),
                2);
    build_solid(scene, 1, HD_OCTAHEDRON, hd_vec3(0.0, 0.4, 0.2), 1.0, hd_vec3(0.3, 0.9, 0.4), 2);
    build_solid(scene, 2, HD_DODECAHEDRON, hd_vec3(spacing, 0.0, 0.1), 1.2, hd_vec3(0.3, 0.5, 1.0),
                1);
    build_square_floor(scene, 6.0, -1.5);
    build_camera(camera, hd_vec3(0.4, -4.5, 1.2), hd_vec3(0.0, 0.0, 0.0), 65.0);
}

static void three_apart(HdScene *scene, HdCamera *camera) {
    three_solids(scene, camera, 2.4);
}
static void three_overlapping(HdScene *scene, HdCamera *camera) {
    three_solids(scene, camera, 0.7);
}

static void eye_inside(HdScene *scene, HdCamera *camera) {
    three_solids(scene, camera, 2.4);
    build_camera(camera, hd_vec3(2.5, 0.1, 0.2), hd_vec3(0.0, 0.3, 0.0), 80.0);
}

/* Exactly on the face x = 1 of a hexahedron with half-integer centre and edge 2, looking along it
   and inwards at once. */
static void eye_on_face(HdScene *scene, HdCamera *camera) {
    build_scene(scene, 64, 48, 1, 6, 1, 2);
    two_lights(scene);
    build_solid(scene, 0, HD_HEXAHEDRON, hd_vec3(0.0, 0.0, 0.0), sqrt(3.0), hd_vec3(0.8, 0.7, 1.0),
                4);
    build_square_floor(scene, 4.0, -1.25);
    build_camera(camera, hd_vec3(1.0, -0.25, 0.125), hd_vec3(0.75, 0.5, 0.0), 120.0);
}

static void eye_on_floor_plane(HdScene *scene, HdCamera *camera) {
    three_solids(scene, camera, 2.4);
    build_camera(camera, hd_vec3(0.5, -4.0, -1.5), hd_vec3(0.0, 0.0, -1.5), 70.0);
}

/* The middle of the picture is a vertex, and its middle row and column run along edges: odd sizes
   put sample rays exactly there. */
static void edges_and_corners(HdScene *scene, HdCamera *camera) {
    build_scene(scene, 65, 65, 1, 8, 2, 2);
    two_lights(scene);
    build_solid(scene, 0, HD_OCTAHEDRON, hd_vec3(0.0, 0.0, 0.0), 1.0, hd_vec3(0.6, 0.9, 0.9), 3);
    build_solid(scene, 1, HD_HEXAHEDRON, hd_vec3(0.0, 4.0, 0.0), 2.0 * sqrt(3.0),
                hd_vec3(1.0, 0.8, 0.5), 1);
    scene->solids[0].rim_width = 0.0;
    scene->solids[1].rim_width = 0.0;
    build_camera(camera, hd_vec3(0.0, -3.0, 0.0), hd_vec3(0.0, 0.0, 0.0), 45.0);
}

static void fifty_edge_lights(HdScene *scene, HdCamera *camera) {
    build_scene(scene, 48, 36, 2, 6, 1, 0);
    build_solid(scene, 0, HD_HEXAHEDRON, hd_vec3(0.0, 0.0, 0.2), 1.5, hd_vec3(0.7, 0.4, 0.9), 50);
    scene->solids[0].lights.disc_radius = 0.01;
    build_square_floor(scene, 5.0, -1.2);
    build_texture(&scene->floor.texture, 7, 31);
    build_camera(camera, hd_vec3(2.6, -2.2, 1.9), hd_vec3(0.0, 0.0, 0.0), 55.0);
}

static void tilted_floor(HdScene *scene, HdCamera *camera) {
    one_solid(scene, camera, HD_ICOSAHEDRON);
    build_floor(scene, hd_vec3(-4.0, 4.0, -0.5), hd_vec3(4.0, 4.0, -1.5), hd_vec3(4.0, -4.0, -2.5),
                hd_vec3(-4.0, -4.0, -1.5));
}

static void trapezoid_floor(HdScene *scene, HdCamera *camera) {
    one_solid(scene, camera, HD_TETRAHEDRON);
    build_floor(scene, hd_vec3(-1.0, 5.0, -1.3), hd_vec3(2.0, 4.0, -1.3), hd_vec3(6.0, -4.0, -1.3),
                hd_vec3(-5.0, -3.0, -1.3));
}

static void all_of_the_light(HdScene *scene, HdCamera *camera) {
    three_solids(scene, camera, 2.4);
    scene->width = 40;
    scene->height = 24;
    scene->depth = 12;
    for (int s = 0; s < 3; s++) {
        scene->solids[s].face.reflection = 0.7;
        scene->solids[s].face.transmission = 0.3;
        scene->solids[s].face.colour = hd_vec3(1.0, 1.0, 1.0);
    }
}

static void mirror_only(HdScene *scene, HdCamera *camera) {
    three_solids(scene, camera, 2.4);
    scene->depth = 20;
    for (int s = 0; s < 3; s++) {
        scene->solids[s].face.reflection = 0.95;
        scene->solids[s].face.transmission = 0.0;
    }
}

static void glass_only(HdScene *scene, HdCamera *camera) {
    three_solids(scene, camera, 0.7);
    scene->depth = 10;
    for (int s = 0; s < 3; s++) {
        scene->solids[s].face.reflection = 0.0;
        scene->solids[s].face.transmission = 0.9;
    }
}

static void one_pixel(HdScene *scene, HdCamera *camera) {
    three_solids(scene, camera, 2.4);
    scene->width = scene->height = 1;
    scene->samples_per_side = 7;
}

static void wide_strip(HdScene *scene, HdCamera *camera) {
    three_solids(scene, camera, 2.4);
    scene->width = 1023;
    scene->height = 7;
    scene->samples_per_side = 1;
    build_camera(camera, hd_vec3(0.4, -4.5, 1.2), hd_vec3(0.0, 0.0, 0.0), 150.0);
}

static void right_angle_view(HdScene *scene, HdCamera *camera) {
    three_solids(scene, camera, 2.4);
    scene->samples_per_side = 3;
    build_camera(camera, hd_vec3(0.4, -4.5, 1.2), hd_vec3(0.0, 0.0, 0.0), 90.0);
}

static void widest_view(HdScene *scene, HdCamera *camera) {
    three_solids(scene, camera, 2.4);
    build_camera(camera, hd_vec3(0.4, -4.5, 1.2), hd_vec3(0.0, 0.0, 0.0), 178.0);
}

static void cut_off(HdScene *scene, HdCamera *camera) {
    three_solids(scene, camera, 2.4);
    scene->depth = 12;
    scene->cutoff = 0.02;
    scene->exposure = 1.5;
}

static void far_from_origin(HdScene *scene, HdCamera *camera) {
    three_solids(scene, camera, 2.4);
    HdVec3 shift = hd_vec3(16384.0, -8192.0, 4096.0);
    for (int s = 0; s < 3; s++)
        scene->solids[s].centre = hd_add(scene->solids[s].centre, shift);
    for (int i = 0; i < 2; i++)
        scene->lights[i].position = hd_add(scene->lights[i].position, shift);
    for (int i = 0; i < 4; i++)
        scene->floor.corners[i] = hd_add(scene->floor.corners[i], shift);
    camera->eye = hd_add(camera->eye, shift);
}

static void clamped(HdScene *scene, HdCamera *camera) {
    one_solid(scene, camera, HD_OCTAHEDRON);
    scene->lights[0].intensity = hd_vec3(1e12, 1e12, 1e12);
}

static void empty_scene(HdScene *scene, HdCamera *camera) {
    build_scene(scene, 9, 5, 1, 3, 0, 0);
    build_camera(camera, hd_vec3(0.0, -1.0, 0.0), hd_vec3(0.0, 0.0, 0.0), 60.0);
}

static void refract(HdSolid *solid, double index, double reflection, double transmission) {
    solid->face.index_of_refraction = index;
    solid->face.reflection = reflection;
    solid->face.transmission = transmission;
    solid->face.diffuse = 0.05;
}

static void glass_cube(HdScene *scene, HdCamera *camera) {
    one_solid(scene, camera, HD_HEXAHEDRON);
    scene->solids[0].rotation_degrees = hd_vec3(15.0, 25.0, 35.0);
    scene->solids[0].face.colour = hd_vec3(0.9, 0.97, 1.0);
    refract(&scene->solids[0], 1.5, 0.1, 0.85);
    scene->depth = 8;
}

/* Most of what is seen was reflected totally. */
static void eye_inside_glass(HdScene *scene, HdCamera *camera) {
    glass_cube(scene, camera);
    refract(&scene->solids[0], 2.4, 0.15, 0.8);
    scene->samples_per_side = 1;
    build_camera(camera, hd_vec3(0.2, 0.1, 0.15), hd_vec3(-0.3, 0.9, -0.4), 100.0);
}

/* An index below 1, as air has in water: total reflection on the outer side. */
static void bubble(HdScene *scene, HdCamera *camera) {
    one_solid(scene, camera, HD_OCTAHEDRON);
    scene->solids[0].face.colour = hd_vec3(1.0, 1.0, 1.0);
    scene->solids[0].lights.per_edge = 0;
    refract(&scene->solids[0], 0.75, 0.05, 0.9);
}

static void glass_dodecahedron(HdScene *scene, HdCamera *camera) {
    one_solid(scene, camera, HD_DODECAHEDRON);
    scene->solids[0].face.colour = hd_vec3(1.0, 0.93, 0.85);
    scene->solids[0].face.has_inner_side = true;
    scene->solids[0].face.inner_reflection = 0.3;
    scene->solids[0].face.inner_transmission = 0.6;
    scene->solids[0].rim_width = 0.0;
    refract(&scene->solids[0], 1.33, 0.08, 0.9);
}

/* Mirrors from outside and nearly clear from within. */
static void inner_sides(HdScene *scene, HdCamera *camera) {
    three_solids(scene, camera, 0.7);
    for (int s = 0; s < 3; s++) {
        HdMaterial *face = &scene->solids[s].face;
        face->reflection = 0.7;
        face->transmission = 0.25;
        face->has_inner_side = true;
        face->inner_reflection = 0.1 * s;
        face->inner_transmission = 0.8;
    }
}

static void colour_edges(HdSolid *solid) {
    static const HdVec3 colours[] = {
        {1.0, 0.1, 0.1}, {0.1, 1.0, 0.2}, {0.2, 0.3, 1.0}, {1.0, 0.8, 0.1}};
    solid->lights.colour_count = 4;
    for (int i = 0; i < 4; i++)
        solid->lights.colours[i] = colours[i];
}

static void coloured_edges(HdScene *scene, HdCamera *camera) {
    three_solids(scene, camera, 2.4);
    for (int s = 0; s < 3; s++) {
        scene->solids[s].rotation_degrees = hd_vec3(20.0 * s, 35.0, -50.0);
        scene->solids[s].lights.intensity = 0.15;
        scene->solids[s].lights.disc_radius = 0.06;
        colour_edges(&scene->solids[s]);
    }
}

static void ending_lights(HdScene *scene, HdCamera *camera) {
    one_solid(scene, camera, HD_DODECAHEDRON);
    colour_edges(&scene->solids[0]);
    scene->solids[0].lights.per_edge = 1;
    scene->solids[0].lights.intensity = 1.5;
    scene->solids[0].lights.falloff = (HdFalloff){.end = 1.6};
    build_light(scene, 0, hd_vec3(1.3, -1.8, -0.6), hd_vec3(1.5, 1.2, 0.9));
    build_light(scene, 1, hd_vec3(-1.4, 1.6, 0.2), hd_vec3(0.6, 0.9, 1.5));
    for (int i = 0; i < 2; i++)
        scene->lights[i].falloff = (HdFalloff){.end = 1.0 + 1.2 * i};
}

/* Many lights on each edge, which threads with one ray judge together: of some points all are too
   far away, of others some. */
static void runs_of_lights(HdScene *scene, HdCamera *camera) {
    three_solids(scene, camera, 2.4);
    scene->samples_per_side = 1;
    scene->depth = 4;
    for (int s = 0; s < 3; s++) {
        colour_edges(&scene->solids[s]);
        scene->solids[s].lights.per_edge = 6;
        scene->solids[s].lights.intensity = 0.1;
        scene->solids[s].lights.falloff = (HdFalloff){.end = 0.7 + 0.3 * s};
    }
}

/* Lanterns: paper faces over the solid's own lights, and a lamp below a thin floor. */
static void lanterns(HdScene *scene, HdCamera *camera) {
    one_solid(scene, camera, HD_ICOSAHEDRON);
    HdSolid *solid = &scene->solids[0];
    colour_edges(solid);
    solid->lights.per_edge = 1;
    solid->lights.intensity = 0.15;
    solid->face.reflection = 0.1;
    solid->face.transmission = 0.5;
    solid->face.diffuse = 0.8;
    solid->face.lit_from_behind = true;
    scene->floor.material.reflection = 0.1;
    scene->floor.material.transmission = 0.6;
    scene->floor.material.lit_from_behind = true;
    build_light(scene, 1, hd_vec3(-1.5, -0.5, -2.2), hd_vec3(0.9, 0.9, 0.5));
}

static void everything(HdScene *scene, HdCamera *camera) {
    three_solids(scene, camera, 2.0);
    scene->depth = 10;
    scene->cutoff = 0.001;
    scene->samples_per_side = 1;
    for (int s = 0; s < 3; s++) {
        HdSolid *solid = &scene->solids[s];
        solid->rotation_degrees = hd_vec3(-30.0, 10.0 * s, 65.0);
        colour_edges(solid);
        solid->lights.intensity = 0.15;
        solid->lights.falloff = (HdFalloff){.end = 2.5};
        refract(solid, s == 1 ? 0.8 : 1.4 + 0.3 * s, 0.15, 0.8);
        solid->face.has_inner_side = true;
        solid->face.inner_reflection = 0.2;
        solid->face.inner_transmission = 0.75;
        solid->face.diffuse = 0.4;
        solid->face.lit_from_behind = s != 1;
    }
    scene->lights[1].falloff.end = 6.0;
    build_texture(&scene->floor.texture, 24, 24);
}

/* Pixels with one sample, with four and with all of them; rays and lights that are left out; passes
   that are repeated. */
static void adaptive_and_bounded(HdScene *scene, HdCamera *camera) {
    everything(scene, camera);
    scene->cutoff = 0.0;
    scene->depth = 24;
    scene->samples_per_side = 4;
    scene->sampling = HD_SAMPLING_ADAPTIVE;
    scene->max_error = 4.0;
}

static void crop_of_reference(HdScene *scene, HdCamera *camera) {
    many_instances(scene, camera);
    scene->samples_per_side = 3;
    scene->sampling = HD_SAMPLING_REFERENCE;
    scene->max_error = 0.5;
    scene->crop = (HdCrop){.whole_width = scene->width,
                           .whole_height = scene->height,
                           .left = scene->width / 3,
                           .top = scene->height / 4};
    scene->width /= 3;
    scene->height /= 2;
}

const HdGoldenFrame hd_golden_frames[] = {
    {"tetrahedron", tetrahedron},
    {"hexahedron", hexahedron},
    {"octahedron", octahedron},
    {"dodecahedron", dodecahedron},
    {"icosahedron", icosahedron},
    {"three-apart", three_apart},
    {"three-overlapping", three_overlapping},
    {"eye-inside", eye_inside},
    {"eye-on-face", eye_on_face},
    {"eye-on-floor-plane", eye_on_floor_plane},
    {"edges-and-corners", edges_and_corners},
    {"fifty-edge-lights", fifty_edge_lights},
    {"tilted-floor", tilted_floor},
    {"trapezoid-floor", trapezoid_floor},
    {"all-of-the-light", all_of_the_light},
    {"mirror-only", mirror_only},
    {"glass-only", glass_only},
    {"one-pixel", one_pixel},
    {"wide-strip", wide_strip},
    {"right-angle-view", right_angle_view},
    {"widest-view", widest_view},
    {"cut-off", cut_off},
    {"far-from-origin", far_from_origin},
    {"clamped", clamped},
    {"empty-scene", empty_scene},
    {"inner-sides", inner_sides},
    {"coloured-edges", coloured_edges},
    {"ending-lights", ending_lights},
    {"runs-of-lights", runs_of_lights},
    {"glass-cube", glass_cube},
    {"eye-inside-glass", eye_inside_glass},
    {"bubble", bubble},
    {"glass-dodecahedron", glass_dodecahedron},
    {"lanterns", lanterns},
    {"everything", everything},
    {"bumpy-sphere", bumpy_sphere},
    {"many-instances", many_instances},
    {"triangulated-solids", triangulated_solids},
    {"mesh-edges-and-corners", mesh_edges_and_corners},
    {"mesh-far-from-origin", mesh_far_from_origin},
    {"adaptive-and-bounded", adaptive_and_bounded},
    {"crop-of-reference", crop_of_reference},
};
const int hd_golden_frame_count = (int)(sizeof hd_golden_frames / sizeof hd_golden_frames[0]);
